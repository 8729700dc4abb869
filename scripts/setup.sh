#!/usr/bin/env bash
# Installs what the build needs and this machine does not have, by apt, on Debian 12 and 13 and Ubuntu
# 22.04 and 24.04. Does nothing, and asks no network, when everything is there.
#
#   scripts/setup.sh           what building and testing needs
#   scripts/setup.sh --all     also what optional parts of the program need
#   scripts/setup.sh --dev     also what CI checks the sources with
#   scripts/setup.sh --bench   also what bench/compare measures Marrow against
#   scripts/setup.sh --fuzz    also what scripts/fuzz.sh fuzzes with
#   scripts/setup.sh --slurm   also what scripts/check_slurm.sh starts
#
# MARROW_SETUP=skip makes it do nothing, for machines that have the libraries from elsewhere.

source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

packages=(
  g++ cmake ninja-build
  libtbb-dev            # the views in parallel
  libhwy-dev            # the instruction set, chosen at run time
  libtinyobjloader-dev  # OBJ
  zlib1g-dev            # compressed volumes
  libcli11-dev          # the options of the program
  nlohmann-json3-dev    # JSON
  libembree-dev         # rays for silhouettes and the picture
  libpng-dev            # PNG
  catch2                # the tests
)
optional=(
  libassimp-dev         # marrow-import: glTF, FBX and others
  pybind11-dev python3-dev python3-numpy python3-pytest   # the Python module and its tests
  python3-networkx      # Skeleton.to_networkx()
)
case "${1-}" in
  --all) packages+=("${optional[@]}") ;;
  --dev)
    packages+=("${optional[@]}" clang-format clang-tidy shellcheck python3-pyflakes valgrind)
    packages+=(libbenchmark-dev doxygen)
    # Readers of what marrow convert writes.
    packages+=(graphviz python3-networkx assimp-utils python3-vtk9)
    # Opens what marrow view writes; in Ubuntu it comes as a snap.
    grep -q '^ID=ubuntu' /etc/os-release || packages+=(chromium)
    ;;
  --bench) packages+=(libbenchmark-dev libcgal-dev libeigen3-dev python3-skimage python3-matplotlib) ;;
  --slurm) packages+=(slurm-wlm munge procps) ;;
  --fuzz)
    packages+=(clang)
    # In Ubuntu 22.04 the runtime of its fuzzer comes with clang itself.
    grep -q jammy /etc/os-release || packages+=(libclang-rt-dev)
    ;;
esac

is_installed() {
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# as_root COMMAND...: sudo may ask for a password only where somebody can answer.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif [ -t 0 ]; then
    sudo "$@"
  else
    sudo -n "$@"
  fi
}

apt() {
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get -q -y -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3 "$@" </dev/null
}

[ "${MARROW_SETUP-}" != skip ] || exit 0
if ! command -v apt-get >/dev/null; then
  die "no apt here; install what these Debian packages hold: ${packages[*]}; then set MARROW_SETUP=skip"
fi

missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

by_hand="run as root: apt-get install ${missing[*]}"
[ "$(id -u)" -eq 0 ] || command -v sudo >/dev/null || die "packages are missing and sudo too; $by_hand"

say "installing ${missing[*]}"
log=$(mktemp "${TMPDIR:-/tmp}/marrow-setup.XXXXXX")
if ! { apt update || true; apt install --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
  grep -E '^(E|Err|sudo):' "$log" | tail -n 3 >&2 || true
  die "could not install all packages (words: $log); $by_hand"
fi
rm -f "$log"
