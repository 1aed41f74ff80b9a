# Measurements of one kind of step alone. Included by the Makefile.

BENCH := $(addprefix tools/bench/steps/,steps.c race.c ensemble.c frame.c)

define bench_rules
$(call programs,$(BENCH),$(1)): %: %.o \
    $(BUILD)/$(1)/tools/bench/steps/rk4_smooth.o $(BUILD)/$(1)/libtwofold.a
	$$(link)
endef
$(foreach v,$(VARIANTS),$(eval $(call bench_rules,$(v))))
BENCH_PROGRAMS := $(foreach v,$(VARIANTS),$(call programs,$(BENCH),$(v)))

.PHONY: bench-steps bench-ensemble bench-frame
all: $(BENCH_PROGRAMS)

bench-steps: ## cost of a Moreau step alone (valgrind)
bench-steps: $(BENCH_PROGRAMS)
	@tools/bench/steps/steps.py '$(BUILD)' --cc='$(CC)'

bench-ensemble: ## many states at once (try EXTRA=-mavx2)
bench-ensemble: $(VARIANTS:%=$(BUILD)/%/tools/bench/steps/ensemble)
	@for v in $(VARIANTS); do echo "== $$v" && \
	  $(BUILD)/$$v/tools/bench/steps/ensemble || exit 1; done

bench-frame: ## frames decoded and made, MB/s
bench-frame: $(VARIANTS:%=$(BUILD)/%/tools/bench/steps/frame)
	@for v in $(VARIANTS); do echo "== $$v" && \
	  $(BUILD)/$$v/tools/bench/steps/frame || exit 1; done
