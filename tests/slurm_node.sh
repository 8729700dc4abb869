# shellcheck shell=bash
# A Slurm of one node, on loopback, with a key and ports of its own; sourced, never run. The caller sets
# `work`, a new temporary folder that everything is in.
#
# No wait is without an end: clients of Slurm have `patience` seconds for an answer, `wait_for` takes its
# time as an argument, and what does not stop is killed.

slurm=${work:?}/slurm
patience=15
export SLURM_CONF=$slurm/slurm.conf

# wait_for SECONDS COMMAND...: until it succeeds; fails after that time.
wait_for() {
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    [ $SECONDS -lt $end ] || return 1
    sleep 0.1
  done
}

# ask COMMAND...: a client of Slurm, which waits for minutes where nobody answers.
ask() { timeout --foreground --kill-after=2 "$patience" "$@"; }

# free_port FROM: the first port from there on that nobody listens on.
free_port() {
  local port=$1
  while (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null; do port=$((port + 1)); done
  echo "$port"
}

write_slurm_conf() {
  local host user first
  host=$(hostname -s) user=$(id -un) first=$((20000 + RANDOM % 10000))
  cat >"$SLURM_CONF" <<EOF
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

node_is_idle() { [ "$(ask sinfo -h -o %T 2>/dev/null)" = idle ]; }

# start_slurm: fails where it does not start.
start_slurm() {
  mkdir -m 0700 "$slurm" "$slurm/state" "$slurm/spool"
  chmod 0711 "$slurm"
  (umask 077 && head -c 1024 /dev/urandom >"$slurm/munge.key")
  write_slurm_conf
  {
    ask munged --force --key-file="$slurm/munge.key" --socket="$slurm/munge.socket" \
      --pid-file="$slurm/munged.pid" --log-file="$slurm/munged.log" --seed-file="$slurm/munged.seed" &&
      ask slurmctld -f "$SLURM_CONF" && ask slurmd -f "$SLURM_CONF" -N "$(hostname -s)"
  } >"$slurm/words" 2>&1 </dev/null || return 1
  wait_for 20 node_is_idle
}

# slurm_words: the last ones of all daemons, in one line.
slurm_words() { tail -q -n 2 "$slurm"/*.log "$slurm/words" 2>/dev/null | tr '\n' ' '; }

# ours: the numbers of all processes of this Slurm and of what it has started, however they call
# themselves; they name the folder, or are in it. The caller itself must be elsewhere.
ours() {
  {
    find /proc/[0-9]* -maxdepth 1 -name cwd -lname "$work/*" 2>/dev/null | cut -d / -f 3
    pgrep -f -- "$work/"
  } | sort -u
}

nothing_runs() { [ -z "$(ours)" ]; }

# stop_slurm: in its own way; fails where something is left running.
stop_slurm() {
  cat "$slurm"/{slurmd,slurmctld,munged}.pid | xargs kill
  wait_for 10 nothing_runs
}

# kill_all: whatever is left, and the folder.
kill_all() {
  cd /
  local tries
  for tries in {1..50}; do
    nothing_runs && break
    ours | xargs -r kill -KILL 2>/dev/null || true
    sleep 0.1
  done
  rm -rf "$work"
  [ "$tries" -lt 50 ] || die "cannot be killed: $(ours | tr '\n' ' ')"
}
