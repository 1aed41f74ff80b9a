# ST Nucleo-F446RE: Cortex-M4F at 168 MHz, FPU for float; double in software.
# 512 KB flash, 128 KB RAM. USART2 goes to the probe on the board, which is a
# serial device of the computer and gives the chip its clock of 8 MHz.
STM32F4_FLAGS := -DSTM32F4_USART=2 -DSTM32F4_HSE_MHZ=8u \
  -DSTM32F4_HSE_IS_CLOCK=1
include port/arch/stm32f4.mk
# Whose code of a step this board's is, compiled with the same options.
BOARD_TWIN := stm32f405
# An STM32F405 with the second of its USARTs: the addresses are the same.
BOARD_RUN := qemu-system-arm -M netduinoplus2 -display none -monitor none \
  -semihosting-config enable=on,target=native -serial null -serial stdio
# Shift 3 is 125 instructions a microsecond: one a cycle would be 168.
BOARD_RATES_float := 1000:3
BOARD_RATES_double := 50:3
