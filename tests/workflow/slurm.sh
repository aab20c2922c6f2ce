#!/usr/bin/env bash
# Install Slurm, start it on loopback, run a small study through it, kill one of its jobs, and compare with a local run.
#
#   make slurm && sudo PYTHON=.venv/bin/python tests/workflow/slurm.sh [number of records, default 8]
#
# For Debian and Ubuntu, as root, on a machine without a Slurm of its own. Not a part of `make test`.
# Every daemon it starts is stopped by its process id.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
python=${PYTHON:-$root/.venv/bin/python}
[[ $python == /* ]] || python=$PWD/$python
records=${1:-8}
work=$(mktemp -d /tmp/rocking_slurm.XXXXXX)
configuration=/etc/slurm/slurm.conf  # nowhere else: the executor takes SLURM_CONF out of the environment
pids=()

stop() {
    status=$?
    for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
    for pid in "${pids[@]}"; do wait "$pid" 2>/dev/null || true; done
    if grep -q "$work" "$configuration" 2>/dev/null; then rm -f "$configuration"; fi
    if [[ $status == 0 ]]; then rm -rf "$work"; else echo "failed; logs are in $work"; fi
    exit "$status"
}
trap stop EXIT

[[ $(id -u) == 0 ]] || { echo "slurm.sh installs packages and starts daemons: run it as root."; exit 1; }
"$python" -c "import snakemake_executor_plugin_slurm" || { echo "type make slurm first."; exit 1; }
[[ ! -e $configuration ]] || { echo "$configuration exists: this machine has a Slurm of its own."; exit 1; }

echo "== install"
export DEBIAN_FRONTEND=noninteractive
apt-get update -qq
apt-get install -qq -y --no-install-recommends slurmctld slurmd slurm-client munge > "$work/apt.log"

echo "== start"
mkdir -p /etc/slurm /run/munge "$work/state" "$work/spool"
chown munge: /run/munge
cat > "$configuration" << CONFIGURATION
# Made by tests/workflow/slurm.sh in $work; safe to delete.
ClusterName=rocking
SlurmctldHost=$(hostname -s)(127.0.0.1)
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
SlurmUser=root
AuthType=auth/munge
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
SelectType=select/cons_tres
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ReturnToService=2
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=$(free -m | awk '/^Mem/ {print int($2 * 0.9)}')
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONFIGURATION
runuser -u munge -- /usr/sbin/munged --foreground > "$work/munged.log" 2>&1 & pids+=($!)
sleep 1
/usr/sbin/slurmctld -D > "$work/slurmctld.out" 2>&1 & pids+=($!)
/usr/sbin/slurmd -D > "$work/slurmd.out" 2>&1 & pids+=($!)
for _ in $(seq 60); do
    if sinfo --noheader --format %T 2> /dev/null | grep -q idle; then break; fi
    sleep 1
done
sinfo | grep idle

echo "== a study of $records records"
(cd "$root" && "$python" -m tests.workflow.write_study "$work/local" "$records")
cp -r "$work/local" "$work/slurm"
run() {  # folder, profile, further options
    "$python" -m snakemake --snakefile "$root/Snakefile" --directory "$work/$1" --configfile "$work/$1/config.yaml" \
        --workflow-profile "$root/workflow/profiles/$2" "${@:3}" > "$work/$1.log" 2>&1
}

started=$(date +%s.%N)
run local default
local_time=$(awk "BEGIN {print $(date +%s.%N) - $started}")

started=$(date +%s.%N)
run slurm slurm & main=$!
for _ in $(seq 600); do
    victim=$(squeue --noheader --states RUNNING --format %i 2> /dev/null | head -1)
    [[ -z $victim ]] || break
    sleep 0.2
done
[[ -n $victim ]] || { echo "no job ran within two minutes"; exit 1; }
scancel --signal KILL --full "$victim"
echo "killed job $victim of Slurm"
wait "$main" || { tail -50 "$work/slurm.log"; exit 1; }
slurm_time=$(awk "BEGIN {print $(date +%s.%N) - $started}")
grep -q "Trying to restart job" "$work/slurm.log" || { echo "the killed job was not noticed"; exit 1; }

echo "== compare"
# timings.csv holds durations, and the logs and .kept say when: everything else must be equal byte for byte
diff -r --brief --exclude timings.csv --exclude logs --exclude .kept --exclude SHA256SUMS "$work/local/results" "$work/slurm/results"
run slurm slurm results
grep -q "Nothing to be done" "$work/slurm.log"
echo "equal byte for byte; local $local_time s, Slurm $slurm_time s with one job killed and submitted again"
