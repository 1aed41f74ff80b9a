# Undefined behaviour and numbers that are not finite, by Frama-C Eva.
# Included by the Makefile.
#
#   ENTRIES='step_any seal_any'   these entries; check `eva` has the short ones

.PHONY: eva eva-broken
eva: ## all entries of Frama-C Eva (minutes)
	@BUILD='$(BUILD)' tools/verify/eva/run $(ENTRIES)

eva-broken: ## wrong changes for the proofs to notice
	@BUILD='$(abspath $(BUILD))' tools/verify/eva/broken.py $(ENTRIES)
