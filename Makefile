# twofold: the build, the run and the tests, which need nothing but GNU make,
# a C compiler, sh and coreutils. `make help` lists every target; what belongs
# to one room of tools/ stands in the makefile of that room.
#
#   CC=clang             another compiler
#   OPT='-O2'            another optimisation (default -O3)
#   EXTRA='-Werror'      further flags, for compiling and linking
#   BUILD=dir            another place for everything that is made
#   VARIANTS=double      only this real type
#   TESTS='tests/law/test_laws.c'   only these tests

ifeq ($(origin CC),default)
CC := gcc
endif
AR ?= ar
OPT ?= -O3
EXTRA ?=
BUILD ?= build
VARIANTS := double float
# What there are rules for, whichever of them are tested.
REALS := double float
# A switch is yes; or no or nothing, which are then the same. Another choice is
# one of some words.
must_be_one = $(if $(filter-out 1,$(words $($(1))))$(filter-out $(2),$($(1))),\
  $(error $(1) is one of: $(2); not '$($(1))'))
switch = $(if $($(1)),$(call must_be_one,$(1),yes no))$(eval override \
  $(1) := $(filter yes,$($(1))))$(eval $(if $($(1)),,un)export $(1))
$(foreach one,FEW FULL KEY_WEAK UPLINK,$(call switch,$(one)))
MAKEFLAGS += --no-builtin-rules
# A make that another one starts has its jobs.
ifeq ($(or $(MAKELEVEL),0),0)
MAKEFLAGS += -j$(shell nproc 2>/dev/null || echo 2)
endif

# The parts.
CORE := $(wildcard src/*/*.c)
CLI := $(wildcard tools/*.c tools/cli/*.c tools/cli/*/*.c)
# Of it, what reads a scene by its name or from a file.
SCENE_READER := $(wildcard tools/cli/setup/scene*.c tools/cli/text/*.c) \
  tools/cli/setup/names.c tools/decimal.c
SUPPORT := $(wildcard tests/support/*.c tests/reference/*.c)
TEST_ROOMS := tests/unit/* tests/cli tests/line tests/law tests/golden \
  tests/regress
TESTS ?= $(wildcard $(TEST_ROOMS:%=%/test_*.c) $(TEST_ROOMS:%=%/test_*.py))

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
  -ffreestanding -ffunction-sections
TOOL_FLAGS := $(COMMON) $(WARN) -Wdouble-promotion -Itools
# Tests judge in long double, so they promote on purpose. What they test and the
# reference they judge by are optimised; a test itself is compiled faster.
TEST_OPT ?= -O1
TEST_FLAGS := $(COMMON) $(WARN) -Itests -Itests/support -Itests/reference -Isrc
# Short sums of products of numbers that were just computed: in vectors they
# would wait for their stores (located step of chaos: 1.15 times the time).
SRC_FLAGS_taylor := -fno-tree-vectorize
# The command line says of which commit it is, and of which sources: of one
# commit there are as many as somebody changes them.
SOURCES := $(sort $(CORE) $(CLI) $(wildcard include/*.h include/*/*.h \
  src/*/*.h tools/*.h tools/cli/*.h tools/cli/*/*.h))
COMMIT := echo $$(git describe --always --dirty --exclude='*' 2>/dev/null || \
  echo unknown)-$$(cat $(SOURCES) | cksum | cut -d ' ' -f 1)
TOOL_FLAGS_commit = -DTF_COMMIT='"$(shell $(COMMIT))"'
FLAGS_double :=
FLAGS_float := -DTF_REAL_FLOAT
# Lanes for vectors that not every x86-64 has: the ensemble once more, under
# names of its own, which the command line takes where the processor can.
ifneq ($(filter x86_64-%,$(shell $(CC) -dumpmachine 2>/dev/null)),)
AVX2_FLAGS := -mavx2 -mtune=icelake-server $(foreach n,run step put get report,\
  $(foreach r,f32 f64,-Dtf_ensemble_$(n)_$(r)=tf_ensemble_$(n)_avx2_$(r)))
