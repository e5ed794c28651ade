#!/bin/bash
# run_tidy.sh BUILD_FOLDER FOLDER...: clang-tidy on the sources of these folders, by the build's compile_commands.json.
# LINT_CHECKS in the environment are added to the checks of .clang-tidy. Prints findings only; any finding fails.
set -euo pipefail
build=$1
shift
folders=$(IFS="|"; echo "$*")
log=$build/clang-tidy.log
if ! run-clang-tidy -quiet ${LINT_CHECKS:+"-checks=$LINT_CHECKS"} -extra-arg=-fno-color-diagnostics -p "$build" -j "$(nproc)" "$PWD/($folders)/" >"$log" 2>&1; then
  grep -vE '^clang-tidy|^[0-9]+ warnings? (generated|treated)|^Suppressed |^$' "$log" >&2 || cat "$log" >&2
  exit 1
fi
echo "clang-tidy: no findings"
