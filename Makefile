# SPDX-License-Identifier: Apache-2.0
# Polyshade. `make` sets up, renders the default head through the RTL and checks every pixel.
# PYTHON=python3.12 chooses the interpreter, VERILATOR=/path an installed Verilator.

BIN    := .venv/bin
READY  := .venv/.stamp
SOC    := .venv/soc/.stamp
HEAD   := build/render/head
EQUAL  := $(HEAD)/.equal
PYTEST := $(BIN)/python -m pytest

.DELETE_ON_ERROR:
.PHONY: all help setup test test-all test-one lint format generate sources bench units papers synth formal gate mutants coverage budget report soak machines handoff soc board pictures tables lock clean distclean

all: $(EQUAL) ## Set up, render the default head, check every pixel (the default)
	@echo "$(HEAD)/image.png: rendered by the RTL, every pixel equal to the golden model"

help: ## Print this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-10s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

setup: $(READY) ## Make .venv with the pinned tools

$(READY): requirements.txt pyproject.toml scripts/flow/setup.sh
	@scripts/flow/setup.sh .venv

# One lane draws triangles of a hundred pixels best by the direct form: a pixel a clock from the fewest LUTs, see docs/results.md.
# A mark of its own: were the report the target, make would delete it when it tells of a mismatch.
$(EQUAL): $(READY) $(shell find rtl golden sim scripts -name '*.sv' -o -name '*.f' -o -name '*.py' -o -name '*.cpp')
	@rm -f $@
	$(BIN)/polyshade render --mesh head --size 1024 --path direct --out $(HEAD)
	@touch $@

test: $(READY) ## Run lint, golden, cocotb, NumPy-driven and command-line tests
	@$(BIN)/python -m polyshade.scripts.flow.tools cocotb
	$(PYTEST) -n auto --dist worksteal --junitxml build/test/report.xml

test-all: export FULL = 1
test-all: $(SOC) test ## The same at every parameter point, with ten million vectors a unit

test-one: $(READY) ## Run one test again: T='tb/...::test_x[...]' SEED=1 WAVES=1
	@$(BIN)/python -m polyshade.scripts.flow.tools cocotb
	$(PYTEST) -n 0 -v $(if $(findstring /,$(T)),,-k) '$(or $(T),$(error T is empty: give a test, such as T=tb/fixed/test_third.py))'

lint: $(READY) ## Check RTL and Python: Verilator, Yosys, rules of the house, ruff
	$(BIN)/python -m polyshade.scripts.flow.lint

sources: ## Write build/shade.f: the list of sources with absolute paths, for tools that only know -f
	@mkdir -p build
	sed -e 's|//.*||' -e '/^ *$$/d' -e 's|^|$(CURDIR)/rtl/|' rtl/shade.f > build/shade.f

generate: $(READY) ## Write what is generated: rtl/shade_pkg.sv, the table of 1/sqrt, docs/registers.md, docs/interface.md
	$(BIN)/python -m polyshade.scripts.flow.generate

format: $(READY) ## Format the Python code
	$(BIN)/ruff format
	$(BIN)/ruff check --fix

bench units papers synth formal gate mutants coverage budget report machines handoff: $(READY)
	$(BIN)/polyshade $@

bench: ## Measure speed: simulator, golden model, alternatives; leaves build/bench.json
units: ## Measure every unit: vectors, mismatches, worst error; leaves build/units.json
papers: ## Check every claim of the papers; leaves build/papers.json
formal: ## Prove properties of the modules, and that they can fail; leaves build/formal.json
gate: ## Run the vectors of every unit, and of a small core, through netlists of FPGA cells; leaves build/gate.json
mutants: ## Put faults into every module; its own tests must find them; leaves build/mutants.json
coverage: ## Count what the tests reach in the RTL; leaves build/coverage.json
budget: ## Compare the error of every stage with an oracle of 40 digits; writes docs/error-budget.md
report: ## Put all that was measured on one page: build/report/index.html
machines: ## Measure area, clock, speed and error of every path; leaves build/machines.json
handoff: ## Make the bundle for other designs and try it; leaves build/handoff.tar.gz
synth: ## Synthesize every module: LUT, FF, DSP, BRAM, Fmax; leaves build/synth.json

soak: $(READY) ## Random work against the golden model: MINUTES=1 SEED=1; leaves build/soak.json
	$(BIN)/polyshade soak --minutes $(or $(MINUTES),1) --seed $(or $(SEED),1)

soc: $(READY) $(SOC) ## Draw from C on a soft core of LiteX, in Verilator; leaves build/soc
	$(BIN)/polyshade soc

# LiteX and a C compiler for its soft core: an environment of their own, not part of the set-up
$(SOC): requirements-soc.txt | $(READY)
	$(or $(PYTHON),python3) -m venv --clear .venv/soc
	.venv/soc/bin/python -m pip install --quiet --no-deps --require-hashes -r requirements-soc.txt
	@touch $@

board: $(READY) ## Make the bitstream of a board: BOARD=ulx3s; leaves build/board
	$(BIN)/polyshade board '$(or $(BOARD),$(error BOARD is empty: allowed ulx3s))'

pictures: $(READY) ## Make the pictures of the READMEs again, in docs
	$(BIN)/python -m polyshade.scripts.drawings.pictures

tables: $(READY) ## Write the tables of the documents from the reports in build
	$(BIN)/python -m polyshade.scripts.drawings.tables

lock: ## Write requirements.txt from requirements.in
	scripts/flow/lock.sh

clean: ## Remove what was built
	rm -rf build

distclean: clean ## Remove the virtual environment as well
	rm -rf .venv *.egg-info .pytest_cache .ruff_cache
