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
# float, double or both; rates of its line, the default first, none where it has
# no rate.
BOARD_REALS :=
BOARD_BAUDS :=
# The emulator, the option that loads a program into it, steps of a test, and
# loop rates RATE[:SHIFT] with 2^SHIFT ns an instruction.
BOARD_RUN :=
BOARD_LOADS :=
BOARD_STEPS :=
BOARD_RATES_float :=
BOARD_RATES_double :=

# Optional:
#   BOARD_IS := WORDS       its architecture, for `make hashes`
#   BOARD_CC, BOARD_OPT     the compiler by its full name; optimisation
#   BOARD_DOUBLE_ONLY := VARIABLES   by which only double can be compiled
#   BOARD_WITHOUT           warnings that this compiler does not know
#   BOARD_SMALL := yes      room for one scene and text alone, locked
#   BOARD_SCENES := SCENES  that it has room for, the default first
#   BOARD_LARGER := BOARD   which has room for the others
#   BOARD_IMAGE := COMMAND  what is made of the ELF, its last argument
#   BOARD_BOOT := WORDS     there is a port_boot(): what its number comes from
#   BOARD_WATCHDOG := yes   there is a port_feed(), which WATCHDOG needs
#   BOARD_WATCHED := COMMAND   an emulator that has it, if BOARD_RUN has none
#   BOARD_FAULTS := KINDS   of tests/target/fault.c that end with a word
#   BOARD_LIKE := BOARD     with this processor, whose steps are counted
#   BOARD_STARTS := yes     the emulator has that
#   BOARD_HERE := COMMAND   fails where the emulator is not here, and says so
#   BOARD_NPM := PACKAGES   of npm, for `make deps`
#   BOARD_DEAF := yes       nothing comes in over its line
#   BOARD_SHARED := yes     runs in the host's time: overruns are not judged
#   BOARD_LATE := RATE:SHIFT  at which every step is too late
#   BOARD_FRAMES := SHIFT   at which every step goes out as frames, at 1 kHz
#   BOARD_SCHEMES := REALS  in which the other schemes are tested
#   BOARD_PAINT := yes      the painted stack is compared with the call graph
#   BOARD_LOOP := yes       driven over its line by tools/board/hil
#   BOARD_LINE := COMMAND   gives it a line and prints the name of that
