# Renders a mission as N shards with make, so many at a time as -j says, merges, completes and verifies them:
#
#   make -f scripts/shards.mk -j4 N=16 MISSION=mission.yaml OUT=out/big
#
# Shard k goes to OUT.parts/k. HOSTS="one two" runs the shards on these machines by ssh, in turn; they have the same
# folders and the program at the same place. To retry, give the same command again.
root := $(abspath $(dir $(lastword $(MAKEFILE_LIST)))/..)
SONARSIM ?= $(or $(wildcard $(root)/build/sonarsim),sonarsim)
$(foreach v,N MISSION OUT,$(if $(filter 1,$(words $($(v)))),,\
    $(error $(v) must be one word: make -f scripts/shards.mk N=16 MISSION=mission.yaml OUT=out/big)))
$(if $(shell [ "$(N)" -ge 1 ] 2>/dev/null && echo yes),,$(error N must be a number from 1 on))

numbers := $(shell seq $(N))
parts := $(addprefix $(OUT).parts/,$(numbers))
host = $(word $(shell expr \( $(@F) - 1 \) % $(words $(HOSTS)) + 1),$(HOSTS))

all: $(parts)
	$(SONARSIM) merge $(parts) $(OUT) --quiet
	$(SONARSIM) render $(MISSION) --quiet --out $(OUT)
	$(SONARSIM) verify $(OUT) --quiet

$(parts):
	$(if $(HOSTS),ssh $(host) cd $(CURDIR) '&&') \
	    $(SONARSIM) render $(MISSION) --quiet --threads 1 --shard $(@F)/$(N) --out $@

.PHONY: all $(parts)
