# Where in the space of machines the motion returns. Included by the Makefile.

.PHONY: recurrence recurrence-page keep-recurrence
recurrence: ## where motions return, over 20000 machines (25 minutes)
recurrence: $(BUILD)/double/twofold
	$(call of_this_core,$(BUILD)/recurrence/RECURRENCE.md,BUILD='$(BUILD)' \
	  tools/study/recurrence/recurrence)

recurrence-page: ## its page again, from the rows that are there
	$(call of_this_core,$(BUILD)/recurrence/RECURRENCE.md,BUILD='$(BUILD)' \
	  tools/study/recurrence/recurrence report)

keep-recurrence: ## copy what it made to docs/
	cp $(BUILD)/recurrence/RECURRENCE.md $(BUILD)/recurrence/*.png docs/
