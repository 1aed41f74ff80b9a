# Soak: chaos for very many steps, then a replay of the second half from a
# snapshot. Included by the Makefile.
#
#   STEPS=1e9    how many, in each of VARIANTS

SOAK_STEPS := $(if $(filter command line environment,$(origin STEPS)),\
  $(STEPS),1e7)

define soak_rules
$(BUILD)/$(1)/soak: $(call objects_of_$(1),tools/verify/soak/soak.c \
    tools/cli/host/host.c) $(BUILD)/$(1)/libtwofold.a
	$$(link)
endef
$(foreach v,$(VARIANTS),$(eval $(call soak_rules,$(v))))

.PHONY: soak
soak: ## chaos for STEPS=1e9 steps, then a replay
soak: $(VARIANTS:%=$(BUILD)/%/soak)
	@for p in $^; do $$p $(SOAK_STEPS) || exit 1; done
