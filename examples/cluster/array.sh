#!/bin/sh
# SPDX-License-Identifier: 0BSD
# A study as a job array of Slurm: sbatch array.sh STUDY.json FOLDER; then sphverify merge FOLDER/part-*.json -o results.json
#SBATCH --job-name=sphverify
#SBATCH --array=1-4
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --signal=B:TERM@60
parts=4  # as many as there are tasks: one of them may be submitted again by itself, --array=2
exec sphverify study "$1" --part "$SLURM_ARRAY_TASK_ID/$parts" -o "$2/part-$SLURM_ARRAY_TASK_ID.json" --resume
