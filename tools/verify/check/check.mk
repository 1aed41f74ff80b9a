# Everything that is held up by machine. Included by the Makefile. The checks
# choose their own compilers and flags.
#
#   CHECKS='format words'   only these; tools/verify/check/run has the list

.PHONY: check valgrind stale
check: ## warnings, format, static analysis, sanitizers, promises
	@MAKEFLAGS= MAKELEVEL= BUILD='$(BUILD)/check' exec tools/verify/check/run $(CHECKS)

valgrind: ## nearly every test under memcheck (valgrind)
	@MAKEFLAGS= MAKELEVEL= BUILD='$(BUILD)/check' tools/verify/check/valgrind.py all

stale: ## mark the reports of docs/ that are of an older core
	@tools/verify/check/reports.py --write
