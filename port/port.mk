# Firmware. Included by the Makefile.
#
#   SCENE=           a scene, by its name or its file (one with a . or a / in
#                    its name), or `generic`: all of them, chosen by START; by
#                    default `chaos`, or the first that the board has room for
#   START=chaos      the scene that a generic firmware runs
#   BOARD=host       a folder of port/
#   REAL=float       or double
#   SCHEME=          moreau, located or compensated; by default compensated
#                    in float above 1 kHz, where moreau may stand still, else
#                    moreau
#   SPLIT=yes        or no: saves 1 kB; a step that would be split is then of
#                    order 1, and TF_COARSE (DESIGN.md, section 3)
#   RATE=1000        steps a second; dt is 1/RATE
#   STEPS=0          how many; 0 without end
#   FORMAT=plotter   or csv, or frames (docs/PROTOCOL.md)
#   UPLINK=no        or yes: takes commands (frames); else locked
#   DEADMAN=         ticks that inputs from the uplink hold, 0 without end; by
#                    default those of half a second
#   KEY=             a file of 32 hexadecimal digits and white space behind
#                    them, which its owner alone may read: commands need the
#                    tag of this key
#   KEY_WEAK=no      or yes: also where a board cannot tell one start from the
#                    others
#   BAUD=            of its line, of those that it has; for `host` of the line
#                    that it is to have, where that has a rate
#   OVERRUN=skip     or stop: what the loop does about a step that ends too late
#   EVERY=           steps from record to record; by default 50 records a second
#   WATCHDOG=        [ms], by default none: its time, where a board has one
#   CLOCK=           [Hz] of the processor: says how much of a tick the worst
#                    known step takes, and refuses more than all of it
#   ONLY='host uno'  the boards for `make test-boards`
#   PROGRAM=firmware or trajectory, window, stack, deadman, fault, kit,
#                    contacts (tests/target), calls (tools/verify/cost);
#                    wasm32: module
#   OTHERS=          of a generic trajectory: a bit for each further scene

BOARDS := $(filter-out template,$(patsubst port/%/board.mk,%,\
  $(wildcard port/*/board.mk)))
START ?= chaos
BOARD ?= host
REAL ?= float
RATE ?= 1000
STEPS ?= 0
FORMAT ?= plotter
PROGRAM ?= firmware
SPLIT ?= yes
# A function that is inlined once may make its caller large: without, what is
# called from one place stays a function with a frame of its own. The others
# save 1 % of flash and 2 % of stack on Cortex-M, and cost no step more than
# 0.6 %: gcc copies up to 15 statements to save a jump, and keeps what a loop
# does not change in registers that Thumb does not have.
BOARD_OPT ?= -Os --param large-function-growth=1000 \
  --param max-jump-thread-duplication-stmts=14 -fipa-pta \
  -fno-move-loop-invariants

.PHONY: firmware boards test-boards hashes deps elf boards-list
firmware: ## of SCENE=chaos for BOARD=microbit in REAL=float

boards-list:
	@echo '$(BOARDS)'

test-boards: ## bits and real time of every board, in emulators
	@BUILD='$(BUILD)' tools/run boards $(ONLY)

hashes: ## trajectory hashes of every architecture (or ONLY=uno)
	@for board in $(or $(ONLY),$(BOARDS)); do \
	  for real in $$($(MAKE) -s board-REALS BOARD=$$board); do \
	    $(MAKE) -s board-hash BOARD=$$board REAL=$$real PROGRAM=trajectory \
	      NAMED=-hash; done; done | grep --line-buffered -v '^  '

boards: ## firmware for every board whose compiler is here
	@for board in $(or $(ONLY),$(BOARDS)); do \
	  $(MAKE) -s --no-print-directory firmware BOARD=$$board || \
	    [ $$? -eq 2 ] || exit 1; done

deps: ## install compilers and emulators (apt-get, npm)
	apt-get install -y --no-install-recommends \
	  $(sort $(shell sed -n \
	  's/^BOARD_PACKAGES := //p; s/^  \(qemu[a-z-]*\)$$/\1/p' \
	  $(wildcard port/*/board.mk port/arch/*.mk) | tr -d '\\'))
	command -v npm >/dev/null || \
	  apt-get install -y --no-install-recommends npm
	npm install -g $(sort $(shell sed -n 's/^BOARD_NPM := //p' \
	  $(wildcard port/*/board.mk)))

