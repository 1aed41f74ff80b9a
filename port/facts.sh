# shellcheck shell=sh
# What scripts ask of a board; they source this from the root of the project.
# Environment: MAKE BUILD.
MAKE=${MAKE:-make}
BUILD=${BUILD:-build}

# make_board BOARD ARGUMENT...: make for a board.
make_board() {
  made=$1
  shift
  $MAKE -s --no-print-directory BUILD="$BUILD" BOARD="$made" "$@"
}

# fact BOARD NAME: what its board.mk says.
fact() { make_board "$1" "board-$2"; }
