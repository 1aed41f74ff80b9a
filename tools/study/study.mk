# The studies of the paper's machine and the pictures of it. Included by the
# Makefile. tools/run study SECTION follows what is to be followed and makes
# tables and pictures in $(BUILD)/study; keep-SECTION copies them to docs/.
#
#   CYCLES=20 SAMPLES=500 MACHINES=200 MECHANISMS=100   less of a section
#   ONLY='map slurm'      of test-shards: tests whose names have one of these

two := $(BUILD)/double/twofold
study = @BUILD='$(BUILD)' TWOFOLD='$(two)' FIGURES='$(FIGURES)' tools/run study

TROLLEY := $(BUILD)/study/trolley-program
SEVERAL := $(BUILD)/study/several-program
$(TROLLEY) $(SEVERAL): $(BUILD)/study/%-program: \
    $(BUILD)/double/tools/study/%.o $(BUILD)/double/libtwofold.a
	@mkdir -p $(@D)
	$(link)

CORNER := $(BUILD)/study/corner-program
$(CORNER): $(BUILD)/double/tools/study/corner.o \
    $(BUILD)/double/tools/cli/diverge/corner.o $(BUILD)/double/libtwofold.a
	@mkdir -p $(@D)
	$(link)

CART := $(BUILD)/study/cart-program $(BUILD)/study/cart-plus
$(CART): tools/package/dist/cmake/examples/demo/cart.c \
    $(BUILD)/double/libtwofold.a
	@mkdir -p $(@D)
	@$(if $(filter %-plus,$@),g++ -x c++,$(CC) -std=c99) -Iinclude $< \
	  -x none $(BUILD)/double/libtwofold.a -lm -o $@

# Laws without a jump, in four precisions. Always by gcc: __float128 and its
# library are its own.
FINER := $(patsubst %,$(BUILD)/study/finer-%,24 53 64 113)
FINER_GCC ?= gcc
FINER_SOURCES := tools/study/finer.c tests/reference/model.c \
  tests/reference/extrapolate.c
$(FINER): $(BUILD)/study/finer-%: $(FINER_SOURCES) \
    $(wildcard tests/reference/*.h)
	@mkdir -p $(@D)
	@echo '  CC    $@'
	@$(FINER_GCC) $(filter-out -Iinclude,$(COMMON)) $(WARN) $(EXTRA) \
	  -DREF_BITS=$* $(FINER_SOURCES) -lm $(if $(filter 113,$*),-lquadmath) \
	  -o $@

STUDIES := statistics recurrence noise fold corner halfrange finer sides \
  mechanisms several trolley cart figures
.PHONY: $(STUDIES) $(STUDIES:%=keep-%) recurrence-page keep-futures \
  test-shards
statistics: ## exits and returns of chaos, counted (15 minutes)
recurrence: ## where motions return, over 20000 machines (25 minutes)
noise: ## exits and returns under noise of three sizes (2 core-minutes)
fold: ## to which side noise leaves a two-fold, by band (8 minutes)
corner: ## what noise selects at h = g = 0, by r (36 core-minutes)
halfrange: ## the same without samples, and how long a rest lasts (12 minutes)
finer: ## what finer laws select behind the two-fold (10 minutes)
sides: ## their first sides at 200 widths a decade (50 minutes)
mechanisms: ## two-folds of 100000 random mechanisms (5 minutes)
several: ## joint futures of random mechanisms with two wheels
trolley: ## two-folds of a castor, and what follows them
figures: ## the pictures of docs/figures (or FIGURES='tyre atlas')
finer sides: $(FINER)
cart: ## two castors against an event-driven solver, and joint futures
several: $(SEVERAL)
trolley: $(TROLLEY)
cart: $(CART)
corner: $(CORNER)
$(STUDIES): $(two)
	$(study) $@
recurrence-page: ## its tables again, from the rows that are there
	$(study) recurrence count
keep-statistics: ## copy what it made to docs/ (keep-noise and so on, too)
$(STUDIES:%=keep-%): keep-%:
	$(study) $* keep
keep-futures: ## the moving picture of README.md: docs/futures.svg
keep-futures: $(two)
	tools/study/futures.py $(two) docs/futures.svg

test-shards: ## sweeps under parallel, Snakemake, Slurm; studies
test-shards: $(two) $(BUILD)/study/finer-64 $(TROLLEY) $(CORNER)
	@TWOFOLD='$<' FINER='$(BUILD)/study/finer-64' TROLLEY='$(TROLLEY)' \
	  CORNER='$(CORNER)' \
	  tests/shards/test_shards.py $(ONLY)
