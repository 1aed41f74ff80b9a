# shellcheck shell=sh
# What scripts need to know of a board; source it from the root of the project.
# Environment: MAKE BUILD.
MAKE=${MAKE:-make}
BUILD=${BUILD:-build}

# make_board BOARD ARGUMENT...: make for a board.
make_board() {
  made=$1
  shift
  $MAKE -s --no-print-directory BUILD="$BUILD" BOARD="$made" "$@"
}

# fact BOARD NAME: the value of BOARD_NAME in its board.mk.
fact() { make_board "$1" "board-$2"; }
