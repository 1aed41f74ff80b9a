# The reference that judges the steps: the motion from event to event, by code
# that shares no line and no idea with them. build/reference/reference lists
# its commands. Included by the Makefile.

JUDGE := $(filter-out library,\
  $(patsubst tests/reference/judge/%.c,%,$(wildcard tests/reference/judge/*.c)))
JUDGE_OBJECTS := $(patsubst %,$(BUILD)/reference/%.o,$(JUDGE) library_f64 \
  library_f32)
JUDGE_FLAGS := -std=c99 -O2 $(WARN) -Iinclude -Itests/reference

.PHONY: reference
reference: ## an independent solver, to compare the steps with
reference: $(BUILD)/reference/reference
	@$< validate

# Of each class of machines 2000, a process a class.
TABLE_MACHINES ?= 2000
TABLE_CLASSES := A A8 A\' B C D E F G H I J K L
.PHONY: reference-table
reference-table: ## runs that are silently wrong, by class (4 core-hours)
reference-table: $(BUILD)/reference/reference
	@printf '%s\n' $(TABLE_CLASSES) | xargs -d '\n' -n 1 -P $$(nproc) \
	  $< table --machines $(TABLE_MACHINES) --class

$(BUILD)/reference/library_f64.o: tests/reference/judge/library.c
	$(call compile,$(JUDGE_FLAGS))
$(BUILD)/reference/library_f32.o: tests/reference/judge/library.c
	$(call compile,$(JUDGE_FLAGS) -DTF_REAL_FLOAT)
$(BUILD)/reference/%.o: tests/reference/judge/%.c
	$(call compile,$(JUDGE_FLAGS))
# Its second integration is by SUNDIALS, where that is installed.
SUNDIALS := $(if $(wildcard /usr/include/cvode/cvode.h),-lsundials_cvode \
  -lsundials_nvecserial -lsundials_sunnonlinsolfixedpoint)
$(BUILD)/reference/reference: $(JUDGE_OBJECTS) \
    $(BUILD)/double/libsupport.a \
    $(BUILD)/double/libtwofold.a $(BUILD)/float/libtwofold.a
	@echo '  LINK  $@'
	@$(CC) $(OPT) $(EXTRA) $^ $(SUNDIALS) -lm -o $@
