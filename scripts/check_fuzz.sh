#!/usr/bin/env bash
# A minute of every fuzz target of tests/fuzz, as many at a time as there are cores: scripts/fuzz.sh.
# Where clang's fuzzer is not installed and cannot be, nothing is checked, and that is said.

source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cd "$root"

# skip WORDS...: the end, without a failure.
skip() {
  say "skipped: $*"
  exit 0
}

have_fuzzer() {
  local program=build/fuzz.probe
  mkdir -p build
  # Like a real target: clang may be there without its runtimes.
  clang++ -fsanitize=fuzzer,address,undefined -x c++ -o "$program" - >"$program.log" 2>&1 <<'END' || return 1
extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }
END
  "$program" -runs=1 >"$program.log" 2>&1
}

if ! have_fuzzer; then
  say "installing clang"
  timeout 300 scripts/setup.sh --fuzz || skip "clang is not installed, and cannot be"
  have_fuzzer || skip "clang++ makes no fuzzer that runs here; its words: build/fuzz.probe.log"
fi
MARROW_SETUP=skip scripts/fuzz.sh 60
