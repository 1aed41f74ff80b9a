# A board to copy: what `make` needs to know of it.
$(error port/template is a board to copy, not one to build)

# Prefix of the compiler's name, and Debian's packages for it and an emulator.
BOARD_TOOLS :=
BOARD_PACKAGES :=
# Processor and ABI; startup code of its family from port/arch; linker script.
# -DBOARD_SMALL keeps the parts of a step functions: half the flash.
BOARD_FLAGS :=
BOARD_SOURCES :=
BOARD_LINK :=
# float, double or both.
BOARD_REALS :=
# The emulator, the option that loads a program into it, steps of a test, and
# loop rates RATE[:SHIFT] with 2^SHIFT ns an instruction.
BOARD_RUN :=
BOARD_LOADS :=
BOARD_STEPS :=
BOARD_RATES_float :=
BOARD_RATES_double :=
