#!/bin/bash
# check_portability.sh [CONFIGURATION...]: builds the decoder alone with other compilers and for other machines, and
# runs its tests there: every conformance stream must decode to the digests of corpus/conformance/digests.txt, and the
# decoder must stay within its budgets of size. Without arguments all configurations. WERROR=ON makes warnings errors;
# OPTIONS go to CMake.
#   gcc-O0 gcc-O3 clang-O0 clang-O3   this machine; the first with libraries that are all static
#   m32                               32 bits of x86
#   aarch64                           64 bits of ARM, under qemu
#   s390x                             a machine that stores the most significant byte first, under qemu
#   mingw                             Windows, under wine
#   wasm                              WebAssembly, under Node, and the npm package around it
#   size                              made for size, this machine
set -euo pipefail
cd "$(dirname "$0")/.."

known=(gcc-O0 gcc-O3 clang-O0 clang-O3 m32 aarch64 s390x mingw wasm size)
wanted=("$@")
[ $# -gt 0 ] || wanted=("${known[@]}")

# Debian's Emscripten looks for what shrinks its scripts here; wine keeps its state in the build.
export NODE_PATH=${NODE_PATH:-/usr/share/nodejs}
export WINEPREFIX=$PWD/build/portability/wine WINEDEBUG=-all

# What CMake must be told for a configuration, in `options`.
compiler() { options+=("-DCMAKE_C_COMPILER=$1" "-DCMAKE_CXX_COMPILER=$2"); }
optimize() { options+=(-DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=$1"); }
# A program for another machine brings its libraries with it, so that the emulator needs none.
cross() {
  options+=("-DCMAKE_SYSTEM_NAME=$1" "-DCMAKE_SYSTEM_PROCESSOR=$2" "-DCMAKE_CROSSCOMPILING_EMULATOR=$3"
    -DCMAKE_EXE_LINKER_FLAGS=-static)
}
set_options() {
  options=()
  case $1 in
    gcc-O0) compiler gcc g++ && optimize -O0 && options+=(-DBUILD_SHARED_LIBS=OFF) ;;
    gcc-O3) compiler gcc g++ && optimize -O3 ;;
    clang-O[03]) compiler clang clang++ && optimize "-${1#clang-}" ;;
    m32)
      # A few headers of Linux are the same for both widths, and found for the wider only.
      compiler gcc g++ && optimize -O3
      options+=("-DCMAKE_C_FLAGS=-m32 -idirafter /usr/include/x86_64-linux-gnu"
        "-DCMAKE_CXX_FLAGS=-m32 -idirafter /usr/include/x86_64-linux-gnu")
      ;;
    aarch64 | s390x)
      compiler "$1-linux-gnu-gcc" "$1-linux-gnu-g++" && cross Linux "$1" "qemu-$1" && optimize -O3
      ;;
    mingw)
      compiler x86_64-w64-mingw32-gcc-posix x86_64-w64-mingw32-g++-posix
      cross Windows x86_64 /usr/lib/wine/wine64 && optimize -O3
      ;;
    # Their sizes are those of what is shipped: each source by itself, which also shows includes that are missing, with
    # two standard libraries.
    wasm) options=(--preset wasm -DTVG_UNITY=OFF) ;;
    size) compiler gcc g++ && options+=(-DCMAKE_BUILD_TYPE=MinSizeRel -DTVG_UNITY=OFF) ;;
    *)
      echo "check_portability.sh: no configuration '$1' (${known[*]})" >&2
      exit 1
      ;;
  esac
}

# Each step says nothing unless it fails.
quietly() {
  "$@" >"$log" 2>&1 || { cat "$log" && return 1; }
}
check() {
  local build=build/portability/$1 log=build/portability/$1.log began=$SECONDS
  set_options "$1"
  # shellcheck disable=SC2086  # OPTIONS are several.
  quietly cmake -S . -B "$build" -G Ninja -DTVG_BUILD_ENCODER=OFF -DTVG_WARNINGS_AS_ERRORS="${WERROR:-OFF}" \
    ${OPTIONS:-} "${options[@]}" &&
    quietly cmake --build "$build" &&
    quietly ctest --test-dir "$build" --no-tests=error --output-on-failure || return 1
  printf '%-9s %3d s  %s\n' "$1" $((SECONDS - began)) "$(summary "$build")"
}
# A program that finds wine's state half made, because its making was cut off, fails: so it is made first, and whole.
prepare_wine() {
  [ -e "$WINEPREFIX/drive_c/windows/system32/kernel32.dll" ] && return
  rm -rf "$WINEPREFIX"
  /usr/lib/wine/wine64 wineboot --init >/dev/null 2>&1
}
# The tests that ran, and how large the decoder is where that was measured.
summary() {
  local log=$1/Testing/Temporary/LastTest.log
  sed -n 's/^[0-9]*\/[0-9]* Test: //p' "$log" | tr '\n' ' '
  sed -n 's/; the budget is .*//p' "$log" | sed 's/^.*\///' | tr '\n' ' '
}

# What the package for the web has beside its core needs three.js from npm's registry.
prepare_web() {
  [ ! -d web/node_modules/three ] || return 0
  (cd web && npm ci --silent --ignore-scripts --no-audit --no-fund) >/dev/null 2>&1 ||
    echo "wasm: npm ci failed in web/, so tvg/three and the page are left out"
}

# Two at a time: each has stretches that keep one core busy, and emulators that start slowly.
mkdir -p build/portability
running=0 status=0
for configuration in "${wanted[@]}"; do
  [ "$configuration" != wasm ] || prepare_web
  [ "$configuration" != mingw ] || prepare_wine || true
  if [ $running -lt 2 ]; then running=$((running + 1)); else wait -n || status=1; fi
  { check "$configuration" || { echo "$configuration FAILED" && exit 1; }; } &
done
for ((; running > 0; running--)); do
  wait -n || status=1
done
exit $status
