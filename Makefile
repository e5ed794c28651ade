# Short names for what one does most; the work is in CMakePresets.json and scripts/.
# WERROR=ON makes warnings errors; FUZZ_SECONDS is how long each fuzz target runs.
WERROR ?= OFF
FUZZ_SECONDS ?= 60

SOURCES = $(wildcard $(shell git ls-files --cached --others --exclude-standard "*.cpp" "*.hpp"))
CONFIGURE = cmake --log-level=WARNING -DTVG_WARNINGS_AS_ERRORS=$(WERROR) --preset
# Progress is for terminals: elsewhere only what goes wrong is printed.
define BUILD
@if [ -t 1 ]; then cmake --build $(1) $(2); else cmake --build $(1) $(2) -- --quiet; fi
endef

.PHONY: build demo test bench format check-format lint sanitize fuzz clean
.NOTPARALLEL:

build:
	@scripts/install_packages.sh build
	@$(CONFIGURE) release
	$(call BUILD,build/release)

demo: build
	@scripts/demo.sh build/release

test: build
	@scripts/run_tests.sh build/release

bench:
	@scripts/install_packages.sh build bench
	@$(CONFIGURE) bench
	$(call BUILD,build/bench,--target tvg_bench)
	@build/bench/bench/tvg_bench

format:
	@scripts/install_packages.sh check
	@clang-format -i $(SOURCES)

check-format:
	@scripts/install_packages.sh check
	@clang-format --dry-run --Werror $(SOURCES)

lint:
	@scripts/install_packages.sh build check
	@$(CONFIGURE) release
	@scripts/run_tidy.sh build/release

sanitize:
	@scripts/install_packages.sh build
	@$(CONFIGURE) asan-ubsan
	$(call BUILD,build/asan-ubsan)
	@scripts/run_tests.sh build/asan-ubsan

fuzz:
	@scripts/install_packages.sh build check
	@$(CONFIGURE) fuzz
	$(call BUILD,build/fuzz)
	@scripts/run_fuzzers.sh build/fuzz $(FUZZ_SECONDS)

clean:
	@rm -rf build
