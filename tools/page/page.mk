# The simulator as a page for a browser: one file without a server. Included by
# the Makefile.
#
#   ONLY='csv board'   of test-page: tests whose names contain one of these

PAGE := $(BUILD)/page
# As on boards with little flash, the parts of a step stay functions: that
# nearly halves the module, and a step takes 1.4 times as long.
PAGE_FLAGS := --target=wasm32 -std=c99 -ffreestanding -Oz -flto \
  -Dalways_inline=unused -ffp-contract=off -fno-math-errno \
  -ffunction-sections -fdata-sections -include tools/page/libc.h \
  -I$(PAGE)/libc -Itools -Iinclude $(filter-out -Wunused-macros,$(WARN))
PAGE_EMPTY := $(addsuffix .h,ctype errno inttypes math stdio stdlib string)
PAGE_LINK := -nostdlib -Wl,--no-entry -Wl,--gc-sections -Wl,--strip-all \
  -Wl,--export=errno -Wl,-z,stack-size=65536
PAGE_CORE := $(wildcard src/*/*.c) tools/cli/monitor/receiver.c \
  $(addprefix tools/cli/setup/,scene_file.c names.c) \
  $(addprefix tools/cli/text/,buffer.c number.c) tools/decimal.c \
  port/arch/memory.c $(wildcard tools/page/*.c)
PAGE_C := $(PAGE_CORE) tools/page/page.mk $(wildcard tools/*.h \
  tools/page/*.h tools/cli/monitor/receiver.h tools/cli/run/row.h \
  tools/cli/setup/*.h tools/cli/text/*.h src/*/*.h include/*.h \
  include/twofold/*.h)
PAGE_SOURCES := $(PAGE_C) tools/page/pack.py \
  $(wildcard tools/page/*.mjs tools/page/*.html tools/page/*.css)

.PHONY: page test-page keep-page page-sources
page: ## the simulator as a page: build/page/index.html
page: $(PAGE)/index.html

test-page: ## the page in headless Chromium, beside the command line
test-page: $(PAGE)/index.html $(BUILD)/double/twofold
	@MAKEFLAGS= MAKELEVEL= MAKE='$(MAKE)' BUILD='$(BUILD)' OPT='$(OPT)' \
	  CC='$(CC)' tests/page/test_page.py $(ONLY)

$(PAGE)/core.wasm: $(PAGE_C)
	@command -v clang wasm-ld >/dev/null || { echo 'make page needs clang' \
	  'and wasm-ld (Debian: apt-get install clang lld)' >&2; exit 3; }
	@mkdir -p $(PAGE)/libc
	@cd $(PAGE)/libc && touch $(PAGE_EMPTY)
	@echo '  WASM  $@'
	@clang $(PAGE_FLAGS) $(PAGE_CORE) $(PAGE_LINK) -o $@

$(PAGE)/index.html: $(PAGE)/core.wasm $(PAGE_SOURCES)
	@tools/page/pack.py $(PAGE)/core.wasm $@ $(PAGE_SOURCES)
	@echo "The page is in $@."

keep-page: ## build it and copy it to docs/page/
keep-page: page
	@mkdir -p docs/page
	@cp $(PAGE)/index.html docs/page/
page-sources:
	@tools/page/pack.py sources $(PAGE_SOURCES)
