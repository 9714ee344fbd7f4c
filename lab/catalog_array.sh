#!/usr/bin/env bash
# The catalog of one size on a cluster with Slurm. On a login node:
#
#   NODES=15 SHARDS=64 OUT=/scratch/catalog-15 bash catalog_array.sh
#
# submits three jobs: one makes the folder ready (the kernels are found once, and a folder of another run or
# split is refused before anything else), an array does the shards after it, and the last one merges when all of
# them are done. OUT is a folder that all nodes see. The table stands in OUT/merge.txt.
#
# What was killed, has run out of time or lost its node goes on where it was; part files that were damaged
# are computed again. Slurm requeues what a dead node had; all else is submitted again by the same command, or
# any subset of the shards with the same NODES, SHARDS, OPTIONS and OUT by
#
#   NODES=15 SHARDS=64 OUT=/scratch/catalog-15 sbatch --array=3,17-19 catalog_array.sh
#   NODES=15 SHARDS=64 OUT=/scratch/catalog-15 TASK=merge sbatch catalog_array.sh
#
# SHARDS  into how many shards the work is cut; the array's indices are among 1 to SHARDS, which is below
#         MaxArraySize of the cluster (scontrol show config), 1001 unless it is configured
# OPTIONS of `viewcert-lab catalog`; without any the finite-solvable graphs are counted, the fast way; for lines and
#         certificates of all graphs OPTIONS='--certificates'
# RECHECK how many graphs are decided again by the merge: 1% unless it is set, or all
# LAB     the program, if it is not in the PATH
# SBATCH  more options of sbatch, for all three jobs, as in '--partition=long --account=mine'
#
# Memory: see docs/catalog.md, On a cluster.
#SBATCH --job-name=viewcert-catalog
#SBATCH --cpus-per-task=1
#SBATCH --mem=500M
#SBATCH --time=04:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail
: "${NODES:?how many nodes}" "${OUT:?a folder for all tasks}" "${SHARDS:?into how many shards}"
options=${OPTIONS---necessary --verdicts}
lab=${LAB:-viewcert-lab}
threads=${SLURM_CPUS_PER_TASK:-1}

catalog() {
    # Options are words.
    # shellcheck disable=SC2086
    "$lab" catalog --nodes "$NODES" --out "$OUT" --threads "$threads" $options "$@"
}

case ${TASK:-${SLURM_ARRAY_TASK_ID:-submit}} in
prepare)
    catalog --shard "1/$SHARDS" --prepare
    ;;
merge)
    "$lab" catalog merge "$OUT" --recheck "${RECHECK:-1%}" --threads "$threads" | tee "$OUT/.merge.txt"
    mv "$OUT/.merge.txt" "$OUT/merge.txt"
    ;;
submit)
    most=$(scontrol show config | sed -n 's/^MaxArraySize *= *//p')
    if [ -n "$most" ] && [ "$SHARDS" -ge "$most" ]; then
        echo "SHARDS=$SHARDS: this cluster takes array indices below MaxArraySize=$most; fewer shards will do" >&2
        exit 2
    fi
    mkdir -p "$OUT"
    export NODES OUT SHARDS
    submit() {
        # shellcheck disable=SC2086
        sbatch --parsable --export=ALL --output="$OUT/slurm-%A-%a.log" ${SBATCH:-} "$@" "$0"
    }
    prepared=$(TASK=prepare submit)
    done=$(submit --dependency="afterok:$prepared" --kill-on-invalid-dep=yes --array="1-$SHARDS")
    merged=$(TASK=merge submit --dependency="afterok:$done" --kill-on-invalid-dep=yes)
    echo "submitted: prepare $prepared, shards $done, merge $merged; the table will stand in $OUT/merge.txt"
    ;;
*)
    catalog --shard "$SLURM_ARRAY_TASK_ID/$SHARDS"
    ;;
esac
