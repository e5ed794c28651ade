#!/bin/bash
# run_tidy.sh BUILD_FOLDER: clang-tidy on the library and the tool's own sources (not the tests), by the build's
# compile_commands.json. Prints findings only; any finding fails.
set -euo pipefail
build=$1
log=$build/clang-tidy.log
if ! run-clang-tidy -quiet -p "$build" -j "$(nproc)" "$PWD/(libcodec|encoder|decoder|cli)/" >"$log" 2>&1; then
  grep -vE '^clang-tidy|^[0-9]+ warnings? (generated|treated)|^Suppressed |^$' "$log" >&2 || cat "$log" >&2
  exit 1
fi
echo "clang-tidy: no findings"
