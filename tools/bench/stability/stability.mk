# Stiff and extreme machines. Included by the Makefile.

STABILITY := $(wildcard tools/bench/stability/*.c)

define stability_rules
$(BUILD)/$(1)/tools/bench/stability/sweep: $$(call objects_of_$(1),$(STABILITY)) \
    $(BUILD)/$(1)/libtwofold.a
	$$(link)
endef
$(foreach v,$(VARIANTS),$(eval $(call stability_rules,$(v))))

.PHONY: stability
all: $(VARIANTS:%=$(BUILD)/%/tools/bench/stability/sweep)

stability: ## stiff and extreme cases: tables and map (matplotlib)
stability: $(VARIANTS:%=$(BUILD)/%/tools/bench/stability/sweep)
	$(call of_this_core,$(BUILD)/STABILITY.md,CC='$(CC)' BUILD='$(BUILD)' \
	  tools/bench/stability/run)
