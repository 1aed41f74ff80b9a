# Exits from the two-fold and returns to it, counted. Included by the Makefile.

COUNTS := nearest machines

$(COUNTS:%=$(BUILD)/statistics/%): $(BUILD)/statistics/%: \
    $(BUILD)/double/tools/study/statistics/%.o $(BUILD)/double/libtwofold.a
	@mkdir -p $(@D)
	$(link)

.PHONY: statistics
statistics: ## exits and returns of chaos, counted (15 minutes)
statistics: $(BUILD)/double/twofold $(COUNTS:%=$(BUILD)/statistics/%)
	$(call of_this_core,$(BUILD)/statistics/SUMMARY.md,BUILD='$(BUILD)' \
	  tools/study/statistics/study)
