# Size and cost of the boards' firmware. Included by the Makefile.
#
#   ONLY='host uno'      these boards

.PHONY: size
size: ## flash, RAM, stack, instructions of every board
	@BUILD='$(BUILD)' tools/size/run $(ONLY)