ifneq ($(filter firmware elf call-graph tick-budget board-%,$(MAKECMDGOALS)),)
ifeq ($(wildcard port/$(BOARD)/board.mk),)
$(error No board is named $(BOARD); there are: $(BOARDS))
endif
include port/$(BOARD)/board.mk
$(call switch,BOARD_SMALL)
$(call switch,BOARD_SHARED)
$(call must_be_one,REAL,$(or $(BOARD_REALS),$(REALS)))
$(call must_be_one,FORMAT,plotter csv frames)
$(call must_be_one,SPLIT,yes no)
$(call must_be_one,PROGRAM,firmware trajectory window stack deadman fault kit \
  calls contacts$(if $(SOURCE_module), module))
$(if $(OVERRUN),$(call must_be_one,OVERRUN,skip stop))
$(if $(SCHEME),$(call must_be_one,SCHEME,moreau located compensated))
# Whole, of at most 32 bits, to which the compiler would cut it, and without the
# zero in front by which it would be octal.
is_whole = $(shell echo '$(strip $(1))' | grep -Exq '0|[1-9][0-9]{0,9}' && \
  [ $(strip $(1)) -ge $(2) ] && [ $(strip $(1)) -lt 4294967296 ] && echo yes)
must_be_whole = $(if $(call is_whole,$($(1)),$(2)),,$(error $(1) must be a \
  whole number in [$(2), 4294967295], not '$($(1))'))
$(call must_be_whole,RATE,1)
$(call must_be_whole,STEPS,0)
EVERY ?= $(shell echo $$((($(RATE) + 49) / 50)))
$(call must_be_whole,EVERY,1)
$(if $(DEADMAN),$(call must_be_whole,DEADMAN,0))
$(if $(WATCHDOG),$(call must_be_whole,WATCHDOG,2)$(if $(BOARD_WATCHDOG),,\
  $(error $(BOARD) has no watchdog: BOARD_WATCHDOG, docs/PORTS.md)))
$(if $(CLOCK),$(call must_be_whole,CLOCK,1))
# The scenes that a board has room for, where not for all.
BOARD_SCENE := $(or $(firstword $(BOARD_SCENES)),chaos)
SCENE ?= $(BOARD_SCENE)
$(foreach one,SCENE START KEY,$(if $(word 2,$($(one))),$(error \
  $(one)='$($(one))' has a blank, and make takes it for two names)))

ifneq ($(BOARD_SMALL),)
ifneq ($(filter generic,$(SCENE))$(filter-out plotter csv,$(FORMAT))$(UPLINK),)
$(error $(BOARD) takes one scene and text or CSV, locked: docs/PORTS.md)
endif
endif

BAUD ?= $(firstword $(BOARD_BAUDS))
$(if $(BAUD),$(call must_be_whole,BAUD,10)$(call must_be_one,BAUD,$(or \
  $(BOARD_BAUDS),$(BAUD))))

BOARD_CC ?= $(BOARD_TOOLS)gcc
BOARD_GC ?= -Wl,--gc-sections

# Test programs keep the dt of the scene.
RATE_OF_firmware := $(RATE)
RATE_OF_stack := $(RATE)
RATE_OF_deadman := $(RATE)
RATE_OF_kit := $(RATE)
RATE_OF_fault := $(RATE)
FIRMWARE_RATE := $(RATE_OF_$(PROGRAM))

ifneq ($(filter board-hash,$(MAKECMDGOALS)),)
STEPS := $(BOARD_STEPS)
endif

# In float a plain step of less than 1 ms may stand still (DESIGN.md, section
# 11). Commands change the machine, which the compensated step has no form of,
# and a small board has no room for it: both keep to moreau, which says so.
ifeq ($(PROGRAM)-$(REAL)-$(UPLINK)-$(BOARD_SMALL),firmware-float--)
ifeq ($(shell [ $(RATE) -gt 1000 ] && echo fast),fast)
SCHEME ?= compensated
endif
endif
SCHEME ?= moreau
PLACE := $(BUILD)/boards/$(BOARD)/$(notdir $(SCENE))-$(REAL)
# NAMED distinguishes programs of one kind.
FIRMWARE := $(PLACE)/$(PROGRAM)$(NAMED).elf

