# Linux on s390x, in QEMU's user mode: 64 bits, the highest byte first.
BOARD_IS := s390x
BOARD_TOOLS := s390x-linux-gnu-
BOARD_PACKAGES := gcc-s390x-linux-gnu libc6-dev-s390x-cross qemu-user
# gcc computes float as double there, if C99 is not to be kept to otherwise.
BOARD_FLAGS := -static -fexcess-precision=fast
BOARD_SOURCES := port/host/board.c
BOARD_LINK := -lm
BOARD_REALS := float double
BOARD_RUN := qemu-s390x
BOARD_STEPS := 100000
BOARD_RATES_float := 100
BOARD_SHARED := yes
# FLT_EVAL_METHOD 1: of no effect on double.
BOARD_DOUBLE_ONLY := EXTRA=-fexcess-precision=standard
