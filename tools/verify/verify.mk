# Everything that is held up by machine: checks, worst cost, proofs, mutation,
# fuzzing, soak. Included by the Makefile. Checks choose their own compilers.
#
#   CHECKS='format arrows'  only these; tools/verify/check.py has the list
#   FULL=yes                all of what checks sample otherwise (hours)
#   EVALUATIONS=100000      bounds: calls of each function that the search tries
#   ENTRIES='step_any'      eva: these entries
#   SAMPLE=60 SEED=1        mutation: how many changes of which order, 0 all
#   SECONDS=30 FUZZ=frame FUZZ_REALS=double
#                           fuzz: how long, which targets, which real type of
#                           the target machine
#   STEPS=1e9               soak: how many, in each of VARIANTS

.PHONY: check bounds keep-bounds contacts-cost eva mutation fuzz fuzz-clang soak

check: ## warnings, format, static analysis, sanitizers, promises
	@BUILD='$(BUILD)/check' exec tools/run check $(CHECKS)

eva: ## all entries of Frama-C Eva (minutes)
	@BUILD='$(BUILD)' tools/run eva $(ENTRIES)

SAMPLE ?= 60
SEED ?= 1
mutation: ## wrong changes of src/ for the tests to notice
	@BUILD='$(BUILD)' SAMPLE='$(SAMPLE)' SEED='$(SEED)' tools/run mutation

# Instructions of the public functions (tools/verify/cost), on x86-64 only: the
# core is compiled with -O2 and counts itself.
COST := $(filter-out %/board.c,$(wildcard tools/verify/cost/*.c)) \
  tools/board/constants/constants.c
COUNTED := $(CORE:src/%.c=%) memory
EVALUATIONS ?= 100000
counted = $(BUILD)/$(1)/counted

define cost_rules
$(call counted,$(1))/flags: $(BUILD)/$(1)/flags tools/verify/verify.mk
	@mkdir -p $$(@D)
	@cp $$< $$@
$(call counted,$(1))/%.s: src/%.c $(call counted,$(1))/flags
	$$(call assemble,$$(CORE_FLAGS) $$(SRC_FLAGS_$$(*F)) $$(FLAGS_$(1)))
$(call counted,$(1))/memory.s: port/arch/memory.c $(call counted,$(1))/flags
	$$(call assemble,$$(CORE_FLAGS))
$(call counted,$(1))/%.o: $(call counted,$(1))/%.s tools/verify/cost/count.py
	@tools/verify/cost/count.py $$< >$$(@:.o=.counting)
	@$$(CC) -x assembler -c $$(@:.o=.counting) -o $$@
$(BUILD)/$(1)/cost: $(COUNTED:%=$(call counted,$(1))/%.o) \
    $(COST:%.c=$(BUILD)/$(1)/%.o)
	$$(link)
endef
define assemble
	@mkdir -p $(@D)
	@echo '  COUNT $@'
	@$(CC) $(1) -O2 -MMD -MP -S $< -o $@
endef
$(foreach v,$(REALS),$(eval $(call cost_rules,$(v))))

bounds: ## worst cost and stack of every public function
bounds: $(VARIANTS:%=$(BUILD)/%/cost)
	@BUILD='$(BUILD)' EVALUATIONS='$(EVALUATIONS)' tools/run bounds
keep-bounds: ## copy them to docs/bench, and the calls
	@cp $(BUILD)/bounds/worst.double $(BUILD)/bounds/worst.float tools/verify/cost/
	@cp $(BUILD)/bounds/worst.csv docs/bench/

contacts-cost: ## instructions of 1 to 4 contacts on a Cortex-M4F
	@BUILD='$(BUILD)' tools/run contacts

# tests/regress/test_corpus.c replays the corpus in every `make test`, without
# clang.
ALL_FUZZ := machine frame scene table state
FUZZ ?= $(ALL_FUZZ)
FUZZ_CC ?= clang
FUZZ_REALS ?= double float
# The other targets read decimals and bytes, which one real type shows.
FUZZ_RUNS := $(foreach t,$(FUZZ),$(if $(filter machine,$(t)),\
  $(FUZZ_REALS:%=%/$(t)),double/$(t)))
fuzzdir := $(BUILD)/fuzz
FUZZ_FLAGS := -g1 -fno-omit-frame-pointer -fno-sanitize-recover=all \
  -fsanitize=address,undefined,float-cast-overflow,fuzzer-no-link
FUZZ_PARTS := $(ALL_FUZZ:%=tools/verify/fuzz/%.c) tools/verify/fuzz/analysis.c \
  $(filter tools/%,$(CLI)) $(CORE)

fuzz: ## random inputs, SECONDS=30 for each target (clang)
fuzz: fuzz-clang
	@MAKEFLAGS= MAKELEVEL= $(MAKE) -s --no-print-directory CC='$(FUZZ_CC)' \
	  OPT=-O1 EXTRA='$(FUZZ_FLAGS)' BUILD='$(fuzzdir)' \
	  $(FUZZ_RUNS:%=$(fuzzdir)/%)
	@BUILD='$(BUILD)' tools/verify/fuzz/fuzz.sh $(or $(SECONDS),30) $(FUZZ_RUNS)

fuzz-clang:
	@mkdir -p $(fuzzdir)
	@echo 'int LLVMFuzzerTestOneInput(const char *d, unsigned long n)' \
	  '{ return d == 0 && n > 0; }' | \
	  $(FUZZ_CC) -fsanitize=fuzzer,address,undefined -x c -o $(fuzzdir)/empty \
	  - 2>/dev/null || { echo 'make fuzz needs clang with libFuzzer' \
	  '(Debian: apt-get install clang libclang-rt-dev)' >&2; exit 3; }

# All parts in an archive that needs no other, for it comes last; the replay as
# a test; and a door for each target, in a build with those flags.
define fuzz-rules
$(BUILD)/$(1)/libcorpus.a: $(call objects_of_$(1),$(FUZZ_PARTS))
	$$(archive)
$(BUILD)/$(1)/tests/regress/test_corpus: $(BUILD)/$(1)/libcorpus.a
$(ALL_FUZZ:%=$(BUILD)/$(1)/%): $(BUILD)/$(1)/%: tools/verify/fuzz/entry.c \
    $(BUILD)/$(1)/libcorpus.a
	@echo '  LINK  $$@'
	@$(CC) $$(COMMON) -Itools $(FLAGS_$(1)) $$(EXTRA) -DFUZZ=fuzz_$$* \
	  -fsanitize=fuzzer $$^ -lm -o $$@
endef
$(foreach v,$(REALS),$(eval $(call fuzz-rules,$(v))))

soak: ## chaos for STEPS=1e9 steps, then a replay
	@MAKEFLAGS= MAKELEVEL= BUILD='$(BUILD)/check' VARIANTS='$(VARIANTS)' \
	  STEPS='$(or $(filter-out 0,$(STEPS)),1e7)' tools/verify/check/soak.py