endif

.DEFAULT_GOAL := help
.SECONDARY:
.DELETE_ON_ERROR:
.PHONY: help run test quick before all clean FORCE $(REALS:%=line-%) line-csv \
  line-plotter line-keyed own-scene
# `make clean test` means one after the other, although all else is parallel.
ifneq ($(filter clean,$(MAKECMDGOALS)),)
.NOTPARALLEL:
endif

# Makes a report: $(call of_this_core,file,command) runs the command and puts
# after the title of the file that it makes of which core it is.
define of_this_core
	@core=$$(tools/stamp core) && $(2) && sed -i "1a \\\n$$core" $(1)
endef

# The makefiles of a room of tools/: $(call room,name).
room = $(wildcard tools/$(1)/*.mk tools/$(1)/*/*.mk)
BOARD_MAKEFILES := port/port.mk $(call room,board)
VERIFY_MAKEFILES := $(call room,verify) $(wildcard tests/reference/*.mk \
  tests/reference/*/*.mk)

# A target for users says what it does after `##`, on a line of its own.
define group
	@echo; echo '$(1)'
	@sed -nE 's/^([a-z-]+): ## (.*)/  make \1\t\2/p' $(2) | expand -t 25
endef
help: ## this list
	$(call group,Every day,Makefile)
	$(call group,Boards,$(BOARD_MAKEFILES))
	$(call group,Packages,$(call room,package))
	$(call group,In a browser,$(call room,page))
	$(call group,Measurements,$(call room,bench))
	$(call group,Studies and pictures,$(call room,study))
	$(call group,Verification,$(VERIFY_MAKEFILES))
	@echo
	@echo 'CC, OPT, EXTRA, BUILD, VARIANTS and TESTS: see the top of the'
	@echo 'Makefile; other variables: see the makefile of the tool.'

# What is made in one variant: $(call programs,list of sources,variant).
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
	$$(call compile,$$(TOOL_FLAGS) $$(TOOL_FLAGS_$$(*F)) $$(FLAGS_$(1)))
$(BUILD)/$(1)/tests/%.o: tests/%.c $(BUILD)/$(1)/flags
	$$(call compile,$$(TEST_FLAGS) $$(if $$(findstring /test_,$$@),\
	  $$(TEST_OPT)) $$(FLAGS_$(1)))

$(BUILD)/$(1)/libtwofold.a: $$(call objects_of_$(1),$(CORE))
	$$(archive)
$(BUILD)/$(1)/libsupport.a: $$(call objects_of_$(1),$(SUPPORT))
	$$(archive)
$(BUILD)/$(1)/lanes/avx2.o: src/ensemble/ensemble.c $(BUILD)/$(1)/flags
	$$(call compile,$$(CORE_FLAGS) $$(AVX2_FLAGS) $$(FLAGS_$(1)))
# What help prints, as strings of C.
$(BUILD)/$(1)/help.c: tools/cli/help.txt $(BUILD)/$(1)/flags
	@{ echo 'extern const char *const cli_help_text[];'; \
	echo 'const char *const cli_help_text[] = {'; \
	sed '1,/^$$$$/d; s/["\\]/\\&/g; s/.*/"&",/' $$<; echo '0};'; } >$$@
$(BUILD)/$(1)/help.o: $(BUILD)/$(1)/help.c
	$$(call compile,$$(TOOL_FLAGS))
$(BUILD)/$(1)/twofold: $$(call objects_of_$(1),$(CLI)) $(BUILD)/$(1)/help.o \
    $(if $(AVX2_FLAGS),$(BUILD)/$(1)/lanes/avx2.o) $(BUILD)/$(1)/libtwofold.a
	$$(link)
$(call programs,$(TESTS),$(1)): %: %.o $(BUILD)/$(1)/libsupport.a \
    $(BUILD)/$(1)/libtwofold.a
	$$(link)
