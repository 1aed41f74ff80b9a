# Raspberry Pi Pico: RP2040, Cortex-M0+ at 125 MHz, no FPU. 2 MB flash, 264 KB
# RAM, from which it runs. firmware.uf2 is copied to the drive that the Pico is
# while its button is pressed at power-up.
BOARD_IS := Arm, Cortex-M0+
BOARD_TOOLS := arm-none-eabi-
BOARD_PACKAGES := gcc-arm-none-eabi libnewlib-arm-none-eabi nodejs python3
BOARD_NPM := rp2040js@1.4.1
BOARD_FLAGS := -ffreestanding -mcpu=cortex-m0plus -mthumb -DBOARD_SMALL
BOARD_SOURCES := port/arch/cortex_m.c port/arch/cortex_m_tick.c \
  port/arch/memory.c
# The C library's sqrt without its errno, which would cost 1 KB of RAM.
BOARD_LINK := -nostartfiles -Lport/arch -Tport/pico/board.ld \
  -Wl,--defsym=sqrtf=__ieee754_sqrtf -Wl,--defsym=sqrt=__ieee754_sqrt -lm
# Boot code with its CRC, and the UF2 file.
BOARD_IMAGE := port/pico/image.py
BOARD_REALS := float double
BOARD_BAUDS := 115200
BOARD_RUN := node port/pico/run.mjs
BOARD_HERE := node port/pico/run.mjs --here
BOARD_STEPS := 2000
# Whose processor has the same instructions.
BOARD_LIKE := microbit
# In the emulator's time, of cycles at 125 MHz.
BOARD_RATES_float := 100
BOARD_RATES_double := 50
# What of tests/target/fault.c ends with a word.
BOARD_FAULTS := stack
