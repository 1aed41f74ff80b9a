# BBC micro:bit: nRF51822, Cortex-M0 at 16 MHz, no FPU. 256 KB flash, 16 KB RAM.
BOARD_IS := Arm, Cortex-M0
BOARD_TOOLS := arm-none-eabi-
BOARD_PACKAGES := gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm
BOARD_FLAGS := -ffreestanding -mcpu=cortex-m0 -mthumb -DBOARD_SMALL
BOARD_SOURCES := port/arch/cortex_m.c port/arch/memory.c
# The C library's sqrt without its errno, which would cost 1 KB of RAM.
BOARD_LINK := -nostartfiles -Lport/arch -Tport/microbit/board.ld \
  -Wl,--defsym=sqrtf=__ieee754_sqrtf -Wl,--defsym=sqrt=__ieee754_sqrt -lm
BOARD_REALS := float double
BOARD_BAUDS := 115200 250000 1000000
BOARD_RUN := qemu-system-arm -M microbit -display none -monitor none \
  -semihosting-config enable=on,target=native -serial stdio
# Shift 6 is 15.6 instructions a microsecond: one a cycle would be 16. A step
# at 1 kHz needs a faster chip of this kind.
BOARD_STEPS := 100000
BOARD_RATES_float := 400:3 50:6
BOARD_RATES_double := 100:3 25:6
BOARD_LOADS := -kernel
BOARD_BOOT := random number generator
BOARD_STARTS := yes
# A rate and shift at which every step is too late.
BOARD_LATE := 500:6
# The painted stack is compared with the call graph.
BOARD_PAINT := yes
# What of tests/target/fault.c ends with a word.
BOARD_FAULTS := stack bus
