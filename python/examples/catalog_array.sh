#!/usr/bin/env bash
# The catalog of one size on a cluster with Slurm: task I of K does shard I of K.
#
#   NODES=12 OUT=/scratch/catalog-12 sbatch --array=1-64 catalog_array.sh
#   verify catalog merge /scratch/catalog-12
#
# A task that was killed or has run out of time goes on where it was when it is submitted again.
#SBATCH --job-name=viewcert-catalog
#SBATCH --array=1-4
#SBATCH --cpus-per-task=2
#SBATCH --time=04:00:00
#SBATCH --requeue
set -euo pipefail
export RAYON_NUM_THREADS=${SLURM_CPUS_PER_TASK:-2}
exec verify catalog --nodes "${NODES:?how many nodes}" --out "${OUT:?a folder for all tasks}" \
    --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT"