# A test of the command line is linked with what it tests.
$(BUILD)/$(1)/tests/cli/test_decimal: $(BUILD)/$(1)/tools/decimal.o
$(BUILD)/$(1)/tests/cli/test_canard $(BUILD)/$(1)/tests/cli/test_waits: \
  $(patsubst %,$(BUILD)/$(1)/tools/cli/diverge/%.o,canard corner motion random)
endef

# Only this file is compiled again where the commit is another one.
$(REALS:%=$(BUILD)/%/tools/cli/text/commit.o): $(BUILD)/commit
$(BUILD)/commit: FORCE
	@mkdir -p $(@D)
	@commit=$$($(COMMIT)); [ "$$(cat $@ 2>/dev/null)" = "$$commit" ] || \
	  echo "$$commit" >$@

define compile
	@mkdir -p $(@D)
	@echo '  CC    $@'
	@$(CC) $(1) $(EXTRA) -MMD -MP -c $< -o $@
endef
define archive
	@echo '  AR    $@'
	@rm -f $@ && $(AR) rcs $@ $(filter %.o,$^)
endef
# Under another name first: boards that are tested side by side may run it.
define link
	@echo '  LINK  $@'
	@$(CC) $(OPT) $(EXTRA) $(filter %.o,$^) $(filter %.a,$^) -lm -o $@.$$$$ && \
	  mv $@.$$$$ $@
endef

$(foreach r,$(REALS),$(eval $(call rules,$(r))))

run: ## simulate scene chaos for 10 s, write build/chaos.csv
run: $(BUILD)/double/twofold
	@$< run chaos --t-end 10 --dt 1e-4 --every 10 --out $(BUILD)/chaos.csv
	@echo 'The trajectory is in $(BUILD)/chaos.csv. To see it:'
	@echo '  $< run chaos --realtime --live'
	@echo '  docs/page/index.html#scene=chaos in a browser'
	@echo '  python3 -m twofold plot $(BUILD)/chaos.csv (docs/USE.md, Python)'

# The tests that start the command line have it in double.
TWOFOLD := $(BUILD)/double/twofold

# What tests of the line need: the host port's firmware, by a make of its own
# with the same flags, for the board is chosen when a make begins.
line_needs = $(filter $(1:%=tests/line/test_%.%),$(TESTS))
LINE := $(if $(call line_needs,hostile hil),$(VARIANTS:%=line-%))
LINE += $(if $(call line_needs,hil),$(REALS:%=$(BUILD)/%/hil))
LINE += $(if $(call line_needs,device replay),line-double)
LINE += $(if $(call line_needs,client),$(REALS:%=line-%) $(BUILD)/double/loop)
LINE += $(if $(call line_needs,client device hil),line-keyed)
LINE += $(if $(filter tests/cli/test_endings.py,$(TESTS)),line-double \
  $(BUILD)/double/hil)
LINE += $(if $(filter tests/cli/test_sweep.py,$(TESTS)),$(BUILD)/float/twofold)
LINE += $(if $(call line_needs,replay),own-scene)
LINE += $(if $(call line_needs,streams monitor),line-csv line-plotter)
LINE += $(if $(call line_needs,make),$(BUILD)/tests/key \
  $(REALS:%=$(BUILD)/%/constants) $(BUILD)/double/hil)
line_firmware = @MAKEFLAGS= MAKELEVEL= $(MAKE) -s --no-print-directory elf \
  BOARD=host CC='$(CC)' OPT='$(OPT)' EXTRA='$(EXTRA)' BUILD='$(BUILD)' \
  SCENE=$(or $(2),chaos) RATE=1000 $(1)
$(REALS:%=line-%): line-%: $(BUILD)/%/constants
	$(call line_firmware,REAL=$* EVERY=1 STEPS=0 FORMAT=frames UPLINK=yes \
	  NAMED=-line)
