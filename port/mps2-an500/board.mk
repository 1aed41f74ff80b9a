# Arm MPS2+ with FPGA image AN500: Cortex-M7 at 25 MHz, FPU for float and
# double.
BOARD_IS := Arm, Cortex-M7
BOARD_TOOLS := arm-none-eabi-
BOARD_PACKAGES := gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm
BOARD_FLAGS := -ffreestanding -mcpu=cortex-m7 -mthumb -mfpu=fpv5-d16 \
  -mfloat-abi=hard
BOARD_OPT := -O2
BOARD_SOURCES := port/arch/cortex_m.c port/arch/cortex_m_tick.c \
  port/arch/memory.c port/arch/cortex_m_boot.c
BOARD_LINK := -nostartfiles -nostdlib -Lport/arch -Tport/mps2-an500/board.ld \
  -lgcc
BOARD_REALS := float double
BOARD_BAUDS := 115200 1000000 2000000
BOARD_RUN := qemu-system-arm -M mps2-an500 -display none -monitor none \
  -semihosting-config enable=on,target=native -serial stdio
BOARD_STEPS := 100000
# Shift 5 is 31 instructions a microsecond: one a cycle would be 25. The longest
# step of `chaos` takes 9200 of them in float at 5 kHz, where it is compensated,
# and 13400 in double: the faster rates are those of a chip that is twice as
# fast, and leave a quarter of the tick or more.
BOARD_RATES_float := 1000:5 5000:4
BOARD_RATES_double := 1000:5 3000:4
BOARD_LOADS := -kernel
BOARD_BOOT := file by semihosting, which stands in for the flash of a chip
BOARD_STARTS := yes
# Shift at which every step goes out as frames, at 1 kHz.
BOARD_FRAMES := 2
# Driven over its line by tools/board/hil.
BOARD_LOOP := yes
# Real types in which the other schemes are tested.
BOARD_SCHEMES := double
# What of tests/target/fault.c ends with a word.
BOARD_FAULTS := stack bus hang
BOARD_WATCHDOG := yes
