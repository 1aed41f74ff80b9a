# The project in the forms that others expect: libraries and packages, and a
# functional mock-up unit (FMU) for other simulation tools. Included by the
# Makefile.
#
#   DIST_SCENE=driven  a further scene that is prepared as one header
#   DESTDIR=           where a package is put together
#   PREFIX=/usr/local  where things are installed
#   DISTS='cmake zephyr'    of test-dist: tests whose names contain one
#   SCENE=chaos        what an FMU starts with: the name of a scene, or a file
#                      (one with a . or a / in its name)
#   ONLY='bits take'   of test-fmu: tests whose names contain one of these

DIST := $(BUILD)/dist
DIST_SCENE ?=
DESTDIR ?=
PREFIX ?= /usr/local
DISTS ?=
TF_VERSION := $(shell sed -n 's/^\#define TF_VERSION "\(.*\)"/\1/p' \
  include/twofold.h)
DIST_CONSTANTS := $(REALS:%=$(BUILD)/%/constants)

.PHONY: dist install uninstall test-dist
dist: ## two files, a prepared scene, packages: into build/dist
dist: $(DIST_CONSTANTS) $(DIST)/c/twofold.c $(BUILD)/double/help.c
	@for scene in $(sort chaos smooth $(DIST_SCENE)); do \
	  tools/package/dist/scene.py $$scene $(DIST_CONSTANTS) $(DIST)/c || \
	  exit 1; done
	@tools/package/dist/packages.py $(DIST)/c $(DIST) \
	  $(BUILD)/double/help.c
	@echo 'The packages are in $(DIST).'

$(DIST)/c/twofold.c: $(wildcard include/*.h include/twofold/*.h src/*/*.[ch]) \
    tools/package/dist/sources.py LICENSE
	@mkdir -p $(@D)
	@tools/package/dist/sources.py $(@D)

