# The simulator as a functional mock-up unit (FMU) for other simulation tools.
# Included by the Makefile.
#
#   SCENE=chaos        what it starts with: the name of a scene, or a file (one
#                      with a . or a / in its name)
#   ONLY='bits take'   of test-fmu: tests whose names contain one of these

# Where `make fmu` puts what it makes: twofold.fmu is for FMI 3.0.
FMU_DIST := $(BUILD)/dist
FMU_SCENE := $(notdir $(or $(SCENE),chaos))
FMU_SCENES := $(patsubst %,$(BUILD)/fmu/%/done,$(shell \
  sed -n 's/^ *\.name = "\(.*\)",$$/\1/p' src/scene/scenes.c))
FMU_CORE := $(CORE:%.c=$(BUILD)/fmu/core/%.o)
FMU_FLAGS := $(COMMON) $(WARN) -Wdouble-promotion -fno-math-errno -fPIC \
  -fvisibility=hidden -ffunction-sections -fdata-sections
FMU_BINARY_fmi2 := binaries/linux64
FMU_BINARY_fmi3 := binaries/x86_64-linux

.PHONY: fmu test-fmu

fmu: ## FMUs of SCENE=chaos: build/dist/twofold.fmu
fmu: $(BUILD)/fmu/$(FMU_SCENE)/done
	@mkdir -p $(FMU_DIST)
	@cp $(<D)/twofold.fmu $(<D)/twofold-fmi2.fmu $(FMU_DIST)
	@echo 'FMI 3.0: $(FMU_DIST)/twofold.fmu'
	@echo 'FMI 2.0: $(FMU_DIST)/twofold-fmi2.fmu'

test-fmu: ## the FMUs of all scenes under an importer of their own
test-fmu: $(FMU_SCENES) $(BUILD)/double/twofold
	@MAKEFLAGS= MAKELEVEL= MAKE='$(MAKE)' BUILD='$(BUILD)' OPT='$(OPT)' \
	  CC='$(CC)' EXTRA='$(EXTRA)' tests/fmu/test_fmu.py $(ONLY)

$(BUILD)/fmu/flags: FORCE
	@mkdir -p $(@D)
	@new=$@.$$$$; echo '$(CC) $(FMU_FLAGS) $(EXTRA) $(CORE)' >$$new; \
	if cmp -s $$new $@; then rm $$new; else mv $$new $@; fi

$(BUILD)/fmu/core/%.o: %.c $(BUILD)/fmu/flags
	$(call compile,$(FMU_FLAGS) $(SRC_FLAGS_$(*F)))
$(BUILD)/fmu/libtwofold.a: $(FMU_CORE)
	$(archive)
$(BUILD)/fmu/describe: tools/package/fmu/describe.c tools/package/fmu/variables.c \
    $(SCENE_READER) $(BUILD)/fmu/libtwofold.a tools/package/fmu/variables.h
	@echo '  LINK  $@'
	@$(CC) $(COMMON) $(WARN) -Itools $(EXTRA) $(filter %.c %.a,$^) -lm -o $@

FMU_SOURCES := $(wildcard tools/package/fmu/*.[chp]* include/*.h include/twofold/*.h \
  src/*/*.[ch]) docs/FMU.md LICENSE
# The scene that a folder is named after: $(call fmu_scene,folder).
fmu_scene = $(if $(filter $(FMU_SCENE),$(1)),$(or $(SCENE),chaos),$(1))
# $(call fmu_link,directory of the scene,fmi2 or fmi3)
define fmu_link
	@mkdir -p $(1)/$(2)/$(FMU_BINARY_$(2))
	@$(CC) $(FMU_FLAGS) $(EXTRA) -shared -s -Wl,--gc-sections \
	  -Wl,-z,defs -Wl,-soname,twofold.so \
	  $(1)/$(2)/sources/fmu_*.c $(BUILD)/fmu/libtwofold.a \
	  -o $(1)/$(2)/$(FMU_BINARY_$(2))/twofold.so
endef
# Of a file the rest is made anew each time: it may be another file by now.
$(BUILD)/fmu/%/done: $(BUILD)/fmu/describe $(BUILD)/double/constants \
    $(FMU_SOURCES) \
    $(if $(findstring .,$(SCENE))$(findstring /,$(SCENE)),FORCE)
	@mkdir -p $(@D)
	@echo '  FMU   $(@D)'
	@$< '$(call fmu_scene,$*)' >$(@D)/description.json
	@$(BUILD)/double/constants --scene '$(call fmu_scene,$*)' >$(@D)/scene.h
	@tools/package/fmu/package.py layout $(@D)/description.json $(@D)
	$(call fmu_link,$(@D),fmi2)
	$(call fmu_link,$(@D),fmi3)
	@tools/package/fmu/package.py pack $(@D) $(@D)/twofold-fmi2.fmu \
	  $(@D)/twofold.fmu
	@touch $@
