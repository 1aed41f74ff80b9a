# Arduino Mega: ATmega2560, 8 bits at 16 MHz, 256 KB flash, 8 KB RAM.
AVR_CHIP := atmega2560
AVR_MACHINE := mega2560
AVR_STACK := 2048
include port/arch/avr.mk
BOARD_LINK := -T port/mega/low_data.ld $(BOARD_LINK)
BOARD_SMALL := yes
BOARD_STEPS := 100000
BOARD_RATES_float := 50
