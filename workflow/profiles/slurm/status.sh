#!/usr/bin/env bash
# Prints running, success or failed for a Slurm job, as Snakemake asks. usage: status.sh JOBID
# The controller knows recent jobs, the accounting older ones, where there is one.
job=${1%%;*} # with several clusters sbatch says JOBID;CLUSTER
state=$(scontrol --oneliner show job "$job" 2>/dev/null | sed -n 's/.* JobState=\([A-Z_]*\).*/\1/p')
[[ -n $state ]] || state=$(sacct --noheader --parsable2 --allocations --format=State --jobs="$job" 2>/dev/null | head -n 1)

case $state in
  COMPLETED) echo success ;;
  BOOT_FAIL* | CANCELLED* | DEADLINE | FAILED | NODE_FAIL | OUT_OF_MEMORY | PREEMPTED | REVOKED | TIMEOUT) echo failed ;;
  *) echo running ;;
esac
