# SiFive HiFive1: FE310, RV32IMAC at 256 MHz, no FPU. 16 KB RAM. Its timer
# counts 32768 Hz on silicon (HIFIVE1_MTIME=32768), 10 MHz in QEMU.
HIFIVE1_MTIME ?= 10000000
BOARD_IS := RISC-V, RV32IMAC
BOARD_TOOLS := riscv64-unknown-elf-
BOARD_PACKAGES := gcc-riscv64-unknown-elf picolibc-riscv64-unknown-elf \
  qemu-system-misc
BOARD_FLAGS := -ffreestanding --specs=picolibc.specs -misa-spec=2.2 \
  -march=rv32imac -mabi=ilp32 -mcmodel=medany -msmall-data-limit=0 \
  -DBOARD_SMALL -DMTIME_HZ=$(HIFIVE1_MTIME)u
BOARD_SOURCES := port/arch/riscv.c port/arch/memory.c
BOARD_LINK := -nostartfiles -Lport/arch -Tport/hifive1/board.ld -lm
BOARD_REALS := float double
BOARD_BAUDS := 115200 1000000
BOARD_RUN := qemu-system-riscv32 -M sifive_e -display none -monitor none \
  -semihosting-config enable=on,target=native -serial stdio
BOARD_STEPS := 100000
# Shift 3 is 125 instructions a microsecond: one a cycle would be 256.
BOARD_RATES_float := 400:3
BOARD_RATES_double := 200:3
BOARD_LOADS := -kernel
# A rate and shift at which every step is too late.
BOARD_LATE := 1000:6
# The painted stack is compared with the call graph.
BOARD_PAINT := yes
# What of tests/target/fault.c ends with a word.
BOARD_FAULTS := stack bus
