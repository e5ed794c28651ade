#!/bin/bash
# run_fuzzers.sh BUILD_FOLDER SECONDS: runs each fuzz target for so long, from its seeds (BUILD_FOLDER/seeds/TARGET)
# and from what earlier runs found (BUILD_FOLDER/found/TARGET), as many targets at a time as there are processors. A crash
# is kept in BUILD_FOLDER/crashes.
set -euo pipefail
build=$1
seconds=$2
mkdir -p "$build/crashes"

# Prints a line, and fails with what led to it where there is a finding.
fuzz() {
  local target=$1 program log=$build/$1.log folders=("$build/found/$1")
  program=$(find "$build" -type f -name "$target" -perm -u+x | head -n 1)
  if [ -z "$program" ]; then
    echo "run_fuzzers.sh: no program $target in $build" >&2
    return 1
  fi
  mkdir -p "${folders[0]}"
  [ ! -d "$build/seeds/$target" ] || folders+=("$build/seeds/$target")
  if ! "$program" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -print_final_stats=1 \
    -artifact_prefix="$build/crashes/$target-" "${folders[@]}" >"$log" 2>&1; then
    tail -n 60 "$log" >&2
    for input in "$build/crashes/$target-"*; do
      echo "$input, to be kept as a seed (base64 -d):" >&2
      base64 "$input" | head -c 20000 >&2
    done
    return 1
  fi
  echo "$target: $(grep -o 'number_of_executed_units: *[0-9]*' "$log" | tr -dc 0-9) executions, no finding"
}

running=0 status=0
for target in decoder_fuzz connectivity_fuzz c_api_fuzz c_api_encoder_fuzz streams_fuzz obj_fuzz ply_fuzz off_fuzz \
  stl_fuzz mtl_fuzz cache_fuzz npy_fuzz npz_fuzz weights_fuzz skeleton_fuzz scene_header_fuzz gltf_fuzz; do
  if [ $running -lt "$(nproc)" ]; then running=$((running + 1)); else wait -n || status=1; fi
  fuzz "$target" &
done
for ((; running > 0; running--)); do
  wait -n || status=1
done
exit $status
