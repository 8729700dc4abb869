#!/usr/bin/env bash
# The bytes of a skeleton do not depend on the number of threads, nor on the run. On six shapes, with
# fewer and more threads than cores:
#
#   scripts/check_threads.sh [PROGRAM [EXTRACT-OPTION...]]

source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

marrow=${1:-$root/build/release/bin/marrow}
options=("${@:2}")
work=$(mktemp -d "${TMPDIR:-/tmp}/marrow-threads.XXXXXX")
trap 'rm -rf "$work"' EXIT

# threads_of COMMAND...: runs it and prints the greatest number of threads it had.
threads_of() {
  local most=0 now
  "$@" &
  while now=$(awk '/^Threads:/ {print $2}' "/proc/$!/status" 2>/dev/null) && [ -n "$now" ]; do
    [ "$now" -le "$most" ] || most=$now
  done
  wait $!
  echo "$most"
}

most=0
for name in capsule torus trefoil star vessel-tree quadruped; do
  "$marrow" make "$name" -o "$work/shape.ply"
  for threads in 1 2 3 8 8; do
    used=$(threads_of "$marrow" extract "$work/shape.ply" -o "$work/$threads.skel" \
      --threads "$threads" --quiet "${options[@]}")
    [ "$used" -le "$threads" ] || die "$name: $used threads where at most $threads were allowed"
    [ "$used" -le "$most" ] || most=$used
    cmp "$work/1.skel" "$work/$threads.skel" || die "$name: 1 and $threads threads do not agree"
  done
  echo "$name: the same with 1, 2, 3, 8 and again 8 threads ($(wc -l <"$work/1.skel") lines)"
done

# Were all the runs on one thread, the test above would say nothing.
[ "$most" -ge 8 ] || die "no run had 8 threads, at most $most: nothing was tested"
echo "the widest run had $most threads"
