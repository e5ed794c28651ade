# Short names for what one does most; the work is in CMakePresets.json and scripts/.
# WERROR=ON makes warnings errors; FUZZ_SECONDS is how long each fuzz target runs; LINT lists folders for clang-tidy,
# and LINT_CHECKS what is added to its checks or, with a minus, left out; OPTIONS go to CMake.
WERROR ?= OFF
FUZZ_SECONDS ?= 60
LINT = libcodec tool encoder decoder player server codecs cli
LINT_CHECKS ?=
OPTIONS ?=
# Configurations of scripts/check_portability.sh; all where empty.
PORTABILITY ?=
# Folders of tests to run under sanitizers; all where empty.
SANITIZE ?=

SOURCES = $(wildcard $(shell git ls-files --cached --others --exclude-standard "*.c" "*.cpp" "*.h" "*.hpp"))
CONFIGURE = cmake -DTVG_WARNINGS_AS_ERRORS=$(WERROR) $(OPTIONS) --preset
# Progress is for terminals: elsewhere only what goes wrong is printed.
define BUILD
@if [ -t 1 ]; then cmake --build $(1) $(2); else cmake --build $(1) $(2) -- --quiet; fi
endef

.PHONY: build demo test web bench figures format check-format lint sanitize fuzz portability clean
.NOTPARALLEL:

build:
	@scripts/install_packages.sh build
	@$(CONFIGURE) release >/dev/null
	$(call BUILD,build/release)

demo: build
	@scripts/demo.sh build/release

test: build
	@scripts/install_packages.sh test
	@scripts/run_tests.sh build/release

# The npm package, and the player's files for the pages of tvg page and tvg serve.
web: export NODE_PATH ?= /usr/share/nodejs
web:
	@scripts/install_packages.sh web
	@cd web && npm ci --loglevel=error --ignore-scripts --no-audit --no-fund
	@$(CONFIGURE) wasm -DTVG_BUILD_TESTS=OFF >/dev/null
	$(call BUILD,build/wasm,--target tvg_web)
	@cd build/wasm && npm pack --silent ./web
	@echo "The package is build/wasm/tvg-*.tgz; tvg page and tvg serve find the player in build/wasm/web/page"

bench:
	@scripts/install_packages.sh build bench
	@$(CONFIGURE) bench >/dev/null
	$(call BUILD,build/bench,--target tvg_bench)
	@build/bench/bench/tvg_bench

# The paper's figures, and the comparison of simplifiers that goes with them; real sequences come from TVG_DATA_DIR.
figures: build
	@scripts/install_packages.sh test bench
	@scripts/figures.sh build/release docs/pictures
	@$(CONFIGURE) bench >/dev/null
	$(call BUILD,build/bench,--target tvg_simplifiers)
	@build/bench/bench/tvg_simplifiers -o bench/simplify

format:
	@scripts/install_packages.sh check
	@clang-format -i $(SOURCES)

check-format:
	@scripts/install_packages.sh check
	@clang-format --dry-run --Werror $(SOURCES)

lint:
	@scripts/install_packages.sh build check
	@$(CONFIGURE) release -B build/lint -DTVG_UNITY=OFF >/dev/null
	@LINT_CHECKS="$(LINT_CHECKS)" scripts/run_tidy.sh build/lint $(LINT)

sanitize:
	@scripts/install_packages.sh build test
	@$(CONFIGURE) asan-ubsan >/dev/null
	$(call BUILD,build/asan-ubsan,$(if $(SANITIZE),--target $(addsuffix _tests,$(SANITIZE))))
	@LSAN_OPTIONS=suppressions=$(CURDIR)/tests/leaks.supp:print_suppressions=0 \
	  scripts/run_tests.sh build/asan-ubsan $(SANITIZE)

fuzz:
	@scripts/install_packages.sh build check
	@$(CONFIGURE) fuzz >/dev/null
	$(call BUILD,build/fuzz,--target tvg_fuzzers)
	@scripts/run_fuzzers.sh build/fuzz $(FUZZ_SECONDS)

# The decoder with other compilers and on other machines.
portability:
	@scripts/install_packages.sh portability
	@WERROR=$(WERROR) OPTIONS="$(OPTIONS)" scripts/check_portability.sh $(PORTABILITY)

clean:
	@rm -rf build