SOURCE_firmware := port/main.c port/firmware.c port/loop.c
SOURCE_trajectory := tests/target/trajectory.c
SOURCE_stack := tests/target/stack.c port/firmware.c port/loop.c
SOURCE_deadman := tests/target/deadman.c port/loop.c
SOURCE_fault := tests/target/fault.c port/loop.c
SOURCE_window := tests/target/window.c
SOURCE_kit := tests/target/kit.c
SOURCE_calls := tools/verify/cost/board.c
SOURCE_contacts := tests/target/contacts.c
FIRMWARE_SOURCES := $(SOURCE_$(PROGRAM)) port/hooks.c \
  $(wildcard port/$(BOARD)/*.c) $(BOARD_SOURCES)
FIRMWARE_FLAGS := -std=c99 $(BOARD_OPT) -ffp-contract=off -fno-math-errno \
  -ffunction-sections -fdata-sections -Iinclude -Iport -I$(PLACE) \
  $(filter-out $(BOARD_WITHOUT),$(WARN)) \
  $(BOARD_FLAGS) $(FLAGS_$(REAL)) -DSTEPS=$(STEPS)
ifneq ($(FIRMWARE_RATE),)
FIRMWARE_FLAGS += -DRATE=$(RATE) -DSCENE_RATE=$(RATE)
endif
ifneq ($(FORMAT),plotter)
FIRMWARE_FLAGS += -D$(shell echo $(FORMAT) | tr a-z A-Z)
endif
ifneq ($(UPLINK),)
ifneq ($(FORMAT),frames)
$(error UPLINK needs FORMAT=frames: a host learns the session from the schema)
endif
FIRMWARE_FLAGS += -DUPLINK
endif
ifneq ($(OTHERS),)
FIRMWARE_FLAGS += -DOTHERS=$(OTHERS)u
endif
ifneq ($(DEADMAN),)
FIRMWARE_FLAGS += -DDEADMAN=$(DEADMAN)u
endif
ifneq ($(KEY),)
ifeq ($(UPLINK),)
$(error KEY is for commands: UPLINK=yes)
endif
ifeq ($(BOARD_BOOT)$(KEY_WEAK),)
$(error $(BOARD) has no port_boot(), so that a session may come again, and \
  what was recorded in it act: KEY_WEAK=yes builds that)
endif
ifneq ($(KEY_WEAK),)
FIRMWARE_FLAGS += -DKEY_WEAK
KEY_SAYS := weak: its sessions hang on when bytes arrive, and may come again
else
KEY_SAYS := its sessions are made from its $(BOARD_BOOT)
endif
# The digits are in no argument and in no file that others may read: neither in
# that of flags, nor in the program.
FIRMWARE_FLAGS += -DUPLINK_KEY='"$(PROGRAM)$(NAMED).key"'
KEY_HELD = umask 077; rm -f $@ $@.uf2 $(@:.elf=.key); \
  trap 'rm -f $(@:.elf=.key)' EXIT; trap 'exit 1' INT TERM HUP; \
  echo '  KEY   $(BOARD): $(KEY_SAYS)' >&2; \
  $(BUILD)/$(REAL)/constants --key '$(KEY)' >$(@:.elf=.key) || exit 1;
# Another key may be the older file, or of a file of the same name. Its CRC-32
# is beside the program, which has the key itself, and has the same mode.
KEY_SUM := $(FIRMWARE).keyed
$(KEY_SUM): $(BUILD)/$(REAL)/constants FORCE
	@mkdir -p $(@D)
	@umask 077; new=$@.$$$$; key=$$($< --key '$(KEY)') || exit; \
	echo "$$key" | cksum >$$new; \
	if cmp -s $$new $@; then rm $$new; else mv $$new $@; fi
endif
ifeq ($(SPLIT),no)
FIRMWARE_FLAGS += -DTF_STEP_SPLITS=false
endif
ifneq ($(filter-out moreau,$(SCHEME)),)
FIRMWARE_FLAGS += -DSCHEME_$(shell echo $(SCHEME) | tr a-z A-Z)
endif
ifeq ($(OVERRUN),stop)
FIRMWARE_FLAGS += -DOVERRUN=LOOP_STOP
endif
ifneq ($(WATCHDOG),)
FIRMWARE_FLAGS += -DWATCHDOG=$(WATCHDOG)u
endif
ifneq ($(FAULT),)
FIRMWARE_FLAGS += -DFAULT=fault_$(FAULT)
endif
FIRMWARE_FLAGS += -DEVERY=$(EVERY)
ifneq ($(BAUD),)
FIRMWARE_FLAGS += -DBAUD=$(BAUD)u
# What it sends in real time, against what its line carries.
ifeq ($(PROGRAM),firmware)
CHECK_LINE = @$(BUILD)/$(REAL)/constants --line \
  '$(if $(filter generic,$(SCENE)),$(START),$(SCENE))' $(FORMAT) $(RATE) \
  $(EVERY) $(BAUD) $(UPLINK) $(if $(KEY),key)
endif
endif
ifeq ($(SCENE),generic)
FIRMWARE_SOURCES += port/choice.c
FIRMWARE_FLAGS += \
  -DCHOSEN_SCENE=$$($(BUILD)/$(REAL)/constants --number $(START))
else
CONSTANTS := $(PLACE)/constants$(FIRMWARE_RATE).h
FIRMWARE_FLAGS += -DSCENE_HEADER='"constants$(FIRMWARE_RATE).h"'
# Of a file they may be others each time, also those of a file of the same name.
$(CONSTANTS): $(BUILD)/$(REAL)/constants \
    $(if $(findstring .,$(SCENE))$(findstring /,$(SCENE)),FORCE)
	@mkdir -p $(@D)
	@new=$@.$$$$; $< '$(SCENE)' $(FIRMWARE_RATE) >$$new || \
	  { code=$$?; rm $$new; exit $$code; }; \
	if cmp -s $$new $@; then rm $$new; else mv $$new $@; fi
endif

$(FIRMWARE): $(BUILD)/$(REAL)/constants $(CONSTANTS) $(FIRMWARE).flags \
    $(KEY_SUM) $(wildcard port/*.[ch] port/arch/* port/$(BOARD)/* \
      tests/target/*.c tests/golden/*.h) \
    $(wildcard src/*/*.[ch] include/twofold/*.h)
	@command -v $(BOARD_CC) >/dev/null || { echo '$(BOARD): $(BOARD_CC) is' \
	  'missing (Debian: apt-get install $(BOARD_PACKAGES))'; exit 3; }
	$(CHECK_LINE)
	@mkdir -p $(@D)
	@echo '  BOARD $@'
	@$(KEY_HELD) port/link.sh '$(BOARD): $(PROGRAM) of SCENE=$(SCENE)' \
	  '$(BOARD_LARGER)' \
	  $(BOARD_CC) $(FIRMWARE_FLAGS) $(EXTRA) $(FIRMWARE_SOURCES) \
	  $(BOARD_GC) $(BOARD_LINK) -o $@
	$(if $(BOARD_IMAGE),@$(if $(KEY),umask 077;) $(BOARD_IMAGE) $@)

# One file for each program, because their flags differ.
$(FIRMWARE).flags: $(BUILD)/$(REAL)/constants FORCE
	@mkdir -p $(@D)
	@new=$@.$$$$; \
	echo "$(BOARD_CC) $(FIRMWARE_FLAGS) $(EXTRA) $(FIRMWARE_SOURCES)" \
	  "$(BOARD_LINK) $(START) $(KEY)" >$$new; \
	if cmp -s $$new $@; then rm $$new; else mv $$new $@; fi

ifneq ($(CLOCK),)
.PHONY: tick-budget
$(FIRMWARE): | tick-budget
tick-budget:
	@tools/board/budget.py $(or $(BOARD_LIKE),$(BOARD)) $(REAL) '$(SCENE)' \
	  $(SCHEME) $(RATE) $(CLOCK) '$(UPLINK)'
endif

firmware: $(FIRMWARE)
	@echo '$(FIRMWARE)'
elf: $(FIRMWARE)

# For scripts: the call graph of a firmware with stack frames, into GRAPH.
call-graph: $(BUILD)/$(REAL)/constants $(CONSTANTS)
	@for file in $(FIRMWARE_SOURCES); do \
	  $(BOARD_CC) $(FIRMWARE_FLAGS) -fcallgraph-info=su -c $$file \
	    -o $(GRAPH)/$$(basename $$file .c).o || exit 1; done

# For `make hashes`: what the program `trajectory` says in the emulator.
board-hash: $(FIRMWARE)
	@said=$$(timeout -k 5 600 $(BOARD_RUN) $(BOARD_LOADS) $< </dev/null 2>&1 | \
	  sed -n 's/\r$$//; s/^trajectory //p'); \
	printf '%-13s %-18s %s\n' $(BOARD) '$(BOARD_IS)' "$${said:-no end}"

# For scripts: one fact of a board, as `make -s board-REALS BOARD=...`.
board-%:
	@echo '$(BOARD_$*)'
endif
