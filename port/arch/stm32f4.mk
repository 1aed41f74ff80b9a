# What boards with an STM32F405 or one of its relatives share; each defines what
# port/arch/stm32f4.c asks for in STM32F4_FLAGS.
BOARD_IS := Arm, Cortex-M4F
BOARD_TOOLS := arm-none-eabi-
BOARD_PACKAGES := gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm
BOARD_FLAGS := -ffreestanding -mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 \
  -mfloat-abi=hard $(STM32F4_FLAGS)
# Its own, because that of libgcc is not always rounded right (docs/PORTS.md).
ADD_double := port/arch/double_add.c
WRAP_double := -Wl,--wrap=__aeabi_dadd,--wrap=__aeabi_dsub,--wrap=__aeabi_drsub
BOARD_SOURCES := port/arch/stm32f4.c port/arch/cortex_m.c \
  port/arch/cortex_m_tick.c port/arch/memory.c $(ADD_$(REAL))
BOARD_LINK := -nostartfiles -Lport/arch -Tport/$(BOARD)/board.ld \
  -Wl,--defsym=sqrt=__ieee754_sqrt $(WRAP_$(REAL)) -lm
BOARD_REALS := float double
BOARD_BAUDS := 115200 1000000 2000000
BOARD_LOADS := -kernel
BOARD_STEPS := 100000
# Driven over its line by tools/board/hil.
BOARD_LOOP := yes
# What of tests/target/fault.c ends with a word.
BOARD_FAULTS := stack bus
BOARD_WATCHDOG := yes
