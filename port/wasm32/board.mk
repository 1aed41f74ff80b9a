# WebAssembly, in node or a web page: float and double.
BOARD_IS := WebAssembly
BOARD_CC := clang
BOARD_PACKAGES := clang lld nodejs
BOARD_FLAGS := --target=wasm32 -ffreestanding
BOARD_OPT := -O2
BOARD_SOURCES := port/arch/memory.c
BOARD_LINK := -nostdlib -Wl,--no-entry -Wl,--export-if-defined=main
BOARD_REALS := float double
BOARD_RUN := node port/wasm32/run.mjs
BOARD_STEPS := 100000
BOARD_RATES_float := 1000
BOARD_SHARED := yes
# Real types in which the other schemes are tested.
BOARD_SCHEMES := float double
# PROGRAM=module: begin, step and state, for a web page or a program in node.
SOURCE_module := port/wasm32/module/module.c
BOARD_CHECK_MODULE := node port/wasm32/module/check.mjs
# Nothing comes in over its line.
BOARD_DEAF := yes
