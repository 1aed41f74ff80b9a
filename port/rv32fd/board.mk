# RV32IMAFDC, QEMU's machine `virt`: FPU for float and double.
BOARD_IS := RISC-V, RV32IMAFDC
BOARD_TOOLS := riscv64-unknown-elf-
BOARD_PACKAGES := gcc-riscv64-unknown-elf picolibc-riscv64-unknown-elf \
  qemu-system-misc
BOARD_FLAGS := -ffreestanding --specs=picolibc.specs -march=rv32imafdc \
  -mabi=ilp32d -misa-spec=2.2 -mcmodel=medany -msmall-data-limit=0
BOARD_OPT := -O2
BOARD_SOURCES := port/arch/riscv.c port/arch/memory.c
BOARD_LINK := -nostartfiles -nostdlib -Lport/arch -Tport/rv32fd/board.ld -lgcc
BOARD_REALS := float double
BOARD_RUN := qemu-system-riscv32 -M virt -bios none -display none \
  -monitor none -serial stdio
BOARD_STEPS := 100000
# Shift 4 is 62 instructions a microsecond.
BOARD_RATES_float := 1000:4 5000:4
BOARD_RATES_double := 1000:4 3000:4
BOARD_LOADS := -kernel
# Shift at which every step goes out as frames, at 1 kHz.
BOARD_FRAMES := 2
# What of tests/target/fault.c ends with a word.
BOARD_FAULTS := stack bus