line-csv line-plotter: line-%: $(BUILD)/float/constants
	$(call line_firmware,REAL=float EVERY=5 STEPS=400 FORMAT=$* UPLINK= \
	  NAMED=-$*)
line-keyed: $(BUILD)/double/constants $(BUILD)/tests/key
	$(call line_firmware,REAL=double BAUD=115200 FORMAT=frames UPLINK=yes \
	  KEY=$(BUILD)/tests/key NAMED=-keyed)
$(BUILD)/tests/key:
	@mkdir -p $(@D); umask 077; echo 001F3E5D7C9BBAD9F81736557493B2D1 >$@
own-scene: $(BUILD)/double/constants
	$(call line_firmware,REAL=double EVERY=1 STEPS=2000 FORMAT=frames \
	  NAMED=-own,tests/data/own.scene)

test: ## all tests, in double and in float (or TESTS=...)
test: $(foreach v,$(VARIANTS),$(call programs,$(TESTS),$(v))) $(TWOFOLD) $(LINE)
	@TWOFOLD=$(TWOFOLD) FIRMWARE=$(BUILD)/boards/host/chaos \
	  REALS='$(VARIANTS)' tests/run $(filter %.py,$(TESTS)) \
	  $(filter-out $(TWOFOLD) $(LINE),$^)

# What one runs while working: one real type, compiled fast. Of the tests the
# core set, which is what then takes a quarter of a second at most and starts no
# program, with the laws; and the unit tests of each room of src/ in which git
# sees a change, but those of more than two seconds. `make test` has them all.
NEVER_QUICK := convergence corpus ensemble extremes frame golden \
  located located_report pinned reference signs
NOT_QUICK := $(NEVER_QUICK) begin canard codim2 compensated degraded friction \
  kernel located_budget normal_form paper_claims population rest singularity \
  turntable tyre
CHANGED = $(sort $(foreach file,$(shell git status --porcelain -uall -- src \
  2>/dev/null),$(word 2,$(subst /, ,$(filter src/%,$(file))))))
but_for = $(filter-out $(1:%=\%/test_%.c),$(filter %.c,$(2)))
QUICK_TESTS = $(sort $(call but_for,$(NOT_QUICK),$(TESTS)) $(call \
  but_for,$(NEVER_QUICK),$(filter $(CHANGED:%=tests/unit/%/%),$(TESTS))))
quick: ## short laws and tests, units of changed rooms; double
	@echo 'the core set$(CHANGED:%=, tests/unit/%); left out (make test):' \
	  'float and $(words $(filter-out $(QUICK_TESTS),$(TESTS))) of' \
	  '$(words $(TESTS)) programs'
	@MAKEFLAGS= MAKELEVEL= $(MAKE) -s --no-print-directory test \
	  VARIANTS=double OPT=-O1 BUILD='$(BUILD)/quick' TWOFOLD= \
	  TESTS='$(QUICK_TESTS)'

before: ## TESTS=... by the core of OTHER=commit, then by this one
	@CC='$(CC)' OPT='$(OPT)' EXTRA='$(EXTRA)' BUILD='$(BUILD)' \
	  VARIANTS='$(VARIANTS)' tools/before '$(OTHER)' \
	  $(if $(filter file,$(origin TESTS)),,$(TESTS))

all: ## compile everything: core, command line, tests, tools
all: $(foreach v,$(VARIANTS),$(BUILD)/$(v)/twofold \
  $(call programs,$(TESTS),$(v)))

clean: ## remove what was made
	rm -rf $(BUILD)

include $(BOARD_MAKEFILES) \
  $(foreach r,package page bench study,$(call room,$(r))) $(VERIFY_MAKEFILES)

-include $(shell find $(BUILD) -path '$(BUILD)/check' -prune \
  -o -path '$(BUILD)/quick' -prune -o -path '$(BUILD)/before' -prune \
  -o -name '*.d' -type f -print 2>/dev/null)
