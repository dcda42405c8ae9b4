# Renders a mission over a grid of noise parameters, one folder per point:
#
#   make -f scripts/sweep.mk -j2 MISSION=configs/tank_imaging.yaml OUT=out/sweep SENSOR=fls \
#        add_sigma="0 0.1 0.2" mult_sigma="0 0.2"
#
# writes OUT/add_sigma=0.1,mult_sigma=0.2/ and so on, and OUT/index.csv with the parameters of every
# folder. What is done is not done again; what was interrupted resumes. -jN renders N points at a
# time, each on one thread. SENSOR may name several sensors.

noise_keys := range_lambda_m scatterer_m add_sigma mult_sigma
keys := $(noise_keys) seed
known := MISSION OUT SENSOR SONARSIM $(keys)

root := $(abspath $(dir $(lastword $(MAKEFILE_LIST)))/..)
OUT ?= out/sweep
SONARSIM ?= $(root)/build/sonarsim

comma := ,
empty :=
space := $(empty) $(empty)

# A mistyped parameter would otherwise be left out without a word.
given := $(foreach v,$(.VARIABLES),$(if $(filter line,$(origin $(v))),$(v)))
unknown := $(filter-out $(known),$(given))
$(if $(unknown),$(error unknown: $(unknown). Known: $(known)))
$(if $(MISSION),,$(error give MISSION=mission.yaml))
$(if $(wildcard $(MISSION)),,$(error $(MISSION): no such file))
$(if $(filter 1,$(words $(OUT))),,$(error OUT must be one folder without spaces in its name))

axes := $(filter $(given),$(keys))
$(if $(axes),,$(error give at least one of $(keys), as in add_sigma="0 0.1"))
$(if $(filter $(axes),$(noise_keys)),$(if $(SENSOR),,$(error give SENSOR=, the name of a sensor of $(MISSION))))

# points: the cross product of the axes, each point spelled a=1,b=2. The sort also drops doubles.
cross = $(if $(1),$(foreach p,$(1),$(addprefix $(p)$(comma)$(2)=,$($(2)))),$(addprefix $(2)=,$($(2))))
points :=
$(foreach axis,$(axes),$(eval points := $(call cross,$(points),$(axis))))
points := $(sort $(points))

# Bins that no scene lights hold noise alone, and the same draws where the seed is the same.
seeds := $(if $(filter seed,$(axes)),$(sort $(seed)),one)
$(if $(filter-out $(words $(seeds)),$(words $(points))),$(warning points that share a seed have the \
same noise, bit for bit, in every bin that nothing lights. To train with one and test with another \
is a leak: give each a seed of its own, or keep those of one seed on the same side))

targets := $(points:%=$(OUT)/%/dataset.json)
done := $(if $(targets),$(shell grep -ls '"complete": *true' $(targets)))

settings = $(subst $(comma), ,$(1))
values = $(subst $(space),$(comma),$(foreach s,$(call settings,$(1)),$(lastword $(subst =, ,$(s)))))
sets = $(foreach s,$(call settings,$(1)),$(if $(filter seed=%,$(s)),--set $(s),$(SENSOR:%=--set sensors.%.noise.$(s))))

.PHONY: all again
all: $(OUT)/index.csv

# make would delete a half-done dataset.json on Ctrl-C, and with it what a resume needs.
.PRECIOUS: $(targets)

$(targets): $(MISSION)
	$(SONARSIM) render $(MISSION) --quiet --threads 1 --out '$(@D)' $(call sets,$(notdir $(@D)))

$(filter-out $(done),$(targets)): again

$(OUT)/index.csv: $(targets) again
	@$(file >$@.part,$(subst $(space),$(comma),$(axes)),folder)$(foreach p,$(points),$(file >>$@.part,$(call values,$(p)),"$(p)"))
	@mv $@.part $@
	@echo '$@: $(words $(points)) points'
