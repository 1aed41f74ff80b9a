# Laws without a jump, as their width shrinks. Always by gcc: __float128 is its
# own. Included by the Makefile.

FINER_BITS := 24 53 64 113
FINER_GCC ?= gcc

$(FINER_BITS:%=$(BUILD)/finer/finer-%): $(BUILD)/finer/finer-%: \
    $(wildcard tools/study/finer/*.c tools/study/finer/*.h)
	@mkdir -p $(@D)
	@echo '  CC    $@'
	@$(FINER_GCC) $(filter-out -Iinclude,$(COMMON)) $(WARN) $(EXTRA) \
	  -DFINER_BITS=$* $(filter %.c,$^) -lm -o $@

.PHONY: finer keep-finer
finer: ## what finer laws select behind the two-fold (10 minutes)
finer: $(BUILD)/double/twofold $(FINER_BITS:%=$(BUILD)/finer/finer-%)
	$(call of_this_core,$(BUILD)/finer/FINER.md,BUILD='$(BUILD)' \
	  tools/study/finer/study)

keep-finer: ## copy what it made to docs/
	cp $(BUILD)/finer/FINER.md $(BUILD)/finer/finer.png docs/
