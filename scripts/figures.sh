#!/bin/bash
# figures.sh BUILD_FOLDER OUTPUT_FOLDER: the paper's Figures 1(a), 2 and 3 as pictures. Those of real sequences need
# TVG_DATA_DIR, a folder with chicken and horse-gallop as .obj and .pc2; without it they are left as they are.
set -euo pipefail
build=$1
out=$2
tvg=$build/cli/tvg
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

# draw INPUT... FRAME CAMERA OUTPUT
draw() {
  local count=$#
  local inputs=("${@:1:count-3}") frame=${*:count-2:1} camera=${*:count-1:1} picture=${*:count:1}
  "$tvg" render "${inputs[@]}" -o "$picture" --frames "$frame-$frame" --camera "$camera" --size 280x280 --shading flat \
    --background white --no-labels --quiet
}

# label TEXT PICTURE: writes it at the top left.
label() {
  ffmpeg -v error -y -i "$2" -vf \
    "drawtext=fontfile=/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf:text='$1':x=6:y=6:fontsize=15" "$2.labelled.png"
  mv "$2.labelled.png" "$2"
}

# stack hstack|vstack OUTPUT PICTURE...
stack() {
  local how=$1 picture=$2 inputs=()
  shift 2
  for each in "$@"; do inputs+=(-i "$each"); done
  ffmpeg -v error -y "${inputs[@]}" -filter_complex "$how=inputs=$#" -pix_fmt rgb24 -compression_level 100 "$picture"
}

simplify() {
  "$tvg" simplify "$@" --no-distance --quiet
}

# One row of frames each: the original, MAPS, MAPS + CURV at ratio 2.5.
# figure_1 NAME OBJ PC2 CAMERA FRAME...
figure_1() {
  local name=$1 mesh=$2 cache=$3 camera=$4
  shift 4
  simplify "$mesh" "$cache" -o "$work/maps.pc2" --ratio 2.5 --priority maps
  simplify "$mesh" "$cache" -o "$work/curv.pc2" --ratio 2.5 --priority curv
  local rows=()
  for row in original maps curv; do
    local inputs=("$work/$row.obj" "$work/$row.pc2") text="MAPS" pictures=()
    [ $row = original ] && inputs=("$mesh" "$cache") && text="original"
    [ $row = curv ] && text="MAPS + CURV"
    for frame in "$@"; do
      draw "${inputs[@]}" "$frame" "$camera" "$work/$row.$frame.png"
      pictures+=("$work/$row.$frame.png")
    done
    label "$text" "${pictures[0]}"
    stack hstack "$work/$row.png" "${pictures[@]}"
    rows+=("$work/$row.png")
  done
  stack vstack "$out/figure_1a_$name.png" "${rows[@]}"
}

# The hand at ratio 6 by four priorities.
figure_2() {
  local pictures=()
  for priority in maps curv skel curv+skel; do
    local options=()
    [[ $priority == *skel* ]] && options=(--skeleton "$work/hand.skeleton.json")
    simplify "$work/hand.obj" "$work/hand.pc2" -o "$work/$priority.pc2" --ratio 6 --priority "$priority" "${options[@]}"
    draw "$work/$priority.obj" "$work/$priority.pc2" 44 front "$work/$priority.png"
    local text=${priority^^}
    [ "$priority" = maps ] || text="MAPS + ${text//+/ + }"
    label "$text" "$work/$priority.png"
    pictures+=("$work/$priority.png")
  done
  stack hstack "$out/figure_2.png" "${pictures[@]}"
}

# The chicken at four resolutions.
figure_3() {
  local pictures=()
  for bits in 11:9 9 9:7 7; do
    "$tvg" encode "$TVG_DATA_DIR/chicken.obj" "$TVG_DATA_DIR/chicken.pc2" -o "$work/chicken.tvg" --bits $bits --frames 0-49 \
      --quiet
    draw "$work/chicken.tvg" 25 "$1" "$work/chicken.$bits.png"
    label "${bits/:/-} bits" "$work/chicken.$bits.png"
    pictures+=("$work/chicken.$bits.png")
  done
  stack hstack "$out/figure_3.png" "${pictures[@]}"
}

for name in face hand; do "$build/corpus/tvg_corpus" $name -o "$work" >/dev/null; done
figure_1 face "$work/face.obj" "$work/face.pc2" front 10 30 50 70
figure_2
if [ -z "${TVG_DATA_DIR:-}" ]; then
  echo "TVG_DATA_DIR is not set: the figures of horse-gallop and chicken are left as they are"
  exit 0
fi
figure_1 horse "$TVG_DATA_DIR/horse-gallop.obj" "$TVG_DATA_DIR/horse-gallop.pc2" 60,15 0 6 12 18
figure_3 30,15
