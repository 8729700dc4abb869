#!/usr/bin/env bash
# Runs the fuzz targets of tests/fuzz, as many at a time as there are cores:
#
#   scripts/fuzz.sh                       all, 60 seconds each
#   scripts/fuzz.sh 3600 shape_ply ...    an hour each of these
#
# What a target has learnt stays in build/fuzz/corpus, and the next run goes on from there. Says one
# line for each; fails when one has a finding, whose input is in build/fuzz/findings.

source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cd "$root"

seconds=${1:-60}
[[ $seconds =~ ^[1-9][0-9]*$ ]] || die "'$seconds' is no number of seconds"
if [ $# -gt 1 ]; then targets=("${@:2}"); else mapfile -t targets < <(ls tests/fuzz/inputs); fi
for target in "${targets[@]}"; do
  [ -d "tests/fuzz/inputs/$target" ] || die "no target '$target'; there are $(cd tests/fuzz/inputs && echo *)"
done

work=build/fuzz
findings=$work/findings
max_length=8000  # of an input; longer seeds count by their beginnings, which is where headers are

# Small shapes in every format, and what lies beside the project if anything does. $1: folder.
make_seeds() {
  local seeds=$1 marrow=build/release/bin/marrow extension
  mkdir -p "$seeds"
  for extension in obj ply stl off nrrd; do
    "$marrow" make capsule --resolution 0.5 -o "$seeds/capsule.$extension"
  done
  for extension in obj skel ply json cg graph swc polylines.txt vtp graphml csv; do
    "$marrow" make star -o "$seeds/star.ply" --truth "$seeds/star.skeleton.$extension"
  done
  find ../shared/badinputs ../shared/meshes -type f -size -100k -exec cp -t "$seeds" {} + \
    2>/dev/null || true
}

# The words in quotes of the tests of readers and writers, as a dictionary of libFuzzer.
make_dictionary() {
  grep -ohE '"([^"\\]|\\[nrt"])+"' tests/{shape,skeleton,volume}_*_test.cpp |
    sed 's/\\n/\\x0A/g; s/\\r/\\x0D/g; s/\\t/\\x09/g' | LC_ALL=C sort -u
}

# run TARGET: fuzzes it, and says in one line what came of it.
run() {
  local target=$1 corpus=$work/corpus/$1 log=$work/$1.log found
  local seeds=("tests/fuzz/inputs/$1")
  # Seeds are files of shapes and skeletons; the bytes of a soup are nothing of the kind.
  [[ $target = extract_* ]] || seeds+=("$work/seeds")
  mkdir -p "$corpus"
  # The shell's status is of no use: libFuzzer's tells of findings only, and these are files.
  "$work/bin/fuzz_$target" -max_total_time="$seconds" -max_len="$max_length" -timeout=20 \
    -rss_limit_mb=2048 -malloc_limit_mb=512 -dict="$work/words.dict" -print_final_stats=1 \
    -artifact_prefix="$findings/$target-" "$corpus" "${seeds[@]}" >"$log" 2>&1 </dev/null ||
    true
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
build release marrow_program
build fuzz "${targets[@]/#/fuzz_}"
mkdir -p "$findings"
make_seeds "$work/seeds"
make_dictionary >"$work/words.dict"
touch "$work/begin"

say "${#targets[@]} targets, $seconds s each, $jobs at a time"
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
