# shellcheck shell=bash
# What the scripts share; sourced, never run. Sets `root`, the folder of the project, and `jobs`.

set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck disable=SC2034  # for those who source this
jobs=$(nproc 2>/dev/null || echo 2)

# say WORDS...: one line of progress.
say() { printf '== %s\n' "$*"; }

# die WORDS...: one line on stderr, and the end.
die() {
  printf '%s: %s\n' "${0##*/}" "$*" >&2
  exit 1
}

# quietly LOG COMMAND...: runs the command; its words go to the file LOG and are shown if it fails.
quietly() {
  local log=$1
  shift
  mkdir -p "$(dirname "$log")"
  "$@" >"$log" 2>&1 </dev/null && return
  tail -n 40 "$log" >&2
  die "this failed: $* (all its words: $log)"
}

# build PRESET [TARGET...]: configures build/PRESET and builds all of it, or the targets.
build() {
  local preset=$1 targets=()
  shift
  [ $# -eq 0 ] || targets=(--target "$@")
  cd "$root"
  quietly "build/$preset.configure.log" cmake --preset "$preset"
  if [ -t 1 ]; then
    cmake --build --preset "$preset" "${targets[@]}"
  else
    quietly "build/$preset.build.log" cmake --build --preset "$preset" "${targets[@]}"
  fi
}
