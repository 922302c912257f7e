#!/bin/sh
# SPDX-License-Identifier: 0BSD
# A study whose runs the ranks of one job share: sbatch ranks.sh STUDY.json RESULTS.json
#SBATCH --job-name=sphverify
#SBATCH --ntasks=4
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --signal=TERM@60
exec srun sphverify study "$1" -o "$2" --resume
