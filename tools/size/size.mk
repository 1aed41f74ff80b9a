# Size and cost of the boards' firmware. Included by the Makefile.
#
#   ONLY='host uno'      these boards

.PHONY: size
size: ## flash, RAM, stack, instructions of every board
	$(call of_this_core,$(BUILD)/SIZE.md,BUILD='$(BUILD)' tools/size/run \
	  $(ONLY))
