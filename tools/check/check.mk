# Everything that is held up by machine. Included by the Makefile. The checks
# choose their own compilers and flags.
#
#   CHECKS='format words'   only these; tools/check/run has the list

.PHONY: check valgrind stale
check: ## warnings, format, static analysis, sanitizers, promises
	@MAKEFLAGS= MAKELEVEL= BUILD='$(BUILD)/check' exec tools/check/run $(CHECKS)

valgrind: ## nearly every test under memcheck (valgrind)
	@MAKEFLAGS= MAKELEVEL= BUILD='$(BUILD)/check' tools/check/valgrind.py all

stale: ## mark the reports of docs/ that are of an older core
	@tools/check/reports.py --write
