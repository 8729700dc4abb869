#!/usr/bin/env bash
# Batches by a real Slurm, which is thrown away at the end: tests/slurm_test.sh, never longer than three
# minutes. Where Slurm cannot be installed or does not start nothing is checked, and that is said.
#
#   scripts/check_slurm.sh [PROGRAM]
#
# Slurm runs as the caller, on loopback, with a key and ports of its own, in a temporary folder.

source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
limit=150   # seconds; then the test is told to end, and killed 20 seconds later

# skip WORDS...: the end, without a failure.
skip() {
  say "skipped: $*"
  exit 0
}

have_slurm() {
  local program
  for program in munged slurmctld slurmd sbatch pgrep; do
    PATH=$PATH:/usr/sbin:/sbin command -v "$program" >/dev/null || return 1
  done
}

if ! have_slurm; then
  say "installing Slurm"
  timeout 300 "$root/scripts/setup.sh" --slurm || skip "Slurm is not installed, and cannot be"
  have_slurm || skip "Slurm is not installed"
fi
[ $# -gt 0 ] || build release marrow_program
program=$(realpath "${1:-$root/build/release/bin/marrow}")

# In the background, so that this shell can hand signals on at once.
timeout --kill-after=20 "$limit" "$root/tests/slurm_test.sh" "$program" </dev/null &
test=$!
trap 'kill "$test"' INT TERM HUP
status=0
wait "$test" || status=$?
# A signal has ended the wait only.
[ $status -le 128 ] || wait "$test" || status=$?
case $status in
  0 | 77) ;;
  124 | 137) die "not done after $limit s" ;;
  *) die "failed with status $status" ;;
esac
