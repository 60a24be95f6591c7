# The front door. CMake and Ninja do the work (CMakePresets.json); this file only sets them up and calls them.

RELEASE := build/release
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
SOURCES = $(shell git ls-files '*.h' '*.cpp')
FUZZERS = $(patsubst fuzz/%_fuzzer.cpp,%,$(wildcard fuzz/*_fuzzer.cpp))
FUZZ_SECONDS ?= 60
PREFIX ?= /usr/local
PYTHON := build/python/venv
PEERS := build/peers/venv
SCENES ?=
SEED ?= 1
THREADS ?= 2
PEERS_FLAGS ?=

# $(call configure,PRESET): where it was not done, or not with this Python; afterwards Ninja itself notices changes.
configure = test -f build/$(1)/build.ninja -a ! $(PYTHON)/ready -nt build/$(1)/build.ninja || cmake --preset $(1)

.DEFAULT_GOAL := help
.PHONY: help setup setup-lint python-setup build demo test web wheel install verify-long verify-random bench bench-techniques bench-peers format format-check lint odr sanitize fuzz clean

help: ## this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-14s %s\n", $$1, $$2 }' Makefile

setup: ## install what building, testing and installing need (apt), or name it
	@scripts/setup build test install

setup-lint: ## install also what format, lint and fuzz need
	@scripts/setup build test lint

build: setup ## the optimised program: build/release/stilb
	@$(call configure,release)
	@cmake --build --preset release --target stilb

demo: build ## measure the example office, with a picture: out/office.png
	@mkdir -p out
	$(RELEASE)/stilb measure scenes/office/office.toml --falsecolor out/office.png
	@echo "The picture of the working planes: out/office.png"

$(PYTHON)/ready: python/requirements.txt | setup
	@scripts/setup python
	@python3 -m venv $(PYTHON)
	@$(PYTHON)/bin/pip install --quiet --disable-pip-version-check -r $<
	@touch $@

python-setup: $(PYTHON)/ready ## a virtual environment with all that the Python package is built and tested with (apt, PyPI)

test: setup $(PYTHON)/ready ## build everything and run all tests
	@$(call configure,release)
	@cmake --build --preset release
	@ctest --preset release -j $(JOBS)

wheel: setup $(PYTHON)/ready ## the Python package with all libraries that it needs: out/stilb-*.whl
	@$(PYTHON)/bin/python python/make_wheel.py out

install: build ## the program, the library with its CMake package, manual pages and completions: PREFIX, DESTDIR
	@scripts/setup install
	@cmake --build --preset release --target stilb_library
	@cmake --install build/release --prefix $(PREFIX)

verify-long: build ## all exact solutions at 0.2 %, CIE 171, closed meshes with 1e8 rays each, patches as they shrink, harmonics, coverage of readings, pixels and ratings, the tests that are coarser in `make test`, time limits
	$(RELEASE)/stilb verify --error 0.2%
	$(RELEASE)/stilb verify --cie171 --error 0.5%
	@cmake --build --preset release --target verify_watertight verify_patches verify_harmonics verify_coverage verify_pooled verify_ratings verify_glare
	$(RELEASE)/verify_watertight 100000000
	$(RELEASE)/verify_patches
	$(RELEASE)/verify_harmonics
	$(RELEASE)/verify_coverage
	$(RELEASE)/verify_pooled
	$(RELEASE)/verify_ratings
	$(RELEASE)/verify_glare
	@cmake --build --preset release
	STILB_FINE=1 ctest --preset release -j $(JOBS) -R "^(agreement|run|walk|io):"
	tests/long/verify_limits.py
	$(MAKE) bench-techniques

verify-random: setup ## SCENES random scenes (2000), from SEED (1), each measured in many ways that must agree: docs/verification.md
	@$(call configure,release)
	@cmake --build --preset release --target verify_random
	$(RELEASE)/verify_random --thresholds
	$(RELEASE)/verify_random --seed $(SEED) $(or $(SCENES),2000)

web: setup ## check and build the page of `stilb view` alone: build/release/page/dist
	@$(call configure,release)
	@cmake --build --preset release --target stilb_page
	@ctest --preset release -R page:types

bench: setup ## the benchmarks
	@$(call configure,release)
	@cmake --build --preset release
	@for program in $$(ls $(RELEASE)/bench_* | grep -v techniques); do \
	    echo "$$program"; "$$program" || exit 1; done

bench-techniques: setup ## counted work of each technique in ten scenes (or SCENES="room attic"): fails where it differs from the baseline
	@$(call configure,release)
	@cmake --build --preset release --target bench_techniques
	$(RELEASE)/bench_techniques --baseline benchmarks/techniques/baseline.csv $(SCENES)

$(PEERS)/ready: benchmarks/peers/requirements.txt
	@scripts/setup peers
	@python3 -m venv $(PEERS)
	@$(PEERS)/bin/pip install --quiet --disable-pip-version-check -r $<
	@touch $@

bench-peers: build $(PEERS)/ready ## time to a given error beside Mitsuba and Radiance; SCENES="room hall", THREADS=1: some, and on one thread
	@$(PEERS)/bin/python benchmarks/peers/bench.py --threads $(THREADS) $(PEERS_FLAGS) $(SCENES)

format: setup-lint ## rewrite all sources in the project's format
	@clang-format-14 -i $(SOURCES)

format-check: setup-lint ## fail where a source is not in the project's format
	@clang-format-14 --dry-run -Werror $(SOURCES)

lint: setup-lint odr ## clang-tidy, the directions of includes, and one definition of each name
	@scripts/check-includes
	@cmake --preset release -B build/lint -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DSTILB_UNITY=OFF
	@# Not the server: clang 14 does not know the coroutines of C++20.
	@run-clang-tidy-14 -quiet -j $(JOBS) -p build/lint -extra-arg=-Wno-unused-command-line-argument '^$(CURDIR)/(src|experiments)/(?!walk/service/server.cpp)'

odr: setup ## link with link-time optimisation: fails where two files define one name in two ways
	@$(call configure,odr)
	@cmake --build --preset odr --target stilb

sanitize: setup ## all tests with address and undefined-behaviour sanitizers
	@$(call configure,sanitize)
	@cmake --build --preset sanitize
	@ctest --preset sanitize -j $(JOBS)

fuzz: setup-lint ## each reader's fuzz target for FUZZ_SECONDS (60)
	@$(call configure,fuzz)
	@cmake --build --preset fuzz --target $(FUZZERS:%=fuzz_%)
	@for name in $(FUZZERS); do \
	    found=build/fuzz/found/$$name; mkdir -p $$found; \
	    echo "fuzz_$$name: $(FUZZ_SECONDS) s"; \
	    build/fuzz/fuzz_$$name -max_total_time=$(FUZZ_SECONDS) -timeout=10 -rss_limit_mb=2048 -verbosity=0 \
	        -artifact_prefix=$$found- $$found fuzz/corpus/$$name || exit 1; \
	done

clean: ## remove build/ and out/
	rm -rf build out
