# Sweeps and sampled studies in shards: docs/SWEEPS.md. Included by the
# Makefile.
#
#   ONLY='Slurm map'   of test-shards: tests whose names contain one of these

.PHONY: test-shards
test-shards: ## sweeps under GNU parallel, Slurm, Snakemake; the map
test-shards: $(BUILD)/double/twofold
	@TWOFOLD='$<' tests/shards/test_shards.py $(ONLY)
