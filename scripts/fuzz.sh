#!/usr/bin/env bash
# Runs the fuzz targets of tests/fuzz, as many at a time as there are cores:
#
#   scripts/fuzz.sh                                  all, 60 seconds each
#   scripts/fuzz.sh 3600 shape_ply ...               an hour each of these
#   scripts/fuzz.sh --runs 10000000 shape_ply ...    so many executions each
#
# What a target has learnt stays in build/fuzz/corpus, and the next run goes on from there. Says one
# line for each; fails when one has a finding, whose input is in build/fuzz/findings.

source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cd "$root"

flag=-max_total_time unit=seconds
if [ "${1-}" = --runs ]; then
  flag=-runs unit=executions
  shift
fi
count=${1:-60}
[[ $count =~ ^[1-9][0-9]*$ ]] || die "'$count' is no number of $unit"
if [ $# -gt 1 ]; then targets=("${@:2}"); else mapfile -t targets < <(ls tests/fuzz/inputs); fi
for target in "${targets[@]}"; do
  [ -d "tests/fuzz/inputs/$target" ] || die "no target '$target'; there are $(cd tests/fuzz/inputs && echo *)"
done

work=build/fuzz
findings=$work/findings
max_length=1000  # bytes of an input: room for a header and a few of everything behind it
# Of freed memory little need be kept when a run takes so little, and a finding is run again anyway.
export ASAN_OPTIONS=quarantine_size_mb=4:malloc_context_size=2

# The words that the reader of this target looks for, as a dictionary of libFuzzer.
make_dictionary() {
  local name=$1 sources=()
  case $name in
    skeleton_vtp | skeleton_graphml) sources=("skeleton/$name.cpp" skeleton/skeleton_xml.cpp) ;;
    skeleton_*) sources=("skeleton/$name.cpp") ;;
    shape_* | volume_*) sources=(engine/*"${name#*_}"*.cpp) ;;
    *) return 0 ;;  # bytes, no words
  esac
  # Longer ones, and those with blanks, are what is said to people.
  { grep -hv '^#include' "${sources[@]}" | grep -oE '"([^"\\ ]|\\[nrt"]){1,24}"' || true; } |
    sed 's/\\n/\\x0A/g; s/\\r/\\x0D/g; s/\\t/\\x09/g' | LC_ALL=C sort -u
}

# run TARGET: fuzzes it, and says in one line what came of it.
run() {
  local target=$1 corpus=$work/corpus/$1 log=$work/$1.log found words=()
  mkdir -p "$corpus"
  make_dictionary "$target" >"$work/$target.dict"
  [ ! -s "$work/$target.dict" ] || words=(-dict="$work/$target.dict")  # an empty one is refused
  # The shell's status is of no use: libFuzzer's tells of findings only, and these are files.
  "$work/bin/fuzz_$target" "$flag=$count" -max_len="$max_length" -timeout=20 \
    -rss_limit_mb=2048 -malloc_limit_mb=512 "${words[@]}" -print_final_stats=1 \
    -artifact_prefix="$findings/$target-" "$corpus" "tests/fuzz/inputs/$target" \
    >"$log" 2>&1 </dev/null || true
  found=$(find "$findings" -name "$target-*" -newer "$work/begin" | wc -l)
  awk -v target="$target" -v found="$found" '
    /stat::number_of_executed_units/ { runs = $2 }
    /stat::average_exec_per_sec/ { speed = $2 }
    { for (i = 1; i < NF; ++i) if ($i == "cov:") coverage = $(i + 1) }
    END {
      printf "%-18s %10d executions %7d /s %6d edges %3d findings\n",
        target, runs, speed, coverage, found
      exit runs == 0
    }' "$log" || die "$target did not run; its words: $log"
}

scripts/setup.sh --fuzz
say "building"
build fuzz "${targets[@]/#/fuzz_}"
mkdir -p "$findings"
touch "$work/begin"

say "${#targets[@]} targets, $count $unit each, $jobs at a time"
failures=0
for target in "${targets[@]}"; do
  if [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; then wait -n || failures=$((failures + 1)); fi
  run "$target" &
done
while [ "$(jobs -rp | wc -l)" -gt 0 ]; do wait -n || failures=$((failures + 1)); done
[ "$failures" -eq 0 ] || die "$failures targets did not run"

found=$(find "$findings" -type f -newer "$work/begin")
[ -n "$found" ] || exit 0
for file in $found; do
  name=${file##*/}
  say "a finding; to see it again: $work/bin/fuzz_${name%%-*} $file"
done
die "there are findings; mend them and keep their inputs in tests/fuzz/inputs"
