#!/bin/sh
# A study as a job array of Slurm: sbatch array.sh STUDY.json FOLDER; then sphverify merge FOLDER/part-*.json -o results.json
#SBATCH --job-name=sphverify
#SBATCH --array=1-4
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --signal=B:TERM@60
part=$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT
exec sphverify study "$1" --part "$part" -o "$2/part-$SLURM_ARRAY_TASK_ID.json" --resume
