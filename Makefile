# make: set up and run the shipped example.  make test: the tests of the code.  make test-runs: those that start
# processes or take more than a second.  make test-all: every test, within an hour.
PYTHON ?= python3
VENV ?= .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.installed
TOOLS := $(VENV)/.tools
# Without bytecode: Python writes that of the third of all modules that are imported.
PIP := $(BIN)/python -m pip install --quiet --no-compile

# What tests docs/research is collected by check-research alone.
TESTS := $(BIN)/python -m pytest -n logical --dist loadfile --ignore tests/research

COMPILE := uv pip compile --universal --python-version 3.11 --generate-hashes --no-emit-index-url --no-header
EXECUTOR := snakemake-executor-plugin-slurm
SLURM := workflow/profiles/slurm/requirements.lock
OPENQUAKE := $(VENV)/openquake
ENGINE := openquake-engine==3.26.2

# Tests start many processes, and each would compile the whole package again to bytecode.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: all run setup slurm openquake test test-runs test-both sentences test-all bench trace check near expected check-research schema pages figures measured paper documentation wheel versions dist release lock clean

all: run

run: setup
	$(BIN)/rocking run

setup: $(STAMP)

$(STAMP): requirements.lock pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(PIP) --require-hashes -r requirements.lock
	$(PIP) --no-deps --no-build-isolation -e .
	touch $(STAMP)

# What tests, checks and the documentation need besides.
$(TOOLS): $(STAMP) development.lock
	$(PIP) --require-hashes -r development.lock
	touch $(TOOLS)

# Apart from the rest: snakemake imports every executor it finds at each start, and this one costs it a third of a second.
slurm: setup
	$(PIP) --require-hashes --no-deps -r $(SLURM)

# Apart from the rest, as it pins other versions of what both need. Without GDAL, which it exports rasters with.
openquake: $(OPENQUAKE)/.installed

$(OPENQUAKE)/.installed: tests/workflow/openquake.lock
	$(PYTHON) -m venv $(OPENQUAKE)
	$(OPENQUAKE)/bin/python -m pip install --quiet --no-compile --no-deps --require-hashes -r tests/workflow/openquake.lock
	touch $(OPENQUAKE)/.installed

test: $(TOOLS)
	$(TESTS)

# Snakemake, commands, browsers and other processes, and what takes more than a second.
test-runs: $(TOOLS)
	$(TESTS) -m "process and not slow"

# Both at once, those files first that take long, so that no core waits for the last of them; one worker more than cores, as
# a test of a process waits for it.
test-both: $(TOOLS)
	$(TESTS) -n $$(expr $$(getconf _NPROCESSORS_ONLN) + 1) --no-loadscope-reorder -m "not slow"

# The sentences that refuse and warn, as the tests meet them: tests/sentences.txt, to which every later run is held.
sentences: $(TOOLS)
	ROCKING_SENTENCES=1 $(MAKE) test-both

# The slow ones too: research, every page, ten thousand damaged files, and twenty runs that are killed and go on.
test-all: check-research openquake
	ROCKING_KILLS=20 $(TESTS) -m "" --hypothesis-profile thorough

bench: $(TOOLS)
	for script in tests/benchmarks/bench_*.py; do $(BIN)/python $$script || exit 1; done

# Which files and functions the job of one record enters, in their order.
trace: $(TOOLS)
	$(BIN)/python tests/benchmarks/trace_record.py

check: $(TOOLS)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy rocking
	$(BIN)/snakefmt --check Snakefile workflow
	$(BIN)/python -m docs.site.pages --check

# The tests that import what has changed since the commit SINCE.
SINCE ?= HEAD
near: $(TOOLS)
	tests=$$($(BIN)/python -m tests.near $(SINCE)) && { [ -z "$$tests" ] || $(BIN)/python -m pytest -q -n 0 $$tests; }

# What a study says now, which the commit that changes it explains.
expected: $(TOOLS)
	ROCKING_EXPECTED=1 $(BIN)/python -m pytest -q -n 0 -m process tests/workflow/test_expected.py

# The scripts of the research, which are no part of the package.
check-research: $(TOOLS)
	$(BIN)/mypy docs/research
	$(BIN)/python -m pytest -n logical --dist loadfile -m "" --hypothesis-profile thorough tests/research

# What the package's own fields say, written where the workflow reads it; a test compares.
schema: setup
	$(BIN)/python -c "from rocking.assessment.scene import scenes_schema_file as text; print(text(), end='')" \
	  > workflow/schemas/structures.schema.yaml
	$(BIN)/python -c "from rocking.study.settings import schema_file as text; print(text(), end='')" \
	  > workflow/schemas/config.schema.yaml
	$(BIN)/python -c "from rocking.study.settings import EXAMPLE, commented_yaml as text; print(text(EXAMPLE), end='')" \
	  > config/config.yaml

# What the code says of itself, written into the pages; `make figures` also runs their examples and draws.
pages: $(TOOLS)
	$(BIN)/python -m docs.site.pages

figures: $(TOOLS)
	$(BIN)/python -m docs.site.pages --figures

# The measured figures whose code has changed since.
measured: $(TOOLS)
	$(BIN)/python -m docs.site.measured

paper: setup
	$(BIN)/python -m docs.paper.write $(MIRROR)

documentation: $(TOOLS)
	$(BIN)/python -m docs.site.build

# The wheel and the source archive.
dist: setup
	rm -rf dist
	$(BIN)/python -m hatchling build -d dist

# A study that the wheel runs where nothing else of the project is.
wheel: dist
	.ci/wheel $(VENV)

# The wheel under the newest Pythons.
versions: dist
	.ci/versions

# The same of a version that stands in pyproject.toml and, with its date, in the changelog.
release: $(TOOLS)
	version=$$(sed -n 's/^version = "\(.*\)"/\1/p' pyproject.toml) && \
	  grep -Eq "^## $$version - [0-9]{4}-[0-9]{2}-[0-9]{2}$$" CHANGELOG.md || \
	  { echo "CHANGELOG.md has no entry like: ## $$version - 2026-01-31; date the one of this version."; exit 1; }
	$(BIN)/python -m docs.site.measured --first-screen
	$(MAKE) wheel

lock:
	$(COMPILE) pyproject.toml --extra build --extra workflow -o requirements.lock
	$(COMPILE) pyproject.toml --extra build --extra workflow --extra asdf --extra docs --extra test -c requirements.lock -o development.lock
	printf '%s\n' $(EXECUTOR) $(EXECUTOR)-jobstep | $(COMPILE) - --no-deps -o $(SLURM)
	{ $(COMPILE) tests/workflow/openquake.in; echo $(ENGINE) | $(COMPILE) - --no-deps; } > tests/workflow/openquake.lock

clean:
	rm -rf results .snakemake
