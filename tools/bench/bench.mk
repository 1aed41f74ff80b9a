# What the schemes cost, what their errors are and where they are stable; flash,
# RAM and stack of the boards. Included by the Makefile.
#
#   ONLY='peers stability'   these sections of `make bench` (SECTIONS of
#                        bench.py) in place of USUAL; of `make size`: these
#                        boards
#   QUICK=1              of peers every fourth setting, once
#   ROUNDS=5             of the peers

BENCH := $(filter-out %/count.c,$(wildcard tools/bench/*.c))
BENCHES := $(VARIANTS:%=$(BUILD)/%/bench)
define bench_rules
$(BUILD)/$(1)/bench: $$(call objects_of_$(1),$(BENCH)) \
    $(BUILD)/$(1)/libsupport.a $(BUILD)/$(1)/libtwofold.a
	$$(link)
endef
$(foreach v,$(VARIANTS),$(eval $(call bench_rules,$(v))))

# What is not the project's own may use all that the processor has, but for
# AVX-512, which valgrind does not know. Peers of libraries race where these are
# installed, as bench.py does with SciPy.
PEER_CPU = -march=native -ffp-contract=fast \
  $(if $(filter x86_64,$(shell uname -m)),-mno-avx512f)
PEER_FLAGS = $(TOOL_FLAGS) $(PEER_CPU)
PEERS := $(BUILD)/peers/hand
PEER_LIBRARY := $(BUILD)/peers/shared.so
LIBRARY_PEERS := $(addprefix $(BUILD)/peers/,\
  $(if $(wildcard /usr/include/cvode/cvode.h),sundials) \
  $(if $(wildcard /usr/include/siconos/kernel/SiconosKernel.hpp),siconos))
$(BUILD)/peers/%.o: tools/bench/peers/%.c $(BUILD)/double/flags
	$(call compile,$(PEER_FLAGS))
$(BUILD)/peers/bench-%.o: tools/bench/%.c $(BUILD)/double/flags
	$(call compile,$(PEER_FLAGS))
HARNESS := $(addprefix $(BUILD)/peers/bench-,harness.o problem.o) \
  $(BUILD)/double/libtwofold.a
$(PEERS): %: %.o $(HARNESS)
	$(link)

link_peer = @$(1) -O3 $(PEER_CPU) -Iinclude -Itools $(filter-out %.h,$^) $(2) \
  -lm -o $@
$(LIBRARY_PEERS): $(HARNESS) $(wildcard tools/bench/peers/*.h)
$(BUILD)/peers/sundials: tools/bench/peers/sundials.c
	$(call link_peer,$(CC) -std=c99,$(addprefix -lsundials_,cvode arkode \
	  nvecserial sunmatrixdense sunlinsoldense sunnonlinsolfixedpoint))
$(BUILD)/peers/siconos: tools/bench/peers/siconos.cpp
	$(call link_peer,$(CXX) -w $(addprefix -I/usr/include/siconos,/ /kernel \
	  /numerics),-lsiconos_kernel -lsiconos_numerics)

# For SciPy. The core's own objects are not made to be shared: it binds to them.
$(PEER_LIBRARY): tools/bench/peers/shared.c tools/bench/problem.c \
    $(BUILD)/double/libtwofold.a
	@echo '  LINK  $@'
	@$(CC) -shared -fPIC -Wl,-Bsymbolic $(PEER_FLAGS) -Wno-missing-prototypes \
	  -Wno-missing-declarations $^ -lm -o $@

# For the cells of stability: the Python package.
BENCH_PYTHON := $(BUILD)/python/twofold/_f64.so
$(BENCH_PYTHON): $(DIST)/c/twofold.c \
    $(wildcard tools/package/dist/python/*.[ch])
	@$(MAKE) -s --no-print-directory dist
	@cd $(DIST)/python/twofold-$(TF_VERSION) && /usr/bin/python3 setup.py -q \
	  build -b $(abspath $(BUILD))/python-build \
	  --build-lib $(abspath $(BUILD))/python

BENCH_NEEDS := $(BENCHES) $(if $(filter double,$(VARIANTS)),$(PEERS) \
  $(PEER_LIBRARY) $(BUILD)/double/twofold)
.PHONY: bench keep-bench stability waits size
all: $(BENCH_NEEDS)

run_bench = @BUILD='$(BUILD)' CC='$(CC)' OPT='$(OPT)' EXTRA='$(EXTRA)' \
  QUICK='$(QUICK)' ROUNDS='$(ROUNDS)' tools/run bench
bench: ## error against cost, peers, stability (or ONLY=...)
stability: ## stiff and extreme cases: where a run is stable
bench stability: $(BENCH_NEEDS) $(LIBRARY_PEERS) $(BENCH_PYTHON)
	$(run_bench) $(if $(filter bench,$@),$(ONLY),$@)
size: ## flash, RAM, stack, cost of every board (or ONLY=uno)
	$(run_bench) sizes $(ONLY)
waits: ## what rows, steps, sweeps, cycles and ensembles take
waits: $(BUILD)/double/twofold
	@BUILD='$(BUILD)' CC='$(CC)' tools/run waits
keep-bench: ## copy what they made to docs/
	$(run_bench) --keep
