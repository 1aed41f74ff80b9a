# WebAssembly, in node or a page: float and double.
BOARD_CC := clang
BOARD_PACKAGES := clang lld nodejs
BOARD_FLAGS := --target=wasm32 -ffreestanding
BOARD_OPT := -O2
BOARD_SOURCES := port/arch/memory.c
BOARD_LINK := -nostdlib -Wl,--no-entry -Wl,--export=main
BOARD_REALS := float double
BOARD_RUN := node port/wasm32/run.mjs
BOARD_STEPS := 100000
BOARD_RATES_float := 1000
BOARD_SHARED := yes
