#!/usr/bin/env bash
# Builds everything and runs all tests; ends with their summary. Any words are for ctest:
#
#   scripts/test.sh                 all
#   scripts/test.sh -R topology     those whose name matches

source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

preset=${MARROW_PRESET:-release}
"$root/scripts/setup.sh"
say "building $preset (a few minutes the first time)"
build "$preset"
say "testing $preset"
ctest --preset "$preset" --parallel "$jobs" "$@"
