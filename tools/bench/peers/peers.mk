# Other tools on the same problems. Included by the Makefile. What is not the
# project's own may use all that the processor has. SUNDIALS, Siconos and
# Octave are built or left out by tools/bench/peers/run; the rest is built here.

PEERS := hand twofold reference
RIVAL_FLAGS = $(TOOL_FLAGS) -march=native -ffp-contract=fast

$(BUILD)/peers/%.o: tools/%.c $(BUILD)/double/flags
	$(call compile,$(RIVAL_FLAGS))
$(PEERS:%=$(BUILD)/peers/%): $(BUILD)/peers/%: $(BUILD)/peers/peers/%.o \
    $(BUILD)/peers/peers/sweep.o $(BUILD)/peers/peers/problem.o \
    $(BUILD)/peers/bench/rk4_smooth.o $(BUILD)/double/libtwofold.a
	$(link)

.PHONY: bench-peers
bench-peers: ## error against time beside other tools (SUNDIALS, ...)
bench-peers: $(PEERS:%=$(BUILD)/peers/%)
	@CC='$(CC)' BUILD='$(BUILD)' tools/bench/peers/run
