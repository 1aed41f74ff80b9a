# The studies of the paper's machine and the pictures of it. Included by the
# Makefile. tools/study/run makes a section and its page in docs/, which is kept
# by keep-SECTION; the counts behind it are kept in docs/study.
#
#   CYCLES=20 MACHINES=200 MECHANISMS=100   less of a section
#   FIGURES='tyre atlas'   of figures: some of them
#   ONLY='counts map'      of test-shards: tests whose names have one of these

two := $(BUILD)/double/twofold
study = @BUILD='$(BUILD)' TWOFOLD='$(two)' tools/study/run

$(BUILD)/study/machines: $(BUILD)/double/tools/study/machines.o \
    $(BUILD)/double/libtwofold.a
	@mkdir -p $(@D)
	$(link)

TROLLEY := $(BUILD)/study/trolley
$(TROLLEY): $(BUILD)/double/tools/study/trolley.o \
    $(BUILD)/double/libtwofold.a
	@mkdir -p $(@D)
	$(link)

# Laws without a jump, in four precisions. Always by gcc: __float128 and its
# library are its own.
FINER := $(patsubst %,$(BUILD)/study/finer-%,24 53 64 113)
FINER_GCC ?= gcc
FINER_SOURCES := tools/study/finer.c tests/reference/model.c \
  tests/reference/extrapolate.c
