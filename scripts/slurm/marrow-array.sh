#!/usr/bin/env bash
# marrow batch over a manifest as an array of Slurm tasks, and marrow merge when all have ended:
#
#   scripts/slurm/marrow-array.sh MANIFEST TASKS DIR [BATCH-OPTION...]
#
# Prints the number of the array job and that of the merge. DIR must be seen by all nodes; results are
# DIR/results.jsonl and DIR/report.html, the words of the tasks in DIR/log. Give each task at least ten
# minutes of work: see docs/scale.md. Called again with the same words it does what is missing.
#
# MARROW is the program (marrow), MARROW_CPUS the cores of a task (1); what else sbatch is to know
# goes into its own variables: SBATCH_PARTITION, SBATCH_ACCOUNT, SBATCH_TIMELIMIT and so on.

set -euo pipefail

die() {
  printf '%s: %s\n' "${0##*/}" "$*" >&2
  exit 2
}

[ $# -ge 3 ] || die "usage: marrow-array.sh MANIFEST TASKS DIR [BATCH-OPTION...]"
manifest=$1 tasks=$2 dir=$3
shift 3
[[ "$tasks" =~ ^[1-9][0-9]*$ ]] || die "$tasks is no number of tasks"
[ -r "$manifest" ] || die "$manifest cannot be read"
marrow=$(command -v "${MARROW:-marrow}") || die "there is no ${MARROW:-marrow}; say MARROW=/path/to/marrow"
marrow=$(realpath "$marrow")
mkdir -p "$dir/log"

# words WORD...: quoted for the scripts below.
words() { printf '%q ' "$@"; }

# The number of tasks is that of the first time, not SLURM_ARRAY_TASK_COUNT: some of them can be
# submitted again alone. A task that was requeued goes on where it was. Shapes that fail are rows,
# not failures of the task; at the end of its time Slurm tells all its processes, so the shell only
# waits for the batch to end.
array=$(sbatch --parsable --job-name=marrow --array="0-$((tasks - 1))" --requeue --open-mode=append \
  --cpus-per-task="${MARROW_CPUS:-1}" --output="$dir/log/%a" <<EOF
#!/usr/bin/env bash
trap : TERM
$(words "$marrow" batch --manifest "$manifest" -o "$dir" --resume "$@") \\
  --jobs "\${SLURM_CPUS_PER_TASK:-1}" --shard "\$SLURM_ARRAY_TASK_ID/$tasks"
status=\$?
[ \$status -ne 9 ] || exit 0
exit \$status
EOF
)

merge=$(sbatch --parsable --job-name=marrow-merge --dependency="afterany:${array%%;*}" \
  --output="$dir/log/merge" <<EOF
#!/usr/bin/env bash
exec $(words "$marrow" merge "$dir" -o "$dir/results.jsonl" -o "$dir/report.html")
EOF
)
echo "${array%%;*} ${merge%%;*}"
