# twofold. `make help` says what can be made. Nothing but GNU make, a C
# compiler, sh and coreutils is needed for `make run` and `make test`.
#
#   CC=clang             another compiler
#   OPT='-O2'            another optimisation (default -O3)
#   EXTRA='-Werror'      further flags, for compiling and linking
#   BUILD=dir            another place for everything that is made
#   TESTS='tests/law/test_order.c'   only these tests

ifeq ($(origin CC),default)
CC := gcc
endif
AR ?= ar
OPT ?= -O3
EXTRA ?=
BUILD ?= build
VARIANTS := double float
MAKEFLAGS += --no-builtin-rules -j$(shell nproc 2>/dev/null || echo 2)

# The parts.
CORE := $(wildcard src/*/*.c)
CLI := $(wildcard tools/*.c tools/cli/*.c tools/cli/*/*.c)
SUPPORT := $(wildcard tests/support/*.c)
TEST_ROOMS := tests/unit tests/unit/* tests/cli tests/line tests/law tests/golden \
  tests/regress
TESTS ?= $(wildcard $(TEST_ROOMS:%=%/*.c) $(TEST_ROOMS:%=%/*.sh))
BENCH := tools/bench/steps.c tools/bench/race.c tools/bench/compensated.c \
  tools/bench/ensemble.c tools/bench/frame.c
STABILITY := $(wildcard tools/stability/*.c)
COUNTS := nearest machines
PEERS := hand twofold reference
ORACLE := $(wildcard tools/oracle/*.c)
REPORT := sweep scatter cost digits scenes
HIL_PARTS := $(wildcard tools/hil/*.c) tools/cli/host/source.c \
  tools/cli/host/host.c

# One rounding per operation, everywhere: the same bits on every target.
COMMON := -std=c99 $(OPT) -ffp-contract=off -Iinclude
WARN := -Wall -Wextra -pedantic -Wconversion -Wsign-conversion \
  -Wfloat-conversion -Wshadow -Wvla -Wstrict-prototypes -Wmissing-prototypes \
  -Wmissing-declarations -Wold-style-definition -Wredundant-decls \
  -Wnested-externs -Wcast-qual -Wcast-align -Wpointer-arith -Wwrite-strings \
  -Wbad-function-cast -Wundef -Wformat=2 -Wswitch-enum -Wnull-dereference \
  -Wimplicit-fallthrough -Wunused-macros
# The core neither knows errno nor a C library.
CORE_FLAGS := $(COMMON) $(WARN) -Wdouble-promotion -fno-math-errno \
  -ffreestanding
TOOL_FLAGS := $(COMMON) $(WARN) -Wdouble-promotion -Itools
# Tests judge in long double, so they promote on purpose.
TEST_FLAGS := $(COMMON) $(WARN) -Itests -Itests/support -Isrc
# Short sums of products of numbers that were just computed: in vectors they
# would wait for their stores (located step of chaos: 1.15 times the time).
SRC_FLAGS_taylor := -fno-tree-vectorize
FLAGS_double :=
FLAGS_float := -DTF_REAL_FLOAT

.DEFAULT_GOAL := help
.SECONDARY:
.DELETE_ON_ERROR:
.PHONY: help all run test bench bench-compensated bench-ensemble bench-frame \
  bench-peers bench-steps stability report keep-report oracle check \
  clean firmware elf boards boards-list test-boards size deps statistics \
  hil mutation witnesses eva valgrind bounds keep-bounds \
  $(VARIANTS:%=line-%) FORCE
# `make clean test` means one after the other, although all else is parallel.
ifneq ($(filter clean,$(MAKECMDGOALS)),)
.NOTPARALLEL:
endif

help:
	@echo 'make run     simulate scene chaos for 10 s, write $(BUILD)/chaos.csv'
	@echo 'make test    all tests, in double and in float'
	@echo 'make bench   report: error against time, cost (gnuplot, valgrind)'
	@echo 'make report  bench-peers, stability and bench in one go (minutes)'
	@echo 'make keep-report  copies the reports of the build to docs/'
	@echo 'make bench-steps   cost of a Moreau step alone (valgrind)'
	@echo 'make stability  stiff and extreme cases: tables and map (gnuplot)'
	@echo 'make statistics  exits and returns of chaos, counted (10 minutes)'
	@echo 'make bench-compensated   errors of small steps, carried or not'
	@echo 'make bench-ensemble   many states at once (try EXTRA=-mavx2)'
	@echo 'make bench-frame      frames decoded and made, MB/s'
	@echo 'make bench-peers  error over time beside other tools (SUNDIALS, ...)'
	@echo 'make check   warnings, format, static analysis, sanitizers, promises'
	@echo 'make fuzz SECONDS=30   random inputs against the promises (clang)'
	@echo 'make fuzz-merge     what fuzzing found, into tests/corpus'
	@echo 'make soak STEPS=1e9    chaos for so many steps, then a replay'
	@echo 'make mutation SAMPLE=60   wrong changes of src/ for tests to notice'
	@echo 'make witnesses SAMPLE=2000 for each test a change that it fails for'
	@echo 'make eva     undefined behaviour, by Frama-C Eva: all entries (minutes)'
	@echo 'make valgrind  every test for a minute of memcheck (valgrind)'
	@echo 'make oracle  remake tests/data/reference*.h (minutes; libquadmath)'
	@echo 'make firmware SCENE=chaos BOARD=microbit REAL=float   (port/port.mk)'
	@echo 'make boards  firmware of every board;  make deps installs compilers'
	@echo 'make test-boards  bits and real time of every board, in emulators'
	@echo 'make figures  the pictures of docs/FIGURES.md (gnuplot)'
	@echo 'make keep-figures  copies them to docs/figures/'
	@echo 'make hil BOARD=stm32f405   a controller drives it over its line'
	@echo 'make size    flash, RAM, stack, instructions of every board'
	@echo 'make bounds EVALUATIONS=100000   worst cost, stack of every function'
	@echo 'make keep-bounds  copies them to docs/ and into the headers'
	@echo 'make all     compile everything: core, command line, tests, bench'
	@echo 'make clean   remove $(BUILD)/'
	@echo 'Variables: CC OPT EXTRA BUILD TESTS; see the top of the Makefile.'

# What is made in one variant: $(call programs,tests or bench,variant).
programs = $(patsubst %.c,$(BUILD)/$(2)/%,$(filter %.c,$(1)))

# The rules of one variant. The file `flags` changes when the compiler, a flag
# or the list of files does; all else in the variant is older than it then. The
# name of the new one is its maker's own: boards are tested side by side.
define rules
objects_of_$(1) = $$(patsubst %.c,$(BUILD)/$(1)/%.o,$$(1))

$(BUILD)/$(1)/flags: FORCE
	@mkdir -p $$(@D)
	@new=$$@.$$$$$$$$; \
	echo '$$(CC) $$(CORE_FLAGS) $$(TOOL_FLAGS) $$(TEST_FLAGS) $$(EXTRA)' \
	  '$$(CORE) $$(CLI) $$(SUPPORT)' >$$$$new; \
	if cmp -s $$$$new $$@; then rm $$$$new; else mv $$$$new $$@; fi

$(BUILD)/$(1)/src/%.o: src/%.c $(BUILD)/$(1)/flags
	$$(call compile,$$(CORE_FLAGS) $$(SRC_FLAGS_$$(*F)) $$(FLAGS_$(1)))
$(BUILD)/$(1)/tools/%.o: tools/%.c $(BUILD)/$(1)/flags
	$$(call compile,$$(TOOL_FLAGS) $$(FLAGS_$(1)))
$(BUILD)/$(1)/tests/%.o: tests/%.c $(BUILD)/$(1)/flags
	$$(call compile,$$(TEST_FLAGS) $$(FLAGS_$(1)))

$(BUILD)/$(1)/libtwofold.a: $$(call objects_of_$(1),$(CORE))
	$$(archive)
$(BUILD)/$(1)/libsupport.a: $$(call objects_of_$(1),$(SUPPORT))
	$$(archive)
$(BUILD)/$(1)/twofold: $$(call objects_of_$(1),$(CLI)) \
    $(BUILD)/$(1)/libtwofold.a
	$$(link)
$(call programs,$(TESTS),$(1)): %: %.o $(BUILD)/$(1)/libsupport.a \
    $(BUILD)/$(1)/libtwofold.a
	$$(link)
$(call programs,$(BENCH),$(1)): %: %.o \
    $(BUILD)/$(1)/tools/bench/rk4_smooth.o $(BUILD)/$(1)/libtwofold.a
	$$(link)
$(REPORT:%=$(BUILD)/$(1)/tools/report/%): %: %.o \
    $(BUILD)/$(1)/tools/report/part.o $(BUILD)/$(1)/tools/report/truth.o \
    $(BUILD)/$(1)/libsupport.a $(BUILD)/$(1)/libtwofold.a
	$$(link)
$(BUILD)/$(1)/hil: $$(call objects_of_$(1),$(HIL_PARTS)) $(BUILD)/$(1)/libtwofold.a
	$$(link)
$(BUILD)/$(1)/tools/stability/sweep: $$(call objects_of_$(1),$(STABILITY)) \
    $(BUILD)/$(1)/libtwofold.a
	$$(link)
endef

define compile
	@mkdir -p $(@D)
	@echo '  CC    $@'
	@$(CC) $(1) $(EXTRA) -MMD -MP -c $< -o $@
endef
define archive
	@echo '  AR    $@'
	@rm -f $@ && $(AR) rcs $@ $(filter %.o,$^)
endef
define link
	@echo '  LINK  $@'
	@$(CC) $(OPT) $(EXTRA) $(filter %.o %.a,$^) -lm -o $@
endef

$(foreach v,$(VARIANTS),$(eval $(call rules,$(v))))

all: $(foreach v,$(VARIANTS),$(BUILD)/$(v)/twofold \
  $(call programs,$(TESTS),$(v)) $(call programs,$(BENCH),$(v)) \
  $(BUILD)/$(v)/tools/stability/sweep $(BUILD)/$(v)/hil \
  $(REPORT:%=$(BUILD)/$(v)/tools/report/%))

run: $(BUILD)/double/twofold
	@$< run chaos --t-end 10 --dt 1e-4 --every 10 --out $(BUILD)/chaos.csv
	@echo 'The trajectory is in $(BUILD)/chaos.csv.'

# What tests of the line need: the host port's firmware, by a make of its own
# with the same flags, for the board is chosen when a make begins.
LINE := $(if $(filter %/test_line.c %/test_hil.sh,$(TESTS)),\
  $(foreach v,$(VARIANTS),$(BUILD)/$(v)/hil line-$(v)))
$(VARIANTS:%=line-%): line-%: $(BUILD)/%/constants
	@MAKEFLAGS= MAKELEVEL= $(MAKE) -s --no-print-directory elf BOARD=host \
	  CC='$(CC)' OPT='$(OPT)' EXTRA='$(EXTRA)' BUILD='$(BUILD)' SCENE=chaos \
	  REAL=$* RATE=1000 EVERY=1 STEPS=0 FORMAT=frames UPLINK=yes NAMED=-line

test: $(foreach v,$(VARIANTS),$(call programs,$(TESTS),$(v))) \
  $(BUILD)/double/twofold $(LINE)
	@TWOFOLD=$(BUILD)/double/twofold FIRMWARE=$(BUILD)/boards/host/chaos \
	  tests/run $(filter-out $(BUILD)/double/twofold $(LINE),$^) \
	  $(filter %.sh,$(TESTS))

bench: $(foreach v,$(VARIANTS),$(call programs,$(BENCH),$(v)) \
  $(REPORT:%=$(BUILD)/$(v)/tools/report/%))
	@CC='$(CC)' OPT='$(OPT)' BUILD='$(BUILD)' tools/report/run

# The copies in docs/ are those of the last `make bench` and `make stability`.
keep-report:
	cp $(BUILD)/REPORT.md docs/
	mkdir -p docs/report
	cp $(BUILD)/report/*.svg docs/report/
	if [ -e $(BUILD)/STABILITY.md ]; then cp $(BUILD)/STABILITY.md docs/ && \
	  mkdir -p docs/stability && cp $(BUILD)/stability/*.png docs/stability/; fi

# All reports of one commit and compiler, one after the other: none disturbs
# what another measures.
report:
	@$(MAKE) bench-peers
	@$(MAKE) stability
	@$(MAKE) bench

bench-steps: $(foreach v,$(VARIANTS),$(call programs,$(BENCH),$(v)))
	@CC='$(CC)' BUILD='$(BUILD)' tools/bench/run

stability: $(foreach v,$(VARIANTS),$(BUILD)/$(v)/tools/stability/sweep)
	@CC='$(CC)' BUILD='$(BUILD)' tools/stability/run

$(COUNTS:%=$(BUILD)/statistics/%): $(BUILD)/statistics/%: \
    $(BUILD)/double/tools/statistics/%.o $(BUILD)/double/libtwofold.a
	@mkdir -p $(@D)
	$(link)

statistics: $(BUILD)/double/twofold $(COUNTS:%=$(BUILD)/statistics/%)
	@BUILD='$(BUILD)' tools/statistics/study

bench-compensated: $(foreach v,$(VARIANTS),$(BUILD)/$(v)/tools/bench/compensated)
	@BUILD='$(BUILD)' tools/bench/compensated.sh

bench-ensemble: $(foreach v,$(VARIANTS),$(BUILD)/$(v)/tools/bench/ensemble)
	@for v in $(VARIANTS); do echo "== $$v" && \
	  $(BUILD)/$$v/tools/bench/ensemble || exit 1; done

bench-frame: $(foreach v,$(VARIANTS),$(BUILD)/$(v)/tools/bench/frame)
	@for v in $(VARIANTS); do echo "== $$v" && \
	  $(BUILD)/$$v/tools/bench/frame || exit 1; done

# Other tools on the same problems. What is not the project's own may use all
# that the processor has. SUNDIALS, Siconos and Octave are built or left out by
# tools/peers/run; the rest is built here.
RIVAL_FLAGS = $(TOOL_FLAGS) -march=native -ffp-contract=fast
$(BUILD)/peers/%.o: tools/%.c $(BUILD)/double/flags
	$(call compile,$(RIVAL_FLAGS))
$(PEERS:%=$(BUILD)/peers/%): $(BUILD)/peers/%: $(BUILD)/peers/peers/%.o \
    $(BUILD)/peers/peers/sweep.o $(BUILD)/peers/peers/problem.o \
    $(BUILD)/peers/bench/rk4_smooth.o $(BUILD)/double/libtwofold.a
	$(link)

bench-peers: $(PEERS:%=$(BUILD)/peers/%)
	@CC='$(CC)' BUILD='$(BUILD)' tools/peers/run

# Reference solutions in quadruple precision, one process a problem. Always by
# gcc: __float128 and libquadmath are its own.
ORACLE_GCC ?= gcc
$(BUILD)/oracle: $(ORACLE) $(wildcard tools/oracle/*.h)
	@mkdir -p $(@D)
	@echo '__float128 sqrtq(__float128); int main(int n, char **a)' \
	  '{ (void)a; return sqrtq(n) < 0; }' | \
	  $(ORACLE_GCC) -x c - -lquadmath -o $@ 2>/dev/null || { rm -f $@; \
	  echo 'make oracle needs gcc with libquadmath, on a processor that it is' \
	  'made for, as x86-64 (Debian: apt-get install gcc).'; exit 1; }
	$(ORACLE_GCC) $(filter-out -Iinclude,$(COMMON)) $(WARN) $(EXTRA) \
	  $(ORACLE) -lquadmath -o $@

oracle: $(BUILD)/oracle
	@$< names | xargs -P $(shell nproc 2>/dev/null || echo 2) -I NAME \
	  sh -c '$< NAME >$(BUILD)/NAME.new && \
	    mv $(BUILD)/NAME.new tests/data/reference_NAME.h'
	@$< index >$(BUILD)/index.new && mv $(BUILD)/index.new \
	  tests/data/reference.h
	@echo 'The references are in tests/data/.'

include port/port.mk
include tools/figures/figures.mk
include tools/fuzz/fuzz.mk
include tools/cost/cost.mk

# Every entry of the analysis; check `eva` has the short ones.
eva:
	@BUILD='$(BUILD)' tools/eva/run $(ENTRIES)

# Each test program for a minute at most; check `valgrind` takes the quick ones.
valgrind:
	@MAKEFLAGS= MAKELEVEL= BUILD='$(BUILD)/check' tools/check/valgrind.sh all

# The checks choose their own compilers and flags.
check:
	@MAKEFLAGS= MAKELEVEL= BUILD='$(BUILD)/check' tools/check/run $(CHECKS)

# SAMPLE=0 tries every change (hours), SEED=2 others than SEED=1, AGAIN=1 goes
# on where a run was stopped and tries again what survived.
SAMPLE ?= 60
SEED ?= 1
AGAIN ?=
mutation witnesses:
	@CC='$(CC)' BUILD='$(BUILD)' SAMPLE='$(SAMPLE)' SEED='$(SEED)' \
	  AGAIN='$(AGAIN)' tools/mutation/run $(filter witnesses,$@)

clean:
	rm -rf $(BUILD)

-include $(shell find $(BUILD) -name '*.d' 2>/dev/null)
