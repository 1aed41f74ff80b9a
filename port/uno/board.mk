# Arduino Uno: ATmega328P, 8 bits at 16 MHz, 32 KB flash, 2 KB RAM. It has room
# for two scenes without a set-valued law, of which `string` leaves 1.9 kB; the
# Mega has room for all.
AVR_CHIP := atmega328p
AVR_MACHINE := arduino-uno
AVR_STACK := 832
include port/arch/avr.mk
# Without these two passes of gcc 5.4 the program is 1.2 % smaller.
BOARD_FLAGS += -fno-tree-coalesce-vars -fno-gcse
BOARD_SMALL := yes
BOARD_SCENES := string frictionless
BOARD_LARGER := mega
BOARD_WATCHED := simavr -m $(AVR_CHIP) -f 16000000
BOARD_STEPS := 2000
BOARD_RATES_float := 100
