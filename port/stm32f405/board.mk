# STM32F405: Cortex-M4F at 168 MHz, FPU for float; double in software. 1 MB
# flash, 128 KB RAM. USART1.
STM32F4_FLAGS := -DSTM32F4_USART=1 -DSTM32F4_HSE_MHZ=25u \
  -DSTM32F4_HSE_IS_CLOCK=0
include port/arch/stm32f4.mk
BOARD_SOURCES += port/arch/stm32f4_random.c
BOARD_BOOT := random number generator
BOARD_RUN := qemu-system-arm -M netduinoplus2 -display none -monitor none \
  -semihosting-config enable=on,target=native -serial stdio
# Shift 3 is 125 instructions a microsecond: one a cycle would be 168.
BOARD_RATES_float := 1000:3 10000:3
BOARD_RATES_double := 250:3
# Shift at which every step goes out as frames, at 1 kHz.
BOARD_FRAMES := 1
# The painted stack is compared with the call graph.
BOARD_PAINT := yes
# Real types in which the other schemes are tested.
BOARD_SCHEMES := float double
