#!/usr/bin/env bash
# Runs docs/clusters.md on this machine: a job array over the parts of a run by slurmctld and slurmd (Debian: slurm-wlm),
# one task of which is requeued in the middle, and the merge after it. The readings must be those of one run.
#
#   tests/slurm/array.sh PROGRAM SCENE.toml
#
# Needs a running slurmctld with a node, and root or an account that may requeue its own jobs.
set -euo pipefail
program=$(realpath "$1") scene=$(realpath "$2")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
paths=2e5
cat > hall.sh <<END
#!/bin/sh
#SBATCH --array=1-4
#SBATCH --requeue
#SBATCH --output=part%a.log
#SBATCH --open-mode=append
exec "$program" measure "$scene" --method path --paths $paths --part "\$SLURM_ARRAY_TASK_ID/4" \\
    --state "part\$SLURM_ARRAY_TASK_ID.run" --state-every 0.5 --threads 1
END
cat > merge.sh <<END
#!/bin/sh
#SBATCH --output=merge.log
exec "$program" merge part*.run -o merged.json --replicates
END
job=$(sbatch --parsable hall.sh)
merge=$(sbatch --parsable --dependency="afterok:$job" merge.sh)
until [[ -e part1.run ]]; do sleep 0.2; done
scontrol requeue "${job}_1"
"$program" measure "$scene" --method path --paths $paths -o whole.json --replicates --quiet > /dev/null
for _ in $(seq 1200); do
    [[ -z $(squeue --noheader --jobs "$job,$merge" 2>/dev/null) ]] && break
    sleep 1
done
cat part1.log merge.log
diff <(grep -v elapsed_s whole.json) <(grep -v elapsed_s merged.json)
echo "the array has the bits of one run; task 1 was requeued"
