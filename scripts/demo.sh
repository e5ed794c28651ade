#!/bin/bash
# demo.sh BUILD_FOLDER: the main job on the project's own corpus: a vertex cache becomes a .tvg and comes back.
set -euo pipefail
build=$1
out=build/demo
tvg=$build/cli/tvg
mkdir -p "$out"

say() { printf '\n$ %s\n' "$*"; }
run() {
  say "$@"
  "$@"
}

run "$build/corpus/tvg_corpus" hand -o "$out"
run "$tvg" encode "$out/hand.obj" "$out/hand.pc2" -o "$out/hand.tvg" --bits 13:11 --important 35% --quiet
run "$tvg" info "$out/hand.tvg"
run "$tvg" decode "$out/hand.tvg" -o "$out/back.pc2" --quiet
run "$tvg" compare "$out/hand.pc2" "$out/back.pc2" --mesh "$out/hand.obj"

before=$(stat -c %s "$out/hand.pc2")
after=$(stat -c %s "$out/hand.tvg")
printf '\n%s: %d bytes of vertex cache, %d bytes of .tvg, %s times smaller\n' "$out/hand.tvg" "$before" "$after" \
  "$(awk "BEGIN { printf \"%.1f\", $before / $after }")"
