#!/usr/bin/env bash
# Renews tests/golden after a change that is meant to change results. Look at the difference before
# you commit it: the stages above the first one that you changed must not be in it.

source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

build release bits
"$root/build/release/bin/bits" >"$root/tests/golden/bits.txt"
git -C "$root" diff --stat -- tests/golden
