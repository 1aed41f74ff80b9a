# The reference that judges the steps: an event-driven solver that shares no
# code and no idea with them. build/reference/reference lists its commands.
# Included by the Makefile.

REFERENCE_PARTS := $(filter-out library,\
  $(patsubst tests/reference/events/%.c,%,$(wildcard tests/reference/events/*.c)))
REFERENCE_OBJECTS := $(REFERENCE_PARTS:%=$(BUILD)/reference/%.o) \
  $(BUILD)/reference/library_f64.o $(BUILD)/reference/library_f32.o
REFERENCE_FLAGS := -std=c99 -O2 $(WARN) -Iinclude

.PHONY: reference
reference: ## an independent solver, to compare the steps with
reference: $(BUILD)/reference/reference
	@$< validate

$(BUILD)/reference/library_f64.o: tests/reference/events/library.c
	$(call compile,$(REFERENCE_FLAGS))
$(BUILD)/reference/library_f32.o: tests/reference/events/library.c
	$(call compile,$(REFERENCE_FLAGS) -DTF_REAL_FLOAT)
$(BUILD)/reference/%.o: tests/reference/events/%.c
	$(call compile,$(REFERENCE_FLAGS))
$(BUILD)/reference/reference: $(REFERENCE_OBJECTS) \
    $(BUILD)/double/libtwofold.a $(BUILD)/float/libtwofold.a
	$(link)