$(FINER): $(BUILD)/study/finer-%: $(FINER_SOURCES) \
    $(wildcard tests/reference/*.h)
	@mkdir -p $(@D)
	@echo '  CC    $@'
	@$(FINER_GCC) $(filter-out -Iinclude,$(COMMON)) $(WARN) $(EXTRA) \
	  -DREF_BITS=$* $(FINER_SOURCES) -lm $(if $(filter 113,$*),-lquadmath) \
	  -o $@

.PHONY: statistics keep-statistics recurrence recurrence-page keep-recurrence \
  noise keep-noise finer keep-finer sides keep-sides mechanisms \
  keep-mechanisms trolley keep-trolley figures keep-figures keep-futures \
  figures-gnuplot test-shards
statistics: ## exits and returns of chaos, counted (15 minutes)
statistics: $(two) $(BUILD)/study/machines
	$(study) exits
recurrence: ## where motions return, over 20000 machines (25 minutes)
recurrence: $(two)
	$(study) recurrence
recurrence-page: ## its page again, from the rows that are there
recurrence-page: $(two)
	$(study) recurrence count
noise: ## what vanishing noise selects, at three steps (2 hours)
noise: $(two)
	$(study) noise
finer: ## what finer laws select behind the two-fold (10 minutes)
finer: $(two) $(FINER)
	$(study) finer
sides: ## their first sides at 200 widths a decade (50 minutes)
sides: $(two) $(FINER)
	$(study) sides
mechanisms: ## two-folds of 100000 random mechanisms (5 minutes)
	$(study) mechanisms
keep-statistics: ## copy what statistics made to docs/
	$(study) exits keep
keep-recurrence: ## copy what recurrence made to docs/
	$(study) recurrence keep
keep-noise: ## copy what noise made to docs/
	$(study) noise keep
keep-finer: ## copy what finer made to docs/
	$(study) finer keep
keep-sides: ## copy what sides made to docs/
	$(study) sides keep
keep-mechanisms: ## copy what mechanisms made to docs/
	$(study) mechanisms keep
trolley: ## two-folds of a castor, and what follows them
trolley: $(TROLLEY)
	@tools/study/trolley.py $< $(BUILD)/study/trolley.svg
keep-trolley: ## copy what trolley drew to docs/study/
	cp $(BUILD)/study/trolley.svg docs/study/
test-shards: ## sweeps under parallel, Snakemake; studies
test-shards: $(two) $(BUILD)/study/finer-64 $(TROLLEY)
	@TWOFOLD='$<' FINER='$(BUILD)/study/finer-64' TROLLEY='$(TROLLEY)' \
	  tests/shards/test_shards.py $(ONLY)

# Figures. Each is tools/study/figures/NAME.gp over data in $(BUILD)/figures,
# which the command line or tools/study/figures/fields makes. docs/FIGURES.md
# shows them.
ALL_FIGURES := surface atlas normal regions set tyre exits return portrait
FIGURES ?= $(ALL_FIGURES)
figdir := $(BUILD)/figures
figtool := tools/study/figures
fields := $(BUILD)/double/$(figtool)/fields

# What the samples of `diverge` are: few, so that all is made in two minutes.
# docs/FIGURES.md says what they tell.
WINDOW := --r 0.1:0.28:361 --omega=-1.16:-0.88:281
ATLAS := --r 0.0025:0.5:200 --omega=-1.4975:-0.5:200

figures: ## the pictures of docs/FIGURES.md (gnuplot)
figures: $(FIGURES:%=$(figdir)/%.svg) $(FIGURES:%=$(figdir)/%.png)
	@echo 'The figures are in $(figdir)/: $(FIGURES)'

keep-figures: ## copy them to docs/figures/
keep-figures: $(ALL_FIGURES:%=$(figdir)/%.svg)
	mkdir -p docs/figures
	cp $^ docs/figures/
	core=$$(tools/stamp core) && sed -i "/^Of commit /,/^$$/{//!d; \
	  s|^Of commit .*|$$core|}" docs/FIGURES.md

keep-futures: ## the moving picture of README.md: docs/futures.svg
keep-futures: $(two)
	$(figtool)/futures.py $(two) docs/futures.svg

figures-gnuplot:
	@command -v gnuplot >/dev/null || { \
	  echo 'make figures needs gnuplot (Debian: apt-get install gnuplot-nox)' \
	  >&2; exit 1; }

# A picture in both forms. Its data are named below.
define draw
@echo '  PLOT  $@'
@gnuplot -e "out='$@.new'; type='$(suffix $@)'; data='$(figdir)'" \
  $(figtool)/style.gp $< 2>$@.log && mv $@.new $@ && rm $@.log || \
  { cat $@.log >&2; exit 1; }
endef
$(figdir)/%.svg: $(figtool)/%.gp $(figtool)/style.gp | figures-gnuplot
	$(draw)
$(figdir)/%.png: $(figtool)/%.gp $(figtool)/style.gp | figures-gnuplot
	$(draw)

# Runs a command that prints rows. Of what it says, how long it still takes
# appears at once (a line in ten seconds), the rest where it fails.
define quietly
@mkdir -p $(figdir)
@echo '  DATA  $@'
@rm -f $@.failed
@{ { $(1); } 2>&1 >$@.new || : >$@.failed; } | sed -un -e 'w $@.log' \
  -e 's/^twofold: \(.* left.*\)/        $(@F): \1/p'
@[ ! -e $@.failed ] || { cat $@.log >&2; rm $@.failed; exit 1; }
@rm $@.log
@mv $@.new $@
endef

$(fields): %: %.o $(BUILD)/double/libtwofold.a
	$(link)
$(foreach n,borders flow orbits straight numbers directions angular corner, \
  $(figdir)/$(n).dat): $(figdir)/%.dat: $(fields) | figures-gnuplot
	$(call quietly,$< $*)

# NAME.csv of a command: $(call by-command,NAME,ARGS)
define by-command
$(figdir)/$(1).csv: $(two) tools/study/study.mk | figures-gnuplot
	$$(call quietly,$$< $(2))
endef
$(eval $(call by-command,regions,regions chaos $(WINDOW)))
$(eval $(call by-command,atlas,atlas chaos $(ATLAS)))
$(eval $(call by-command,branches,diverge chaos --exhaustive --depth 1 \
  --grid 0.005 --patience 2.4 --branches -))
$(eval $(call by-command,futures,diverge chaos --exhaustive --depth 8 \
  --grid 0.06 --patience 2.4 --count 5000 --branches -))
STRING := tyre chaos --set law=string --set a=1 --set rho=0.6666666666666667
$(eval $(call by-command,string,$(STRING) --set k=1 --set delta=1 \
  --set sigma=1 --angle 0:90:181))
$(eval $(call by-command,stiff,$(STRING) --set k=1e3 --set delta=1e-3 \
  --set sigma=1e-3 --angle 1:90:2))
$(eval $(call by-command,tyre,tyre chaos))

# Returns and exits at random.
$(figdir)/returns-random.csv: $(two) tools/study/study.mk | figures-gnuplot
	$(call quietly,$< diverge chaos --rate 10 --samples 2000 --patience 300 \
	  --exits $(figdir)/exits-random.csv --returns -)

# Trajectories: $(call by-list,NAME,LIST,STEP,THIN,DATA), and what is picked out
# of data for the figure NAME: $(call by-curves,NAME,DATA)
curves := $(figtool)/curves.py
define by-list
$(figdir)/$(1).dat: $(curves) $(two) $(5:%=$(figdir)/%) tools/study/study.mk \
    | figures-gnuplot
	$$(call quietly,$$< $(2) $(figdir) $(two) $(3) $(4))
endef
$(eval $(call by-list,fans,fans,2e-5,0))
$(eval $(call by-list,set,futures,5e-5,0.001,futures.csv))
$(eval $(call by-list,loop,loop,2e-4,0.001,branches.csv))
define by-curves
$(figdir)/$(1).curves.dat: $(curves) $(2:%=$(figdir)/%) tools/study/study.mk
	$$(call quietly,$$< $(1) $(figdir))
$(foreach e,svg png,$(figdir)/$(1).$(e)): $(figdir)/$(1).curves.dat
endef
$(eval $(call by-curves,exits,returns-random.csv branches.csv))
$(eval $(call by-curves,normal,branches.csv))
$(eval $(call by-curves,regions,branches.csv))
$(eval $(call by-curves,return,returns-random.csv branches.csv))
$(eval $(call by-curves,set,set.dat futures.csv borders.dat))
$(eval $(call by-curves,surface,fans.dat))

# What else each picture is made of.
needs = $(foreach e,svg png,$(figdir)/$(1).$(e)): $(2:%=$(figdir)/%)
$(call needs,atlas,atlas.csv numbers.dat)
$(call needs,normal,orbits.dat straight.dat numbers.dat loop.dat)
$(call needs,regions,regions.csv borders.dat flow.dat numbers.dat)
$(call needs,set,numbers.dat)
$(call needs,tyre,string.csv stiff.csv tyre.csv)
$(call needs,portrait,directions.dat angular.dat corner.dat)
