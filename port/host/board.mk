# This machine: POSIX. TWOFOLD_PORT says where the serial line goes (board.c);
# TWOFOLD_REALTIME=1 asks for real-time priority.
BOARD_IS := $(shell uname -m)
BOARD_CC := $(CC)
BOARD_PACKAGES := gcc
BOARD_OPT := -O2
BOARD_REALS := float double
BOARD_STEPS := 100000
BOARD_LINK := -lm
BOARD_RUN := env
# Its time is that of a computer with other work: overruns are reported, not
# judged.
BOARD_RATES_float := 1000
BOARD_SHARED := yes
BOARD_BOOT := count of starts in the file TWOFOLD_BOOT
BOARD_STARTS := yes
# The command that gives it a pseudo-terminal and prints the name of that.
BOARD_LINE := env TWOFOLD_PORT=pty
# Driven over its line by tools/board/hil.
BOARD_LOOP := yes
# Compiles double alone, and links without sections.
BOARD_DOUBLE_ONLY := BOARD_CC=tcc BOARD_GC=
