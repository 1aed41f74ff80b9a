# The reference that judges the steps: the motion from event to event, by code
# that shares no line and no idea with them. build/reference/reference lists
# its commands. Included by the Makefile.

JUDGE := $(filter-out library,\
  $(patsubst tests/reference/judge/%.c,%,$(wildcard tests/reference/judge/*.c)))
JUDGE_OBJECTS := $(JUDGE:%=$(BUILD)/reference/%.o) \
  $(BUILD)/reference/library_f64.o $(BUILD)/reference/library_f32.o
JUDGE_FLAGS := -std=c99 -O2 $(WARN) -Iinclude -Itests/reference

.PHONY: reference
reference: ## an independent solver, to compare the steps with
reference: $(BUILD)/reference/reference
	@$< validate

$(BUILD)/reference/library_f64.o: tests/reference/judge/library.c
	$(call compile,$(JUDGE_FLAGS))
$(BUILD)/reference/library_f32.o: tests/reference/judge/library.c
	$(call compile,$(JUDGE_FLAGS) -DTF_REAL_FLOAT)
$(BUILD)/reference/%.o: tests/reference/judge/%.c
	$(call compile,$(JUDGE_FLAGS))
$(BUILD)/reference/reference: $(JUDGE_OBJECTS) \
    $(BUILD)/double/libsupport.a \
    $(BUILD)/double/libtwofold.a $(BUILD)/float/libtwofold.a
	$(link)
