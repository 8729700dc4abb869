#!/usr/bin/env bash
# A corpus of 500 shapes, good and bad ones, through a real Slurm of one node that is thrown away at the
# end: a worker is killed and a task requeued in the middle; rows and skeletons must be those of one
# undisturbed run, and nothing may be left running. scripts/check_slurm.sh installs what it needs and
# bounds its time.
#
#   tests/slurm_test.sh MARROW
#
# Ends with 77 where Slurm does not start.

source "$(dirname "${BASH_SOURCE[0]}")/../scripts/lib.sh"
export PATH=$PATH:/usr/sbin:/sbin
marrow=$(realpath "$1")
work=$(mktemp -d "${TMPDIR:-/tmp}/marrow-slurm.XXXXXX")
source "$root/tests/slurm_node.sh"
trap kill_all EXIT
trap 'die "ended from outside after $SECONDS s, at: $step; $(slurm_words)"' INT TERM
cd /

tasks=4
options=(--timeout 60 --format "skel,json" --refine hull)

# begin WORDS...: the next step.
begin() {
  step=$*
  say "$step"
}

# --- the corpus -----------------------------------------------------------------------------------

# Each shape in two formats.
# shellcheck disable=SC2016  # the words of another shell
make_shapes() {
  local names name
  names=$("$marrow" make --list | cut -d ' ' -f 1)
  for name in $names; do
    printf '%s\n' "$name 0.5 obj" "$name 0.6 ply"
  done | xargs -P "$jobs" -L 1 bash -c '"$0" make "$1" -o "$1-$2.$3" --resolution "$2"' "$marrow"
}

# Cut short within a word, empty, nonsense, not finite.
make_bad_shapes() {
  local i=0 shape
  for shape in ./*; do
    { head -c $((100 + 37 * i)) "$shape" && echo '?'; } >"bad-cut-$i.${shape##*.}"
    i=$((i + 1))
    [ $i -lt 40 ] || break
  done
  for i in 1 2 3 4; do
    : >"bad-empty-$i.ply"
    head -c $((1000 * i)) "$marrow" >"bad-nonsense-$i.stl"
    printf 'v 0 0 0\nv 1 nan %d\nv 0 1 0\nf 1 2 3\n' $i >"bad-nan-$i.obj"
  done
}

# The first shapes of the tasks 0 and 1 take long enough to be disturbed.
slow_shapes() {
  local line
  for line in {0..15}; do
    if [ $((line % tasks)) -lt 2 ]; then
      echo "{\"path\": \"./vessel-tree-0.5.obj\", \"id\": \"slow-$line\", \"image\": 1024, \"grid\": 256}"
    else
      echo "{\"path\": \"./torus-0.5.obj\", \"id\": \"again-$line\", \"image\": 64, \"min_part\": 5}"
    fi
  done
}

# manifest_of PATH...: each in eight ways.
manifest_of() {
  local path image grid
  for image in 64 72 80 96; do
    for grid in 24 32; do
      for path in "$@"; do
        echo "{\"path\": \"$path\", \"id\": \"${path#./}-$image-$grid\", \"image\": $image, \"grid\": $grid}"
      done
    done
  done
}

# Real shapes, where they are at hand.
real_shapes() {
  [ ! -d "$root/../shared/meshes" ] || find "$(realpath "$root/../shared/meshes")" -size -200k \
    \( -name '*.obj' -o -name '*.ply' -o -name '*.off' -o -name '*.stl' \) | sort |
    sed 's/.*/{"path": "&", "image": 64, "grid": 24}/'
}

make_corpus() {
  mkdir "$work/shapes"
  cd "$work/shapes"
  make_shapes
  local good=(./*)
  make_bad_shapes
  {
    slow_shapes
    manifest_of "${good[@]}"
    printf '%s\n' ./bad-*
    echo ./bad-missing.obj
    real_shapes
  } >"$work/manifest"
  cd /
}

# --- trouble --------------------------------------------------------------------------------------

# has_rows TASK NUMBER
has_rows() {
  local file=$work/array/results-$1-of-$tasks.jsonl
  [ -f "$file" ] && [ "$(wc -l <"$file")" -ge "$2" ]
}

# The processes of this check's batches: the batches and their workers.
batch_processes() { pgrep -f -- "--manifest $work/manifest"; }

# kill_a_worker: one whose parent is a batch too.
kill_a_worker() {
  local pid parent
  for pid in $(batch_processes); do
    parent=$(ps -o ppid= -p "$pid" | tr -d ' ') || continue
    grep -qx "$parent" <(batch_processes) || continue
    kill -KILL "$pid" 2>/dev/null && return
  done
  return 1
}

# No answer is not an empty queue.
queue_is_empty() {
  local jobs_left
  jobs_left=$(ask squeue -h 2>/dev/null) && [ -z "$jobs_left" ]
}

# stuck WORDS...: the end, with what Slurm says.
stuck() { die "$*; the queue: $(ask squeue -h 2>&1 | tr '\n' ';'); $(slurm_words)"; }

# --- the check ------------------------------------------------------------------------------------

begin "a corpus"
make_corpus
count=$(wc -l <"$work/manifest")

begin "$count shapes without Slurm"
status=0
(cd "$work/shapes" && exec "$marrow" batch --manifest "$work/manifest" -o "$work/alone" "${options[@]}") \
  2>"$work/words" || status=$?
[ $status -eq 9 ] || die "exit status $status instead of 9: $(cat "$work/words")"
cat "$work/words"
"$marrow" merge "$work/alone" -o "$work/alone.jsonl"

begin "a Slurm of one node"
if ! start_slurm; then
  say "skipped: Slurm does not start here: $(slurm_words)"
  exit 77
fi

begin "the same by $tasks tasks"
numbers=$(cd "$work/shapes" && MARROW=$marrow ask "$root/scripts/slurm/marrow-array.sh" \
  "$work/manifest" "$tasks" "$work/array" "${options[@]}") || stuck "no jobs come of it"
read -r array merge <<<"$numbers"
wait_for 30 kill_a_worker || stuck "no worker to kill"
begin "a worker has been killed"
wait_for 30 has_rows 1 1 || stuck "task 1 does not begin"
ask scontrol requeue "${array}_1" || stuck "task 1 cannot be requeued"
begin "task 1 has been requeued"
wait_for 90 queue_is_empty || stuck "the jobs $array and $merge do not end"

begin "what there is"
grep -q 'before: done [1-9]' "$work/array/log/1" ||
  die "task 1 did not go on where it was: $(cat "$work/array/log/1")"
[ -z "$(find "$work/array" -name '.*')" ] || die "drafts are left: $(find "$work/array" -name '.*')"
[ "$(wc -l <"$work/array/results.jsonl")" -eq "$count" ] || die "not $count rows"
[ "$(cut -d '"' -f 4 "$work/array/results.jsonl" | sort -u | wc -l)" -eq "$count" ] || die "an id twice"
diff "$work/alone.jsonl" "$work/array/results.jsonl" >"$work/words" ||
  die "the rows are not those of one process: $(head -c 2000 "$work/words")"
diff -r "$work/alone/skeletons" "$work/array/skeletons" || die "the skeletons are not those of one process"
grep -q '</html>' "$work/array/report.html" || die "no report"

begin "what is left"
stop_slurm || die "left running: $(ours | xargs ps -o pid=,args= -p)"
say "$count shapes, each with one row, the same bytes by Slurm and without, after $SECONDS s"
