#!/usr/bin/env bash
# Many files of graphs on a cluster with Slurm. On a login node:
#
#   FILES=list.txt TASKS=64 OUT=/scratch/verdicts bash verify_array.sh
#
# FILES   a text with the path of a file on each line, which all nodes see
# TASKS   into how many tasks the work is cut: task k decides every TASKS-th file from the k-th on
# OUT     a folder for the answers, lines of JSON in OUT/part-k.jsonl; what cannot be read is named in the task's log
# OPTIONS of `verify`, as in '--model calibrated'
# VERIFY  the program, if it is not in the PATH
# SBATCH  more options of sbatch, as in '--partition=long'
#
# A part is whole or not there. Submit tasks that were lost again:
#
#   FILES=list.txt TASKS=64 OUT=/scratch/verdicts sbatch --array=3,17-19 verify_array.sh
#
#SBATCH --job-name=viewcert
#SBATCH --cpus-per-task=1
#SBATCH --time=04:00:00
#SBATCH --requeue
set -euo pipefail
: "${FILES:?a list of files}" "${TASKS:?into how many tasks}" "${OUT:?a folder for all tasks}"
if [ -z "${SLURM_ARRAY_TASK_ID:-}" ]; then
    mkdir -p "$OUT"
    export FILES TASKS OUT
    # shellcheck disable=SC2086
    exec sbatch --export=ALL --array="1-$TASKS" --output="$OUT/slurm-%A-%a.log" ${SBATCH:-} "$0"
fi
part=$OUT/part-$SLURM_ARRAY_TASK_ID.jsonl
# Exit code 123: of some graph the answer is no, or it cannot be read, which the log says.
# shellcheck disable=SC2086
awk -v k="$SLURM_ARRAY_TASK_ID" -v n="$TASKS" 'NR % n == k % n' "$FILES" |
    RAYON_NUM_THREADS=${SLURM_CPUS_PER_TASK:-1} xargs -r -d '\n' "${VERIFY:-verify}" --json ${OPTIONS:-} >"$part.new" || [ $? = 123 ]
mv "$part.new" "$part"
