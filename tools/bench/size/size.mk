# Size and cost of the boards' firmware. Included by the Makefile.
#
#   ONLY='host uno'      these boards

.PHONY: size budgets
size: ## flash, RAM, stack, instructions of every board
	$(call of_this_core,$(BUILD)/SIZE.md,BUILD='$(BUILD)' tools/bench/size/run \
	  $(ONLY))

budgets: ## instructions of a located step on boards, by budget
	$(call of_this_core,$(BUILD)/BUDGETS.md,BUILD='$(BUILD)' \
	  tools/bench/size/budgets $(ONLY))
