#!/bin/sh
# What became of a job of Slurm, as Snakemake asks: one that was killed never says so itself.
state=$(sacct --jobs "$1" --format=State --noheader --parsable2 | head -n 1)
case "$state" in
  COMPLETED) echo success ;;
  "" | PENDING | RUNNING | CONFIGURING | COMPLETING | SUSPENDED | REQUEUED | RESIZING) echo running ;;
  *) echo failed ;;
esac