# What is installed, below PREFIX. Libraries of both types have names of their
# own, as their functions have. A folder may have blanks in its name.
AT := '$(subst ','\'',$(DESTDIR)$(PREFIX))'
INSTALLED = bin/twofold include/twofold.h \
  $(wildcard include/twofold/*.h) \
  lib/libtwofold_f64.a lib/libtwofold_f32.a \
  $(addprefix lib/pkgconfig/,twofold.pc twofold_f64.pc twofold_f32.pc) \
  $(patsubst tools/package/dist/install/%.cmake,lib/cmake/twofold/%.cmake,\
    $(wildcard tools/package/dist/install/*.cmake)) \
  share/man/man1/twofold.1 $(COMPLETIONS)
# Where the shells look for them.
COMPLETIONS := share/bash-completion/completions/twofold \
  share/zsh/site-functions/_twofold share/fish/vendor_completions.d/twofold.fish
# Folders of its own, and others, which go with it where they are then empty and
# no folder of the system.
ROOMS := include/twofold lib/cmake/twofold
ifneq ($(filter-out '/usr' '/usr/' '/usr/local' '/usr/local/',$(AT)),)
ROOMS += bin include lib/pkgconfig lib/cmake lib share/man/man1 share/man \
  $(foreach room,bash-completion/completions bash-completion \
    zsh/site-functions zsh fish/vendor_completions.d fish,share/$(room)) share
endif

# $(call fill,FROM,TO,REAL,TYPE,FLAGS)
fill = sed 's/@VERSION@/$(TF_VERSION)/g; s/@REAL@/$(3)/; s/@TYPE@/$(4)/; \
  s/@FLAGS@/$(5)/' tools/package/dist/install/$(1) \
  >$(AT)/$(strip $(2))
install: ## libraries, headers, program: DESTDIR= PREFIX=/usr/local
install: $(BUILD)/double/twofold $(BUILD)/float/libtwofold.a
	@mkdir -p $(AT)/bin $(AT)/include/twofold $(AT)/lib/pkgconfig \
	  $(AT)/lib/cmake/twofold $(AT)/share/man/man1
	@install -m 755 $(BUILD)/double/twofold $(AT)/bin/twofold
	@install -m 644 include/twofold.h $(AT)/include
	@install -m 644 include/twofold/*.h $(AT)/include/twofold
	@install -m 644 $(BUILD)/double/libtwofold.a $(AT)/lib/libtwofold_f64.a
	@install -m 644 $(BUILD)/float/libtwofold.a $(AT)/lib/libtwofold_f32.a
	@$(call fill,twofold.pc,lib/pkgconfig/twofold.pc)
	@$(call fill,twofold_REAL.pc,lib/pkgconfig/twofold_f64.pc,f64,double)
	@$(call fill,twofold_REAL.pc,lib/pkgconfig/twofold_f32.pc,f32,float, \
	  -DTF_REAL_FLOAT)
	@$(call fill,twofoldConfig.cmake,lib/cmake/twofold/twofoldConfig.cmake)
	@$(call fill,twofoldConfigVersion.cmake,\
	  lib/cmake/twofold/twofoldConfigVersion.cmake)
	@tools/package/dist/manual $(BUILD)/double/twofold $(TF_VERSION) \
	  >$(AT)/share/man/man1/twofold.1
	@for file in $(COMPLETIONS); do \
	  mkdir -p $(AT)/$${file%/*} && \
	  $(BUILD)/double/twofold completions $$(echo $$file | cut -d / -f 2 | \
	    sed 's/-.*//') >$(AT)/$$file || exit 1; done
	@echo 'twofold $(TF_VERSION) is in' $(AT).

uninstall: ## remove what `make install` put there
	@rm -f $(foreach file,$(INSTALLED),$(AT)/$(file))
	@rmdir $(foreach room,$(ROOMS),$(AT)/$(room)) 2>/dev/null || true

.PHONY: api
api: ## the public headers as pages: build/api/index.html
	@command -v doxygen >/dev/null || { echo >&2 'doxygen is missing' \
	  '(Debian: apt-get install doxygen)'; exit 3; }
	@rm -rf $(BUILD)/api && mkdir -p $(BUILD)
	@{ cat tools/package/dist/api/Doxyfile; echo 'HTML_OUTPUT = $(BUILD)/api'; \
	  } | doxygen -
	@echo 'The pages are in $(BUILD)/api/index.html.'

test-dist: ## each package, compiled and run as its user would
test-dist: dist $(BUILD)/double/twofold $(BUILD)/float/twofold
	@MAKEFLAGS= MAKELEVEL= MAKE='$(MAKE)' BUILD='$(BUILD)' \
	  tools/package/dist/test/run.py $(DISTS)

FMU_SCENE := $(notdir $(or $(SCENE),chaos))
FMU_SCENES := $(patsubst %,$(BUILD)/fmu/%/done,$(shell \
  sed -n 's/^ *\.name = "\(.*\)",$$/\1/p' src/scene/scenes.c))
FMU_FLAGS := $(COMMON) $(WARN) -Wdouble-promotion -fno-math-errno -fPIC \
  -fvisibility=hidden -ffunction-sections -fdata-sections
FMU_BINARY_fmi2 := binaries/linux64
FMU_BINARY_fmi3 := binaries/x86_64-linux
# For Windows, where its compiler is there. Bytes depend on no time.
MINGW := $(shell command -v x86_64-w64-mingw32-gcc)
FMU_WINDOWS := -std=c99 -O3 -ffp-contract=off -fno-math-errno
FMU_WINDOWS_LINK := -Wl,--no-insert-timestamp,--disable-auto-image-base
FMU_WINDOWS_fmi2 := binaries/win64
FMU_WINDOWS_fmi3 := binaries/x86_64-windows

.PHONY: fmu test-fmu

fmu: ## FMUs of SCENE=chaos: build/dist/twofold.fmu
fmu: $(if $(word 2,$(SCENE)),,$(BUILD)/fmu/$(FMU_SCENE)/done)
	$(if $(word 2,$(SCENE)),$(error SCENE='$(SCENE)' has a blank, which make \
	  takes for the end of a name: copy the file to one without))
	@cp $(<D)/twofold.fmu $(<D)/twofold-fmi2.fmu $(DIST)
	@echo 'FMI 3.0: $(DIST)/twofold.fmu'
	@echo 'FMI 2.0: $(DIST)/twofold-fmi2.fmu'

test-fmu: ## the FMUs of all scenes under an importer of their own
test-fmu: $(FMU_SCENES) $(BUILD)/double/twofold
	@MAKEFLAGS= MAKELEVEL= MAKE='$(MAKE)' BUILD='$(BUILD)' OPT='$(OPT)' \
	  CC='$(CC)' EXTRA='$(EXTRA)' tests/fmu/test_fmu.py $(ONLY)

$(BUILD)/fmu/flags: FORCE
	@mkdir -p $(@D)
	@new=$@.$$$$; echo '$(CC) $(FMU_FLAGS) $(EXTRA)' >$$new; \
	if cmp -s $$new $@; then rm $$new; else mv $$new $@; fi
$(BUILD)/fmu/twofold.o: $(DIST)/c/twofold.c $(BUILD)/fmu/flags
	@echo '  CC    $@'
	@$(CC) $(filter-out -Wunused-macros,$(FMU_FLAGS)) $(EXTRA) -c $< -o $@
$(BUILD)/fmu/windows.o: $(DIST)/c/twofold.c
	@mkdir -p $(@D)
	@echo '  CC    $@'
	@$(MINGW) $(FMU_WINDOWS) -c $< -o $@
$(BUILD)/fmu/describe: $(addprefix tools/package/fmu/,describe.c variables.c \
    model.c motion.c message.c fmu.h) $(SCENE_READER) $(BUILD)/fmu/twofold.o \
    $(wildcard tools/*.h)
	@echo '  LINK  $@'
	@$(CC) $(COMMON) $(WARN) -Itools $(EXTRA) $(filter %.c %.o,$^) -lm -o $@

FMU_SOURCES := $(wildcard tools/package/fmu/*.[chp]* tools/*.[ch]) \
  docs/USE.md LICENSE
# The scene that a folder is named after: $(call fmu_scene,folder).
fmu_scene = $(if $(filter $(FMU_SCENE),$(1)),$(or $(SCENE),chaos),$(1))
# $(call fmu_link,directory of the scene,fmi2 or fmi3)
define fmu_link
	@mkdir -p $(1)/$(2)/$(FMU_BINARY_$(2))
	@$(CC) $(FMU_FLAGS) $(EXTRA) -shared -s -Wl,--gc-sections \
	  -Wl,-z,defs -Wl,-soname,twofold.so \
	  $$(ls $(1)/$(2)/sources/*.c | grep -v /twofold.c) \
	  $(BUILD)/fmu/twofold.o \
	  -o $(1)/$(2)/$(FMU_BINARY_$(2))/twofold.so
	$(if $(MINGW),@mkdir -p $(1)/$(2)/$(FMU_WINDOWS_$(2)); $(MINGW) \
	  $(FMU_WINDOWS) -shared -s $(FMU_WINDOWS_LINK) \
	  $$(ls $(1)/$(2)/sources/*.c | grep -v /twofold.c) \
	  $(BUILD)/fmu/windows.o -o $(1)/$(2)/$(FMU_WINDOWS_$(2))/twofold.dll)
endef
# Of a file the rest is made anew each time: it may be another file by now.
$(BUILD)/fmu/%/done: $(BUILD)/fmu/describe $(BUILD)/double/constants \
    $(BUILD)/double/twofold $(FMU_SOURCES) \
    $(if $(MINGW),$(BUILD)/fmu/windows.o) \
    $(if $(findstring .,$(SCENE))$(findstring /,$(SCENE)),FORCE)
	@mkdir -p $(@D)
	@echo '  FMU   $(@D)'
	@$< '$(call fmu_scene,$*)' >$(@D)/description.json
	@$(BUILD)/double/constants --scene '$(call fmu_scene,$*)' >$(@D)/scene.h
	@$(BUILD)/double/twofold run '$(call fmu_scene,$*)' --every 100 --format \
	  csv 2>$(@D)/log >$(@D)/reference.csv || [ $$? -eq 5 ]
	@tools/package/fmu/package.py layout $(@D)/description.json \
	  $(DIST)/c $(@D)
	$(call fmu_link,$(@D),fmi2)
	$(call fmu_link,$(@D),fmi3)
	@tools/package/fmu/package.py pack $(@D) $(@D)/twofold-fmi2.fmu \
	  $(@D)/twofold.fmu
	@touch $@
