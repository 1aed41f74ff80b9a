# STM32F405: Cortex-M4F at 168 MHz, FPU for float; double in software. 1 MB
# flash, 128 KB RAM.
BOARD_TOOLS := arm-none-eabi-
BOARD_PACKAGES := gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm
BOARD_FLAGS := -ffreestanding -mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 \
  -mfloat-abi=hard
# Its own, because that of libgcc is not always rounded right (docs/PORTS.md).
ADD_double := port/arch/double_add.c
WRAP_double := -Wl,--wrap=__aeabi_dadd,--wrap=__aeabi_dsub,--wrap=__aeabi_drsub
BOARD_SOURCES := port/arch/cortex_m.c port/arch/cortex_m_tick.c \
  port/arch/memory.c $(ADD_$(REAL))
BOARD_LINK := -nostartfiles -Lport/arch -Tport/stm32f405/board.ld \
  -Wl,--defsym=sqrt=__ieee754_sqrt $(WRAP_$(REAL)) -lm
BOARD_REALS := float double
BOARD_RUN := qemu-system-arm -M netduinoplus2 -display none -monitor none \
  -semihosting-config enable=on,target=native -serial stdio
BOARD_STEPS := 100000
# Shift 3 is 125 instructions a microsecond: one a cycle would be 168.
BOARD_RATES_float := 1000:3 10000:3
BOARD_RATES_double := 1000:3
BOARD_LOADS := -kernel
# Shift at which every step goes out as frames, at 10 kHz.
BOARD_FRAMES := 1
# Driven over its line by tools/hil.
BOARD_LOOP := yes
# The painted stack is compared with the call graph.
BOARD_PAINT := yes
# Real types in which the other schemes are tested.
BOARD_SCHEMES := float double
