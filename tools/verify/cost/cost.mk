# Instructions of the public functions (tools/verify/cost), on x86-64 only. The core
# is compiled with -O2 and counts itself. Included by the Makefile.
#
#   EVALUATIONS=100000   calls of each function that the search tries

COST := $(wildcard tools/verify/cost/*.c)
COUNTED := $(CORE:src/%.c=%) inline memory
EVALUATIONS ?= 100000

# With the lines of the source, by which tools/verify/cost/paths.py knows the loops;
# gcc makes the same instructions with them as without.
define cost_rules
$(BUILD)/$(1)/counted/flags: $(BUILD)/$(1)/flags tools/verify/cost/cost.mk
	@mkdir -p $$(@D)
	@cp $$< $$@
$(BUILD)/$(1)/counted/%.s: src/%.c $(BUILD)/$(1)/counted/flags
	$$(call assemble,$$(CORE_FLAGS) $$(SRC_FLAGS_$$(*F)) $$(FLAGS_$(1)))
$(BUILD)/$(1)/counted/inline.s: tools/verify/cost/inline.c \
    $(BUILD)/$(1)/counted/flags
	$$(call assemble,$$(CORE_FLAGS) -Itools $$(FLAGS_$(1)))
$(BUILD)/$(1)/counted/memory.s: port/arch/memory.c \
    $(BUILD)/$(1)/counted/flags
	$$(call assemble,$$(CORE_FLAGS))
$(BUILD)/$(1)/counted/%.o: $(BUILD)/$(1)/counted/%.s tools/verify/cost/count.py
	@tools/verify/cost/count.py $$< >$$(@:.o=.counting)
	@$$(CC) -x assembler -c $$(@:.o=.counting) -o $$@
$(BUILD)/$(1)/cost: $(COUNTED:%=$(BUILD)/$(1)/counted/%.o) \
    $(patsubst %.c,$(BUILD)/$(1)/%.o,$(filter-out %/inline.c,$(COST)))
	$$(link)
endef

define assemble
	@mkdir -p $(@D)
	@echo '  COUNT $@'
	@$(CC) $(1) -O2 -g1 -MMD -MP -S $< -o $@
endef

$(foreach v,$(VARIANTS),$(eval $(call cost_rules,$(v))))

.PHONY: bounds keep-bounds
bounds: ## worst cost and stack of every public function
bounds: $(VARIANTS:%=$(BUILD)/%/cost)
	$(call of_this_core,$(BUILD)/BOUNDS.md,MAKEFLAGS= MAKELEVEL= \
	  BUILD='$(BUILD)' EVALUATIONS='$(EVALUATIONS)' tools/verify/cost/run)

# Also the seeds of the next search.
keep-bounds: ## copy them to docs/ and into the headers
	cp $(BUILD)/BOUNDS.md docs/
	cp $(BUILD)/bounds/worst.double $(BUILD)/bounds/worst.float tools/verify/cost/
	tools/verify/cost/headers.py put $(BUILD)/bounds/figures include/twofold/*.h
