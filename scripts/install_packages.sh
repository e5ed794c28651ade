#!/bin/bash
# install_packages.sh GROUP...: makes sure the Debian packages of the groups (build, test, bench, check, portability, web)
# are installed.
# Does nothing when all are there; as root it installs the missing ones; otherwise it lists them and fails.
set -euo pipefail

build=(cmake g++ make ninja-build pkg-config libeigen3-dev libnanoflann-dev libopenmesh-dev libcli11-dev libfmt-dev
  nlohmann-json3-dev libxxhash-dev libgtest-dev libgmock-dev libglfw3-dev libimgui-dev libepoxy-dev libegl-dev
  libfontconfig-dev libgl1-mesa-dri libjpeg-dev libpng-dev libcurl4-openssl-dev libcpp-httplib-dev fonts-dejavu-core libassimp-dev
  libtinygltf-dev libmeshoptimizer-dev libzstd-dev zlib1g-dev)
test=(ffmpeg nginx-light xvfb libx11-dev assimp-testmodels python3 python3-numpy python3-setuptools python3-wheel
  python3-pip python3-venv python3-mypy slurm-wlm munge parallel)
bench=(libbenchmark-dev libdraco-dev)
check=(clang clang-format clang-tidy libclang-rt-14-dev)
# Without g++-multilib, which Debian does not let stand beside compilers for other machines.
portability=(cmake g++ ninja-build pkg-config libxxhash-dev clang g++-12-multilib g++-aarch64-linux-gnu
  g++-s390x-linux-gnu qemu-user g++-mingw-w64-x86-64-posix wine64 emscripten nodejs
  node-typescript)
# Node may come from elsewhere, with an npm of its own that Debian's does not go with.
web=(cmake g++ ninja-build pkg-config libxxhash-dev emscripten node-typescript)
command -v npm >/dev/null || web+=(nodejs npm)

wanted=()
for group in "$@"; do
  case $group in
    build) wanted+=("${build[@]}") ;;
    test) wanted+=("${test[@]}") ;;
    bench) wanted+=("${bench[@]}") ;;
    check) wanted+=("${check[@]}") ;;
    portability) wanted+=("${portability[@]}") ;;
    web) wanted+=("${web[@]}") ;;
    *) echo "install_packages.sh: no group '$group' (build, test, bench, check, portability, web)" >&2; exit 1 ;;
  esac
done

if ! command -v dpkg-query >/dev/null; then
  echo "This is not a Debian system: what is needed goes by these names there: ${wanted[*]}" >&2
  exit 0
fi

missing=()
for package in "${wanted[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

if [ "$(id -u)" -ne 0 ]; then
  echo "These packages are missing: ${missing[*]}" >&2
  echo "Install them with: sudo apt-get install --no-install-recommends ${missing[*]}" >&2
  exit 1
fi

echo "Installing ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
export DEBIAN_FRONTEND=noninteractive
if ! { apt-get update -qq && apt-get install -y -qq --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
  tail -n 20 "$log" >&2
  exit 1
fi
