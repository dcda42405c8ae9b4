# Renders a mission over a grid of values, one folder per point. Any key of a mission is an axis, by
# its name as `sonarsim render --set` takes it:
#
#   make -f scripts/sweep.mk -j2 MISSION=configs/tank_imaging.yaml OUT=out/sweep \
#        sensors.fls.range_max_m="10 20" seed="1 2"
#
# writes OUT/seed=1,sensors.fls.range_max_m=10/ and so on, and OUT/index.csv with the values of every
# folder.
# The parameters of the noise have short names; SENSOR names the sensors that they are for:
#
#        SENSOR=fls add_sigma="0 0.1 0.2" mult_sigma="0 0.2"
#
# Finished points are not rendered again, and fail if they are of other inputs or another version of
# sonarsim; interrupted ones resume. -jN renders N points at a time, each
# on one thread. A point that fails does not stop the others: OUT/failed/ holds its messages, and the
# sweep ends with exit code 2 and the list of them. Values are separated by blanks and hold none; signs
# with a meaning to make or the shell are refused, such as $ ' " * ( ; and !.

noise_keys := range_lambda_m scatterer_m add_sigma mult_sigma
keys := $(noise_keys) seed engine variants
known := MISSION OUT SENSOR SONARSIM $(keys)

root := $(abspath $(dir $(lastword $(MAKEFILE_LIST)))/..)
OUT ?= out/sweep
SONARSIM ?= $(or $(wildcard $(root)/build/sonarsim),sonarsim)

comma := ,
empty :=
space := $(empty) $(empty)

# Without this check a mistyped parameter would be ignored. sonarsim checks keys with dots.
given := $(foreach v,$(.VARIABLES),$(if $(filter line,$(origin $(v))),$(v)))
dotted := $(sort $(foreach v,$(given),$(if $(findstring .,$(v)),$(v))))
unknown := $(filter-out $(known) $(dotted),$(given))
$(if $(unknown),$(error unknown: $(unknown). Known: $(known), and keys with dots as in sensors.fls.range_max_m))

# make runs the $(shell ...) of a value that it expands: before this check only $(value ...) reads one.
signs := $$ ' " ` \ ! % * ? ~ \# ; & | < > ( )
has_sign = $(strip $(foreach sign,$(signs),$(findstring $(sign),$(1)$(value $(1)))))
$(foreach v,$(known) $(dotted),$(if $(filter file default undefined,$(origin $(v))),,$(if $(call has_sign,$(v)),\
    $(error $(v): its name and its value must not hold $(call has_sign,$(v))))))

$(if $(MISSION),,$(error give MISSION=mission.yaml))
$(if $(filter 1,$(words $(MISSION))),,$(error MISSION must be one file without blanks in its name, not '$(MISSION)'))
$(if $(wildcard $(MISSION)),,$(error $(MISSION): no such file))
$(if $(filter 1,$(words $(OUT))),,$(error OUT must be one folder without blanks in its name))

axes := $(filter $(given),$(keys)) $(dotted)
$(if $(strip $(axes)),,$(error give at least one of $(keys), as in add_sigma="0 0.1", or a key with dots))
$(foreach a,$(axes),$(if $(strip $($(a))),,$(error $(a): has no value)))
$(if $(filter $(axes),$(noise_keys)),$(if $(SENSOR),,$(error give SENSOR=, the name of a sensor of $(MISSION))))

# points: the cross product of the axes, each point spelled a=1!b=2. The sort also drops doubles.
cross = $(if $(1),$(foreach p,$(1),$(addprefix $(p)!$(2)=,$($(2)))),$(addprefix $(2)=,$($(2))))
points :=
$(foreach axis,$(axes),$(eval points := $(call cross,$(points),$(axis))))
points := $(sort $(points))

# Bins without an echo hold noise alone, and points with one seed have the same noise.
seeds := $(if $(filter seed,$(axes)),$(sort $(seed)),one)
$(if $(filter-out $(words $(seeds)),$(words $(points))),$(warning points that share a seed have the \
same noise, bit for bit, in every bin without an echo. To train with one and test with another \
is a leak: give each a seed of its own, or keep those of one seed on the same side))

# The folder of a point. Characters that a file name or make does not take are dropped or replaced.
folder = $(subst [,,$(subst ],,$(subst /,_,$(subst :,_,$(subst !,$(comma),$(1))))))
folders := $(foreach p,$(points),$(call folder,$(p)))
$(if $(filter $(words $(points)),$(words $(sort $(folders)))),,$(error two points would have one folder: $(folders)))

settings = $(subst !, ,$(1))
value_of = $(patsubst $(2)=%,%,$(filter $(2)=%,$(call settings,$(1))))
key = $(if $(filter $(1),$(noise_keys)),$(SENSOR:%=sensors.%.noise.$(1)),$(1))
all_keys := $(foreach a,$(axes),$(call key,$(a)))
$(if $(filter $(words $(all_keys)),$(words $(sort $(all_keys)))),,$(error two axes are one key: $(sort $(all_keys))))
sets = $(foreach a,$(axes),$(foreach k,$(call key,$(a)),--set '$(k)=$(call value_of,$(1),$(a))'))

# A stamp for each point. `render` says at once whether its dataset is complete, and of these inputs.
targets := $(folders:%=$(OUT)/finished/%)
point = $(strip $(foreach p,$(points),$(if $(filter $(call folder,$(p)),$(@F)),$(p))))

.PHONY: all $(targets)
all: $(OUT)/index.csv

# --shard: all of a point, even where the sweep runs in a task of a Slurm array.
command = $(SONARSIM) render $(MISSION) --quiet --threads 1 --shard 1/1 --out '$(OUT)/$(@F)' $(call sets,$(point))
note = $(OUT)/failed/$(@F).txt

# After a signal make ends as well.
$(targets): $(MISSION)
	@mkdir -p '$(OUT)/failed' '$(OUT)/finished'; rm -f '$(note)'; [ -e '$@' ] || echo "$(command)"
	@$(command) 2>'$(note)'; code=$$?; cat '$(note)' >&2; \
	    if [ $$code -eq 0 ]; then rm '$(note)'; touch '$@'; else rm -f '$@'; [ $$code -le 128 ] || exit $$code; fi

cell = $(if $(findstring $(comma),$(1)),"$(1)",$(1))
row = $(subst $(space),$(comma),$(foreach a,$(axes),$(call cell,$(call value_of,$(1),$(a)))))
whole = $(filter $(finished),$(call folder,$(1)))
# The points of this grid that failed; OUT/failed/ may have notes of earlier grids as well.
failed = $(foreach f,$(folders),$(if $(wildcard $(OUT)/failed/$(f).txt),$(f)))

$(OUT)/index.csv: $(targets)
	@$(if $(findstring n,$(firstword -$(MAKEFLAGS))),,$(eval finished := $(shell ls '$(OUT)/finished' 2>/dev/null))$(file >$@.part,$(subst $(space),$(comma),$(strip $(axes))),folder)$(foreach p,$(points),$(if $(call whole,$(p)),$(file >>$@.part,$(call row,$(p)),"$(call folder,$(p))"))))
	@mv $@.part $@
	@rmdir '$(OUT)/failed' 2>/dev/null || :
	@[ -z '$(strip $(failed))' ] || { \
	    echo '$(OUT): of $(words $(points)) points these failed, see $(OUT)/failed/:' >&2; \
	    printf '%s\n' $(failed:%='%') >&2; exit 1; }
	@echo '$@: $(words $(points)) points'
