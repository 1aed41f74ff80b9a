# What a board needs of this computer: the constants of its scene, and the
# controller at the other end of its line. Included by the Makefile.
#
#   BOARD=stm32f405      whose firmware is driven, in its emulator
#   HIL='--lockstep --steps 5000'    options, listed by build/float/hil alone
#   REAL SCENE RATE EVERY: see port/port.mk

HIL_PARTS := $(wildcard tools/board/hil/*.c) $(addprefix tools/cli/,\
  host/host.c host/output.c text/message.c \
  text/number.c) tools/decimal.c

define board_rules
$(BUILD)/$(1)/hil: $$(call objects_of_$(1),$(HIL_PARTS)) \
    $(BUILD)/$(1)/libtwofold.a
	$$(link)
$(BUILD)/$(1)/loop: $$(call objects_of_$(1),tools/board/loop/loop.c) \
    $(BUILD)/$(1)/libtwofold.a
	$$(link)
$(BUILD)/$(1)/constants: $$(call objects_of_$(1),\
    $(wildcard tools/board/constants/*.c) $(SCENE_READER) \
      tools/cli/host/host.c) \
    $(BUILD)/$(1)/libtwofold.a
	$$(link)
endef
$(foreach r,$(REALS),$(eval $(call board_rules,$(r))))

.PHONY: hil
all: $(VARIANTS:%=$(BUILD)/%/hil) $(VARIANTS:%=$(BUILD)/%/loop)

# The script's own makes share the jobs of this one (+).
hil: ## a controller drives BOARD=stm32f405 over its line
	+@BUILD='$(BUILD)' REAL='$(REAL)' SCENE='$(SCENE)' RATE='$(RATE)' \
	  EVERY='$(or $(EVERY),10)' tools/run hil $(BOARD) $(HIL)
