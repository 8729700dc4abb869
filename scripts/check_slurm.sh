#!/usr/bin/env bash
# A corpus of 500 shapes, good and bad ones, through a real Slurm of one node that is thrown away at the
# end: a worker is killed and a task requeued in the middle; rows and skeletons must be those of one
# undisturbed run.
#
#   scripts/check_slurm.sh [PROGRAM]
#
# Slurm runs as the caller, on loopback, with a key and ports of its own, in a temporary folder. Where
# it cannot be installed nothing is checked, and that is said.

source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

# skip WORDS...: the end, without a failure.
skip() {
  say "skipped: $*"
  exit 0
}

have_slurm() {
  export PATH=$PATH:/usr/sbin:/sbin
  command -v munged && command -v slurmctld && command -v slurmd && command -v sbatch
} >/dev/null

have_slurm || "$root/scripts/setup.sh" --slurm >/dev/null 2>&1 || skip "Slurm is not installed, and cannot be"
have_slurm || skip "Slurm is not installed"
if [ $# -eq 0 ]; then
  build release marrow_program
fi
marrow=$(realpath "${1:-$root/build/release/bin/marrow}")

work=$(mktemp -d "${TMPDIR:-/tmp}/marrow-slurm.XXXXXX")
slurm=$work/slurm
shapes=448 tasks=4
options=(--image 64 --grid 24 --timeout 60 --format "skel,json")

# --- a Slurm of one node --------------------------------------------------------------------------

# free_port FROM: the first port from there on that nobody listens on.
free_port() {
  local port=$1
  while (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null; do port=$((port + 1)); done
  echo "$port"
}

write_slurm_conf() {
  local host user first
  host=$(hostname -s) user=$(id -un) first=$((20000 + RANDOM % 10000))
  cat >"$slurm/slurm.conf" <<EOF
ClusterName=marrow
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$(free_port $first)
SlurmdPort=$(free_port $((first + 500)))
SlurmUser=$user
SlurmdUser=$user
# A requeued job waits as long as a credential lives.
AuthInfo=socket=$slurm/munge.socket,cred_expire=5
SlurmctldPidFile=$slurm/slurmctld.pid
SlurmdPidFile=$slurm/slurmd.pid
SlurmctldLogFile=$slurm/slurmctld.log
SlurmdLogFile=$slurm/slurmd.log
StateSaveLocation=$slurm/state
SlurmdSpoolDir=$slurm/spool
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0,sched_interval=1
ReturnToService=2
KillWait=5
MinJobAge=300
SlurmdParameters=config_overrides
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 RealMemory=1000 State=UNKNOWN
PartitionName=main Nodes=$host Default=YES MaxTime=INFINITE State=UP
EOF
}

start_slurm() {
  mkdir -m 0700 "$slurm" "$slurm/state" "$slurm/spool"
  chmod 0711 "$slurm"
  (umask 077 && head -c 1024 /dev/urandom >"$slurm/munge.key")
  write_slurm_conf
  munged --force --key-file="$slurm/munge.key" --socket="$slurm/munge.socket" \
    --pid-file="$slurm/munged.pid" --log-file="$slurm/munged.log" --seed-file="$slurm/munged.seed" \
    >"$slurm/words" 2>&1 || return 1
  export SLURM_CONF=$slurm/slurm.conf
  slurmctld -f "$SLURM_CONF" >>"$slurm/words" 2>&1 || return 1
  slurmd -f "$SLURM_CONF" -N "$(hostname -s)" >>"$slurm/words" 2>&1 || return 1
  wait_for 20 node_is_idle
}

node_is_idle() { [ "$(sinfo -h -o %T 2>/dev/null)" = idle ]; }

# wait_for SECONDS COMMAND...: until it succeeds; fails after that time.
wait_for() {
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    [ $SECONDS -lt $end ] || return 1
    sleep 0.1
  done
}

# The daemons by the numbers that they have written down.
daemons() {
  local name
  for name in slurmd slurmctld munged; do
    [ ! -f "$slurm/$name.pid" ] || cat "$slurm/$name.pid"
  done
}

are_gone() {
  local pid
  for pid in "$@"; do
    ! kill -0 "$pid" 2>/dev/null || return 1
  done
}

stop_slurm() {
  local pids
  mapfile -t pids < <(daemons)
  [ ${#pids[@]} -gt 0 ] || return 0
  scancel --quiet --user="$(id -un)" 2>/dev/null || true
  kill "${pids[@]}" 2>/dev/null || true
  wait_for 10 are_gone "${pids[@]}" || kill -KILL "${pids[@]}" 2>/dev/null || true
}

trap 'stop_slurm; rm -rf "$work"' EXIT

# --- the corpus -----------------------------------------------------------------------------------

# shellcheck disable=SC2016  # the words of another shell
make_shapes() {
  local names resolution format
  names=$("$marrow" make --list | cut -d ' ' -f 1)
  for resolution in 0.5 0.6 0.7 0.8; do
    for format in obj ply stl off; do
      for name in $names; do
        echo "$name $resolution $format"
      done
    done
  done | head -n "$shapes" |
    xargs -P "$jobs" -L 1 bash -c '"$0" make "$1" -o "$1-$2.$3" --resolution "$2"' "$marrow"
}

# Cut short, empty, nonsense, not finite, not there.
make_bad_shapes() {
  local i=0 shape
  for shape in [a-h]*-0.5.*; do
    head -c $((100 + 37 * i)) "$shape" >"bad-cut-$i.${shape##*.}"
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
      echo "{\"path\": \"./torus-0.5.obj\", \"id\": \"again-$line\", \"min_part\": 5}"
    fi
  done
}

make_corpus() {
  mkdir "$work/shapes"
  cd "$work/shapes"
  make_shapes
  make_bad_shapes
  {
    slow_shapes
    find . -type f | sort
    echo ./bad-missing.obj
    # Real shapes, where they are at hand.
    [ ! -d "$root/../shared/meshes" ] || find "$root/../shared/meshes" -size -200k \
      \( -name '*.obj' -o -name '*.ply' -o -name '*.off' -o -name '*.stl' \) | sort
  } >"$work/manifest"
}

# --- trouble --------------------------------------------------------------------------------------

# has_rows TASK NUMBER
has_rows() {
  local file=$work/array/results-$1-of-$tasks.jsonl
  [ -f "$file" ] && [ "$(wc -l <"$file")" -ge "$2" ]
}

# The processes of this check's batches: the batches and their workers.
batch_processes() { pgrep -f -- "--manifest $work/manifest" || true; }

# kill_a_worker: one whose parent is a batch too.
kill_a_worker() {
  local pid parent
  for pid in $(batch_processes); do
    parent=$(ps -o ppid= -p "$pid" | tr -d ' ') || continue
    grep -qx "$parent" <(batch_processes) || continue
    # The batch itself is a child of the shell of its task.
    grep -qE '^ *[0-9]+ +marrow' <(ps -o pid=,comm= -p "$parent") || continue
    kill -KILL "$pid" 2>/dev/null && return
  done
  return 1
}

queue_is_empty() { [ -z "$(squeue -h 2>/dev/null)" ]; }
no_batch_runs() { [ -z "$(batch_processes)" ]; }

# --- the check ------------------------------------------------------------------------------------

say "a corpus"
make_corpus
count=$(wc -l <"$work/manifest")
cd "$work/shapes"

say "$count shapes without Slurm"
status=0
"$marrow" batch --manifest "$work/manifest" -o "$work/alone" "${options[@]}" 2>"$work/words" || status=$?
[ $status -eq 9 ] || die "exit status $status instead of 9: $(cat "$work/words")"
cat "$work/words"
"$marrow" merge "$work/alone" -o "$work/alone.jsonl"

say "a Slurm of one node"
start_slurm || skip "Slurm does not start here: $(tail -n 1 "$slurm"/*.log "$slurm/words" | tr '\n' ' ')"

say "the same by $tasks tasks"
read -r array merge < <(MARROW=$marrow "$root/scripts/slurm/marrow-array.sh" "$work/manifest" "$tasks" \
  "$work/array" "${options[@]}")
wait_for 60 kill_a_worker || die "no worker to kill: $(squeue; tail -n 3 "$slurm"/*.log)"
say "a worker has been killed"
wait_for 60 has_rows 1 1 || die "task 1 does not begin"
scontrol requeue "${array}_1"
say "task 1 has been requeued"
if ! wait_for 90 queue_is_empty; then
  squeue
  die "the jobs $array and $merge do not end: $(tail -n 3 "$slurm"/*.log)"
fi
grep -q 'before: done [1-9]' "$work/array/log/1" ||
  die "task 1 did not go on where it was: $(cat "$work/array/log/1")"

say "what there is"
wait_for 5 no_batch_runs || die "processes are left: $(batch_processes)"
[ -z "$(find "$work/array" -name '.*')" ] || die "drafts are left: $(find "$work/array" -name '.*')"
[ "$(wc -l <"$work/array/results.jsonl")" -eq "$count" ] || die "not $count rows"
[ "$(cut -d '"' -f 4 "$work/array/results.jsonl" | sort -u | wc -l)" -eq "$count" ] || die "an id twice"
diff "$work/alone.jsonl" "$work/array/results.jsonl" >"$work/words" ||
  die "the rows are not those of one process: $(head -c 2000 "$work/words")"
diff -r "$work/alone/skeletons" "$work/array/skeletons" || die "the skeletons are not those of one process"
grep -q '</html>' "$work/array/report.html" || die "no report"

mapfile -t pids < <(daemons)
stop_slurm
are_gone "${pids[@]}" || die "daemons are left: ${pids[*]}"
say "$count shapes, each with one row, the same bytes by Slurm and without, after $SECONDS s"
