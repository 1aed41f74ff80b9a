# Reference solutions in quadruple precision, one process a problem. Always by
# gcc: __float128 and libquadmath are its own. Included by the Makefile.

ORACLE := $(wildcard tests/reference/oracle/*.c)
ORACLE_GCC ?= gcc

$(BUILD)/oracle: $(ORACLE) $(wildcard tests/reference/oracle/*.h)
	@mkdir -p $(@D)
	@echo '__float128 sqrtq(__float128); int main(int n, char **a)' \
	  '{ (void)a; return sqrtq(n) < 0; }' | \
	  $(ORACLE_GCC) -x c - -lquadmath -o $@ 2>/dev/null || { rm -f $@; \
	  echo 'make oracle needs gcc with libquadmath, on a processor that it is' \
	  'made for, as x86-64 (Debian: apt-get install gcc).'; exit 1; }
	$(ORACLE_GCC) $(filter-out -Iinclude,$(COMMON)) $(WARN) $(EXTRA) \
	  $(ORACLE) -lquadmath -o $@

.PHONY: oracle
oracle: ## remake tests/data/reference*.h (minutes; libquadmath)
oracle: $(BUILD)/oracle
	@$< names | xargs -P $(shell nproc 2>/dev/null || echo 2) -I NAME \
	  sh -c '$< NAME >$(BUILD)/NAME.new && \
	    mv $(BUILD)/NAME.new tests/data/reference_NAME.h'
	@$< index >$(BUILD)/index.new && mv $(BUILD)/index.new \
	  tests/data/reference.h
	@echo 'The references are in tests/data/.'
