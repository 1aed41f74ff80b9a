# Fuzzing: `make fuzz SECONDS=30` runs each target so long from its corpus,
# `make fuzz-merge` puts what a run found into the corpus, minimised. tests/
# regress/test_corpus.c replays the corpus in every `make test`, without clang.
# Included by the Makefile.
#
#   FUZZ='machine frame'   only these targets
#   FUZZ_REALS=double      only this real type (of the target machine)

ALL_FUZZ := machine frame arguments scene table state record
FUZZ ?= $(ALL_FUZZ)
SECONDS ?= 30
FUZZ_CC ?= clang
FUZZ_REALS ?= double float
ifneq ($(filter-out $(ALL_FUZZ),$(FUZZ)),)
$(error FUZZ=$(FUZZ): the targets are $(ALL_FUZZ))
endif
ifneq ($(filter-out double float,$(FUZZ_REALS)),)
$(error FUZZ_REALS=$(FUZZ_REALS): double, float)
endif
# The other targets read decimals and bytes, which one real type shows.
FUZZ_RUNS := $(foreach t,$(FUZZ),$(if $(filter machine,$(t)),\
  $(FUZZ_REALS:%=%/$(t)),double/$(t)))
fuzzdir := $(BUILD)/fuzz
FUZZ_FLAGS := -g1 -O1 -fno-omit-frame-pointer -fno-sanitize-recover=all \
  -fsanitize=address,undefined,float-cast-overflow
FUZZ_PARTS := $(ALL_FUZZ:%=tools/verify/fuzz/%.c) tools/verify/fuzz/analysis.c \
  $(filter tools/cli/%,$(CLI)) $(CORE)

.PHONY: fuzz fuzz-merge fuzz-clang
HELPERS += fuzz-clang
fuzz: ## random inputs, SECONDS=30 for each target (clang)
fuzz: $(FUZZ_RUNS:%=$(fuzzdir)/%)
	@BUILD='$(BUILD)' tools/verify/fuzz/run $(SECONDS) $(FUZZ_RUNS)

fuzz-merge: ## put what fuzzing found into tests/corpus
fuzz-merge: $(FUZZ_RUNS:%=$(fuzzdir)/%)
	@BUILD='$(BUILD)' tools/verify/fuzz/merge $(FUZZ_RUNS)

fuzz-clang:
	@mkdir -p $(fuzzdir)
	@echo 'int LLVMFuzzerTestOneInput(const char *d, unsigned long n)' \
	  '{ return d == 0 && n > 0; }' | \
	  $(FUZZ_CC) -fsanitize=fuzzer,address,undefined -x c -o $(fuzzdir)/empty \
	  - 2>/dev/null || { echo 'make fuzz needs clang with libFuzzer' \
	  '(Debian: apt-get install clang libclang-rt-dev)' >&2; exit 3; }

# Of one real type: all parts in an archive, a door for each target.
define fuzz-rules
$(fuzzdir)/$(1)/%.o: %.c $(BUILD)/$(1)/flags tools/verify/fuzz/fuzz.mk | fuzz-clang
	@mkdir -p $$(@D)
	@echo '  CC    $$@'
	@$(FUZZ_CC) $$(COMMON) -Itools $(FLAGS_$(1)) $$(FUZZ_FLAGS) \
	  -fsanitize=fuzzer-no-link -MMD -MP -c $$< -o $$@
$(fuzzdir)/$(1)/libparts.a: $(FUZZ_PARTS:%.c=$(fuzzdir)/$(1)/%.o)
	$$(archive)
$(ALL_FUZZ:%=$(fuzzdir)/$(1)/%): $(fuzzdir)/$(1)/%: tools/verify/fuzz/entry.c \
    $(fuzzdir)/$(1)/libparts.a
	@echo '  LINK  $$@'
	@$(FUZZ_CC) $$(COMMON) -Itools $(FLAGS_$(1)) $$(FUZZ_FLAGS) \
	  -DFUZZ=fuzz_$$* -fsanitize=fuzzer $$^ -lm -o $$@

# The replay as a test: an archive that needs no other, for it comes last.
$(BUILD)/$(1)/libcorpus.a: $(call objects_of_$(1),$(FUZZ_PARTS))
	$$(archive)
$(BUILD)/$(1)/tests/regress/test_corpus \
$(BUILD)/$(1)/tests/law/test_extreme_analysis: $(BUILD)/$(1)/libcorpus.a
endef
$(foreach v,$(VARIANTS),$(eval $(call fuzz-rules,$(v))))
