# Figures: `make figures`, or some of them: `make figures FIGURES='tyre atlas'`.
# Each is tools/study/figures/NAME.gp over data in $(BUILD)/figures, which the command
# line program or a program of tools/study/figures makes. docs/FIGURES.md shows them.

ALL_FIGURES := surface atlas normal regions set tyre exits return \
  perturbations portrait
FIGURES ?= $(ALL_FIGURES)
figdir := $(BUILD)/figures
two := $(BUILD)/double/twofold
FIGURE_PROGRAMS := surface normal portrait tyre
figtool := $(BUILD)/double/tools/study/figures

# What the samples of `diverge` are: few, so that all is made in two minutes.
# docs/FIGURES.md says what they tell.
WINDOW := --r 0.1:0.28:361 --omega=-1.16:-0.88:281
ATLAS := --r 0.0025:0.5:200 --omega=-1.4975:-0.5:200
SAMPLES_random := 2000
SAMPLES_noise := 200
SAMPLES_smoothing := 200
SAMPLES_hysteresis := 150
SAMPLES_delay := 100
BY_random := --by random --rate 10
BY_noise := --by noise --size 1e-4
BY_smoothing := --by smoothing --size 1e-5
BY_hysteresis := --by hysteresis --size 1e-3
BY_delay := --by delay --size 1e-3
KINDS := random noise smoothing hysteresis delay

.PHONY: figures keep-figures keep-futures figures-gnuplot
HELPERS += figures-gnuplot
figures: ## the pictures of docs/FIGURES.md (gnuplot)
figures: $(FIGURES:%=$(figdir)/%.svg) $(FIGURES:%=$(figdir)/%.png)
	@echo 'The figures are in $(figdir)/: $(FIGURES)'

keep-figures: ## copy them to docs/figures/
keep-figures: $(ALL_FIGURES:%=$(figdir)/%.svg)
	mkdir -p docs/figures
	cp $^ docs/figures/
	sed -i "s|^Of commit .*|$$(tools/stamp core)|" docs/FIGURES.md

keep-futures: ## the moving picture of README.md: docs/futures.svg
keep-futures: $(two)
	tools/study/figures/futures.py $(two) docs/futures.svg

figures-gnuplot:
	@command -v gnuplot >/dev/null || { \
	  echo 'make figures needs gnuplot (Debian: apt-get install gnuplot-nox)' \
	  >&2; exit 1; }

# A picture in both forms. Its data are named below.
define draw
@echo '  PLOT  $@'
@gnuplot -e "out='$@.new'; type='$(suffix $@)'; data='$(figdir)'" \
  tools/study/figures/style.gp $< 2>$@.log && mv $@.new $@ && rm $@.log || \
  { cat $@.log >&2; exit 1; }
endef
$(figdir)/%.svg: tools/study/figures/%.gp tools/study/figures/style.gp | figures-gnuplot
	$(draw)
$(figdir)/%.png: tools/study/figures/%.gp tools/study/figures/style.gp | figures-gnuplot
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

$(FIGURE_PROGRAMS:%=$(figtool)/%): %: %.o $(BUILD)/double/libtwofold.a
	$(link)

# NAME.dat of a program and its arguments: $(call by-program,NAME,PROGRAM,ARGS)
define by-program
$(figdir)/$(1).dat: $(figtool)/$(2) tools/study/figures/figures.mk \
    | figures-gnuplot
	$$(call quietly,$$< $(3))
endef
$(eval $(call by-program,borders,surface,borders))
$(eval $(call by-program,flow,surface,flow))
$(eval $(call by-program,orbits,normal,orbits))
$(eval $(call by-program,straight,normal,directions))
$(eval $(call by-program,numbers,normal,numbers))
$(eval $(call by-program,directions,portrait,directions))
$(eval $(call by-program,angular,portrait,angular))
$(eval $(call by-program,corner,portrait,orbits 0.17))
$(eval $(call by-program,tyre,tyre,))

# NAME.csv of a command: $(call by-command,NAME,ARGS)
define by-command
$(figdir)/$(1).csv: $(two) tools/study/figures/figures.mk | figures-gnuplot
	$$(call quietly,$$< $(2))
endef
$(eval $(call by-command,regions,regions chaos $(WINDOW)))
$(eval $(call by-command,atlas,atlas chaos $(ATLAS)))
$(eval $(call by-command,branches,diverge chaos --exhaustive --depth 1 \
  --grid 0.005 --patience 2.4 --branches -))

$(figdir)/two-fold.dat: tools/study/figures/two_fold.py $(two) \
    tools/study/figures/figures.mk | figures-gnuplot
	$(call quietly,$(two) singularities chaos | $<)

# Returns and exits of one kind of perturbation.
define by-diverge
$(figdir)/returns-$(1).csv: $(two) tools/study/figures/figures.mk | figures-gnuplot
	$$(call quietly,$$< diverge chaos $$(BY_$(1)) --samples \
	  $$(SAMPLES_$(1)) --patience 300 --exits $(figdir)/exits-$(1).csv \
	  --returns -)
endef
$(foreach k,$(KINDS),$(eval $(call by-diverge,$(k))))

# Trajectories, from lists of starts.
lists := tools/study/figures/lists.py
paths := tools/study/figures/paths.py
$(figdir)/fans.dat: $(lists) $(paths) $(two) tools/study/figures/figures.mk \
    | figures-gnuplot
	$(call quietly,$(lists) fans | $(paths) $(two) 2e-5 0)
$(figdir)/set.dat: $(lists) $(paths) $(figdir)/branches.csv \
    tools/study/figures/figures.mk
	$(call quietly,$(lists) leavers $(figdir)/branches.csv | \
	  $(paths) $(two) 2e-4 0.08)
$(figdir)/loop.dat: $(lists) $(paths) $(figdir)/branches.csv \
    tools/study/figures/figures.mk
	$(call quietly,$(lists) loop $(figdir)/branches.csv | \
	  $(paths) $(two) 2e-4 0.01)

# NAME.curves.dat, what curves.py picks out of data for the figure NAME:
# $(call by-curves,NAME,DATA)
curves := tools/study/figures/curves.py
define by-curves
$(figdir)/$(1).curves.dat: $(curves) $(2:%=$(figdir)/%) tools/study/figures/figures.mk
	$$(call quietly,$$< $(1) $(figdir))
endef
$(eval $(call by-curves,exits,returns-random.csv branches.csv))
$(eval $(call by-curves,normal,branches.csv))
$(eval $(call by-curves,perturbations,$(KINDS:%=returns-%.csv)))
$(eval $(call by-curves,regions,branches.csv))
$(eval $(call by-curves,return,returns-random.csv branches.csv))
$(eval $(call by-curves,set,set.dat))
$(eval $(call by-curves,surface,fans.dat))

# What each picture is made of.
needs = $(foreach e,svg png,$(figdir)/$(1).$(e)): $(2:%=$(figdir)/%)
$(call needs,surface,surface.curves.dat)
$(call needs,atlas,atlas.csv two-fold.dat)
$(call needs,normal,orbits.dat straight.dat numbers.dat loop.dat \
  normal.curves.dat two-fold.dat)
$(call needs,regions,regions.csv borders.dat flow.dat \
  regions.curves.dat two-fold.dat)
$(call needs,set,set.curves.dat borders.dat two-fold.dat)
$(call needs,tyre,tyre.dat)
$(call needs,exits,exits.curves.dat)
$(call needs,return,return.curves.dat)
$(call needs,perturbations,perturbations.curves.dat \
  $(KINDS:%=returns-%.csv))
$(call needs,portrait,directions.dat angular.dat corner.dat)
