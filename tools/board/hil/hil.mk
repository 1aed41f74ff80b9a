# The controller at the other end of a board's line. Included by the Makefile.
#
#   BOARD=stm32f405      whose firmware it drives, in its emulator
#   HIL='--lockstep --steps 5000'    options, listed by build/float/hil alone
#   REAL SCENE RATE EVERY: see port/port.mk

HIL_PARTS := $(wildcard tools/board/hil/*.c) $(addprefix tools/cli/,\
  host/source.c host/host.c host/output.c host/destination.c \
  text/message.c)

define hil_rules
$(BUILD)/$(1)/hil: $$(call objects_of_$(1),$(HIL_PARTS)) \
    $(BUILD)/$(1)/libtwofold.a
	$$(link)
endef
$(foreach v,$(VARIANTS),$(eval $(call hil_rules,$(v))))

.PHONY: hil
all: $(VARIANTS:%=$(BUILD)/%/hil)

hil: ## a controller drives BOARD=stm32f405 over its line
	@BUILD='$(BUILD)' REAL='$(REAL)' SCENE='$(SCENE)' RATE='$(RATE)' \
	  EVERY='$(or $(EVERY),10)' tools/board/hil/run $(BOARD) $(HIL)
