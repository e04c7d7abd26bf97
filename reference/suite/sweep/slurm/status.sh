#!/bin/sh
# What became of a job of Slurm, as Snakemake asks: one that was killed never says so itself. From
# the accounts; where Slurm keeps none (or not yet of this job), from the controller, which forgets
# a job some minutes after its end.
state=$(sacct --jobs "$1" --format=State --noheader --parsable2 2>/dev/null | head -n 1)
if [ -z "$state" ]; then
  said=$(scontrol --oneliner show job "$1" 2>&1)
  state=$(printf '%s\n' "$said" | sed -n 's/.* JobState=\([A-Z_]*\).*/\1/p')
  case "$said" in *"Invalid job id"*) state=FORGOTTEN ;; esac
fi
case "$state" in
  COMPLETED) echo success ;;
  "" | PENDING | RUNNING | CONFIGURING | COMPLETING | SUSPENDED | REQUEUED | RESIZING) echo running ;;
  *) echo failed ;;
esac
