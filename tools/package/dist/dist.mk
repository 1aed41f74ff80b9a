# The project in the forms that others expect. Included by the Makefile.
#
#   DIST_SCENE=driven  a further scene that is prepared as one header
#   DESTDIR=           where a package is put together
#   PREFIX=/usr/local  where things are installed
#   DISTS='c cmake'    only these tests of `make test-dist`

DIST := $(BUILD)/dist
DIST_SCENE ?=
DESTDIR ?=
PREFIX ?= /usr/local
DISTS ?=
TF_VERSION := $(shell sed -n 's/^\#define TF_VERSION "\(.*\)"/\1/p' \
  include/twofold.h)
DIST_CONSTANTS := $(foreach v,double float,$(BUILD)/$(v)/constants)

.PHONY: dist install uninstall test-dist
dist: ## two files, a prepared scene, packages: into build/dist
dist: $(DIST_CONSTANTS)
	@mkdir -p $(DIST)/c
	@tools/package/dist/two_files.py $(DIST)/c
	@for scene in $(sort chaos smooth $(DIST_SCENE)); do \
	  tools/package/dist/scene.py $$scene $(DIST_CONSTANTS) $(DIST)/c || exit 1; done
	@tools/package/dist/packages.py $(DIST)/c $(DIST)
	@echo 'The packages are in $(DIST).'

# What is installed, below PREFIX. Libraries of both types have names of their
# own, as their functions have. A folder may have blanks in its name.
AT := '$(subst ','\'',$(DESTDIR)$(PREFIX))'
INSTALLED = bin/twofold include/twofold.h \
  $(wildcard include/twofold/*.h) \
  lib/libtwofold_f64.a lib/libtwofold_f32.a \
  $(patsubst tools/package/dist/install/%.pc,lib/pkgconfig/%.pc,\
    $(wildcard tools/package/dist/install/*.pc)) \
  $(patsubst tools/package/dist/install/%.cmake,lib/cmake/twofold/%.cmake,\
    $(wildcard tools/package/dist/install/*.cmake)) \
  share/man/man1/twofold.1
# Folders of its own, and others, which go with it where they are then empty and
# no folder of the system.
ROOMS := include/twofold lib/cmake/twofold
ifneq ($(filter-out '/usr' '/usr/' '/usr/local' '/usr/local/',$(AT)),)
ROOMS += bin include lib/pkgconfig lib/cmake lib share/man/man1 share/man share
endif

fill = sed 's/@VERSION@/$(TF_VERSION)/g' $(1) >$(2)
install: ## libraries, headers, program: DESTDIR= PREFIX=/usr/local
install: $(BUILD)/double/twofold $(BUILD)/float/libtwofold.a
	@mkdir -p $(AT)/bin $(AT)/include/twofold $(AT)/lib/pkgconfig \
	  $(AT)/lib/cmake/twofold $(AT)/share/man/man1
	@install -m 755 $(BUILD)/double/twofold $(AT)/bin/twofold
	@install -m 644 include/twofold.h $(AT)/include
	@install -m 644 include/twofold/*.h $(AT)/include/twofold
	@install -m 644 $(BUILD)/double/libtwofold.a $(AT)/lib/libtwofold_f64.a
	@install -m 644 $(BUILD)/float/libtwofold.a $(AT)/lib/libtwofold_f32.a
	@for file in tools/package/dist/install/*.pc; do \
	  $(call fill,$$file,$(AT)/lib/pkgconfig/$${file##*/}) || exit 1; \
	done
	@for file in tools/package/dist/install/*.cmake; do \
	  $(call fill,$$file,$(AT)/lib/cmake/twofold/$${file##*/}) || \
	  exit 1; done
	@tools/package/dist/manual $(BUILD)/double/twofold $(TF_VERSION) \
	  >$(AT)/share/man/man1/twofold.1
	@echo 'twofold $(TF_VERSION) is in' $(AT).

uninstall: ## remove what `make install` put there
	@rm -f $(foreach file,$(INSTALLED),$(AT)/$(file))
	@rmdir $(foreach room,$(ROOMS),$(AT)/$(room)) 2>/dev/null || true

test-dist: ## each package, compiled and run as its user would
test-dist: dist $(BUILD)/double/twofold $(BUILD)/float/twofold
	@MAKEFLAGS= MAKELEVEL= MAKE='$(MAKE)' BUILD='$(BUILD)' \
	  tools/package/dist/test/run.py $(DISTS)
