# Wrong changes of src/ for the tests to notice. Included by the Makefile.
#
#   SAMPLE=60    how many are tried; 0 tries every change (hours)
#   SEED=1       SEED=2 tries others
#   MACHINES=    on how many machines excused changes are compared
#   AGAIN=1      goes on where a run was stopped, and tries what survived again

SAMPLE ?= 60
SEED ?= 1
AGAIN ?=

.PHONY: mutation witnesses excused
mutation: ## wrong changes of src/ for the tests to notice
witnesses: ## for each test a change that fails it (SAMPLE=2000)
mutation witnesses:
	@CC='$(CC)' BUILD='$(BUILD)' SAMPLE='$(SAMPLE)' SEED='$(SEED)' \
	  AGAIN='$(AGAIN)' tools/verify/mutation/run $(filter witnesses,$@)
excused: ## whether excused changes make no difference
	@CC='$(CC)' BUILD='$(BUILD)' tools/verify/mutation/excused.py
