# What the schemes cost, what their errors are and where they are stable; flash,
# RAM and stack of the boards. Included by the Makefile.
#
#   ONLY='peers stability'   these sections of `make bench` (SECTIONS of
#                        tools/bench/run) in place of USUAL; of `make size` and
#                        `make budgets`: these boards
#   ROUNDS=5             of the peers
#   SECONDS=10           of each loop in real time

BENCH := $(filter-out %/count.c %/empty_loop.c,\
  $(wildcard tools/bench/*.c tools/bench/stability/*.c))
BENCHES := $(VARIANTS:%=$(BUILD)/%/bench)
define bench_rules
$(BUILD)/$(1)/bench: $$(call objects_of_$(1),$(BENCH)) \
    $(BUILD)/$(1)/libsupport.a $(BUILD)/$(1)/libtwofold.a
	$$(link)
endef
$(foreach v,$(VARIANTS),$(eval $(call bench_rules,$(v))))

# What is not the project's own may use all that the processor has, but for
# AVX-512, which valgrind does not know. SUNDIALS, Siconos and Octave are built
# or left out by tools/bench/run.
PEER_FLAGS = $(TOOL_FLAGS) -march=native -ffp-contract=fast \
  $(if $(filter x86_64,$(shell uname -m)),-mno-avx512f)
PEERS := $(BUILD)/peers/hand $(BUILD)/peers/check
$(BUILD)/peers/%.o: tools/bench/peers/%.c $(BUILD)/double/flags
	$(call compile,$(PEER_FLAGS))
$(BUILD)/peers/bench-%.o: tools/bench/%.c $(BUILD)/double/flags
	$(call compile,$(PEER_FLAGS))
$(PEERS): %: %.o $(BUILD)/peers/bench-harness.o $(BUILD)/peers/bench-problem.o \
    $(BUILD)/double/libsupport.a $(BUILD)/double/libtwofold.a
	$(link)

# The loop of `run --realtime` without a step.
EMPTY_LOOP := $(BUILD)/double/tools/bench/empty_loop
$(EMPTY_LOOP): %: %.o $(addprefix $(BUILD)/double/tools/cli/,host/host.o \
    host/lateness.o host/output.o text/message.o)
	$(link)

BENCH_NEEDS := $(BENCHES) $(if $(filter double,$(VARIANTS)),$(PEERS) \
  $(EMPTY_LOOP) $(BUILD)/double/twofold)
.PHONY: bench keep-bench bench-ensemble stability realtime size budgets
all: $(BENCH_NEEDS)

run_bench = @BUILD='$(BUILD)' CC='$(CC)' OPT='$(OPT)' EXTRA='$(EXTRA)' \
  ROUNDS='$(ROUNDS)' SECONDS='$(SECONDS)' tools/bench/run
bench: ## error against cost, peers, stability (or ONLY=...)
bench: $(BENCH_NEEDS)
	$(run_bench) $(ONLY)
stability: ## stiff and extreme cases: where a run is stable
stability: $(BENCH_NEEDS)
	$(run_bench) stability
realtime: ## lateness of loops at 1 and 10 kHz
realtime: $(BENCH_NEEDS)
	$(run_bench) realtime
size: ## flash, RAM, stack, cost of every board (or ONLY=uno)
	$(run_bench) sizes $(ONLY)
budgets: ## instructions of a located step on boards, by budget
	$(run_bench) budgets $(ONLY)
keep-bench: ## copy what they made to docs/
	$(run_bench) --keep

bench-ensemble: ## many states at once (try EXTRA=-mavx2)
bench-ensemble: $(BENCHES)
	@for v in $(VARIANTS); do echo "== $$v" && $(BUILD)/$$v/bench ensemble || \
	  exit 1; done
