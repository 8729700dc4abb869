#!/usr/bin/env bash
# A guard against slow code that needs no clock: the instructions of one small extraction on one
# thread, counted by callgrind, are within 5 % of what tests/golden/instructions.txt says for this
# compiler. A compiler that it does not name is told, and passes.
#
#   scripts/check_instructions.sh             compares
#   scripts/check_instructions.sh --update    records, after a change that is meant to change it

source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cd "$root"

golden=tests/golden/instructions.txt
percent=5
marrow=build/release/bin/marrow

# compiler: what the count depends on besides the sources, such as gcc-12-x86_64.
compiler() {
  local path version
  path=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' build/release/CMakeCache.txt)
  version=$("$path" -dumpversion)
  if "$path" --version | grep -q clang; then
    echo "clang-${version%%.*}-$(uname -m)"
  else
    echo "gcc-${version%%.*}-$(uname -m)"
  fi
}

# count: instructions of the extraction. Its kernels run on an instruction set that every machine of
# the kind has and valgrind knows, not on the best of this one.
count() {
  local simd=()
  [ "$(uname -m)" != x86_64 ] || simd=(--simd SSE4)
  "$marrow" make hand --resolution 0.5 -o "$work/hand.ply"
  quietly "$work/callgrind.log" valgrind --tool=callgrind --callgrind-out-file="$work/callgrind.out" \
    "$marrow" extract "$work/hand.ply" -o "$work/hand.skel" --image 256 --grid 128 --threads 1 \
    --quiet "${simd[@]}"
  sed -n 's/^totals: //p' "$work/callgrind.out"
}

command -v valgrind >/dev/null || die "valgrind is not here; scripts/setup.sh --dev installs it"
work=$(mktemp -d "${TMPDIR:-/tmp}/marrow-instructions.XXXXXX")
trap 'rm -rf "$work"' EXIT

build release marrow_program
key=$(compiler)
now=$(count)
[ -n "$now" ] || die "callgrind gave no count"

if [ "${1-}" = --update ]; then
  touch "$golden"
  { awk -v key="$key" '$1 != key' "$golden"; echo "$key $now"; } | LC_ALL=C sort >"$work/golden"
  cp "$work/golden" "$golden"
  echo "$key: $now instructions, recorded"
  exit 0
fi

recorded=$(awk -v key="$key" '$1 == key {print $2}' "$golden")
if [ -z "$recorded" ]; then
  echo "$key: $now instructions; no figure is recorded for this compiler, nothing was compared"
  exit 0
fi
change=$(awk -v now="$now" -v then="$recorded" 'BEGIN {printf "%+.1f", 100 * (now / then - 1)}')
echo "$key: $now instructions, $change % against the recorded $recorded"
awk -v change="$change" -v percent="$percent" \
  'BEGIN {exit !(change <= percent && change >= -percent)}' ||
  die "more than $percent % off; if it was meant to change: scripts/check_instructions.sh --update"
