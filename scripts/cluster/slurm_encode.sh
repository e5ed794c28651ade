#!/bin/bash
# slurm_encode.sh PLAN [OPTION...]: hands the parts of a plan (tvg plan) to Slurm as an array of jobs, and behind it the
# job that joins them. Options are sbatch's: --partition=day --cpus-per-task=8 --time=2:00:00. Each part leaves a log
# beside the plan. Run it again after a failure: parts that are there and whole are passed over.
set -euo pipefail
[ $# -ge 1 ] || { sed -n '2,4s/^# //p' "$0" >&2; exit 1; }
plan=$(realpath "$1")
shift
parts=$( (grep -o '"last_frame"' "$plan" || true) | wc -l)
[ "$parts" -gt 0 ] || { echo "slurm_encode.sh: $plan is no plan of tvg plan" >&2; exit 1; }
logs=${plan%.json}
export TVG_PLAN=$plan

# --requeue: what a lost node leaves undone starts again elsewhere. A part appears under its name when it is whole.
array=$(sbatch --parsable --job-name=tvg-part --array="1-$parts" --requeue --export=ALL \
  --output="${logs//%/%%}.part-%a.log" "$@" <<'JOB'
#!/bin/bash
tvg encode --plan "$TVG_PLAN" --part "$SLURM_ARRAY_TASK_ID" --threads "${SLURM_CPUS_PER_TASK:-1}"
status=$?
# What is killed from outside says nothing itself.
[ $status -lt 128 ] || echo "part $SLURM_ARRAY_TASK_ID of $TVG_PLAN was killed by signal $((status - 128))"
exit $status
JOB
)
join=$(sbatch --parsable --job-name=tvg-join --dependency="afterok:$array" --kill-on-invalid-dep=yes --export=ALL \
  --output="${logs//%/%%}.join.log" "$@" <<'JOB'
#!/bin/bash
exec tvg join --plan "$TVG_PLAN"
JOB
)
echo "$parts parts: jobs ${array}_1 to ${array}_$parts; joined by job $join. Logs: $logs.part-N.log, $logs.join.log"
