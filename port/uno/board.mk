# Arduino Uno: ATmega328P, 8 bits at 16 MHz, 32 KB flash, 2 KB RAM. Constants
# lie in RAM too: there is no room for a firmware that has all scenes.
BOARD_TOOLS := avr-
BOARD_PACKAGES := gcc-avr avr-libc qemu-system-misc
BOARD_FLAGS := -mmcu=atmega328p -DF_CPU=16000000ul -DLOOP_ROOM=288u \
  -DLOOP_RECORD=160u -DBOARD_SMALL
BOARD_LINK := -mmcu=atmega328p -lm
BOARD_REALS := float
BOARD_SMALL := yes
BOARD_RUN := tests/target/until EXIT qemu-system-avr -M arduino-uno \
  -display none -monitor none -serial stdio
BOARD_LOADS := -bios
BOARD_STEPS := 2000
BOARD_RATES_float := 100
BOARD_SHARED := yes
# Warnings that this compiler does not know, or that its int of 16 bits would
# raise in other places than elsewhere.
BOARD_WITHOUT := -Wnull-dereference -Wimplicit-fallthrough -Wsign-conversion \
  -Wconversion -Wfloat-conversion
