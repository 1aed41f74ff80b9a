# What the boards with an AVR share; each says AVR_CHIP, AVR_MACHINE and
# AVR_STACK, the RAM that is left to the stack [bytes]. Constants lie in RAM.
BOARD_IS := AVR
BOARD_TOOLS := avr-
BOARD_PACKAGES := gcc-avr avr-libc qemu-system-misc
# Prologues that are called save 6 %, and cost a step less than 1 % of its time.
# Short calls where they reach save 1 %.
BOARD_FLAGS := -mmcu=$(AVR_CHIP) -DF_CPU=16000000ul -mcall-prologues -mrelax \
  -DLOOP_ROOM=288u -DLOOP_RECORD=160u -DBOARD_SMALL
BOARD_SOURCES := port/arch/avr.c
BOARD_LINK := -mmcu=$(AVR_CHIP) -Wl,--defsym=avr_stack=$(AVR_STACK) \
  port/arch/avr.ld -lm
BOARD_REALS := float
BOARD_BAUDS := 115200 250000 500000 1000000
BOARD_RUN := tests/target/until EXIT qemu-system-avr -M $(AVR_MACHINE) \
  -display none -monitor none -serial stdio
BOARD_LOADS := -bios
BOARD_SHARED := yes
# Warnings that this compiler does not know, or that its int of 16 bits would
# raise in other places than elsewhere.
BOARD_WITHOUT := -Wnull-dereference -Wimplicit-fallthrough -Wsign-conversion \
  -Wconversion -Wfloat-conversion
# What of tests/target/fault.c ends with a word.
BOARD_FAULTS := stack
BOARD_WATCHDOG := yes
