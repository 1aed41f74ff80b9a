# Linux on an Arm without FPU (armel), in QEMU's user mode: 32 bits.
BOARD_IS := Arm, ARMv5
BOARD_TOOLS := arm-linux-gnueabi-
BOARD_PACKAGES := gcc-arm-linux-gnueabi libc6-dev-armel-cross qemu-user
BOARD_FLAGS := -static -marm
# Its own, because that of libgcc is not always rounded right (docs/PORTS.md).
ADD_double := port/arch/double_add.c
WRAP_double := -Wl,--wrap=__aeabi_dadd,--wrap=__aeabi_dsub,--wrap=__aeabi_drsub
BOARD_SOURCES := port/host/board.c $(ADD_$(REAL))
BOARD_LINK := $(WRAP_$(REAL)) -lm
BOARD_REALS := float double
BOARD_RUN := qemu-arm
BOARD_STEPS := 100000
BOARD_RATES_float := 100
BOARD_SHARED := yes
