# The report: error against time and cost. Included by the Makefile.

REPORT := sweep scatter cost digits scenes

define report_rules
$(REPORT:%=$(BUILD)/$(1)/tools/bench/report/%): %: %.o \
    $(BUILD)/$(1)/tools/bench/report/part.o $(BUILD)/$(1)/tools/bench/report/truth.o \
    $(BUILD)/$(1)/tools/board/constants/constants.o \
    $(BUILD)/$(1)/libsupport.a $(BUILD)/$(1)/libtwofold.a
	$$(link)
endef
$(foreach v,$(VARIANTS),$(eval $(call report_rules,$(v))))
REPORT_PROGRAMS := $(foreach v,$(VARIANTS),\
  $(REPORT:%=$(BUILD)/$(v)/tools/bench/report/%))

# The problems of the peers are in double.
PROFILE := $(if $(filter double,$(VARIANTS)),\
  $(BUILD)/double/tools/bench/report/profile)
$(BUILD)/double/tools/bench/report/profile: %: %.o \
    $(BUILD)/double/tools/bench/peers/problem.o $(BUILD)/double/libtwofold.a
	$(link)
REPORT_PROGRAMS += $(PROFILE)

.PHONY: bench report keep-report
all: $(REPORT_PROGRAMS)

# All reports of one commit and compiler, one after the other: none disturbs
# what another measures.
report: ## bench-peers, stability, bench, one by one (minutes)
	@$(MAKE) bench-peers
	@$(MAKE) stability
	@$(MAKE) bench

bench: ## error against time, cost (matplotlib, valgrind)
bench: $(BENCH_PROGRAMS) $(REPORT_PROGRAMS)
	$(call of_this_core,$(BUILD)/REPORT.md,CC='$(CC)' OPT='$(OPT)' \
	  BUILD='$(BUILD)' tools/bench/report/run)

keep-report: ## copy what bench and stability made to docs/
	cp $(BUILD)/REPORT.md docs/
	mkdir -p docs/report
	cp $(BUILD)/report/*.svg docs/report/
	if [ -e $(BUILD)/STABILITY.md ]; then cp $(BUILD)/STABILITY.md docs/ && \
	  mkdir -p docs/stability && cp $(BUILD)/stability/*.png docs/stability/; fi
