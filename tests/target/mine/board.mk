# The host port with one mistake (board.c.in); FAULT is that of kit.py.
BOARD_CC := gcc
BOARD_PACKAGES := gcc
BOARD_FLAGS := -frounding-math -DFAULT=$(FAULT)
BOARD_REALS := float double
BOARD_STEPS := $(if $(filter 9,$(FAULT)),,1000)
BOARD_LINK := -lm
BOARD_RUN := env
BOARD_RATES_float := 1000
BOARD_SHARED := yes
