#!/usr/bin/env bash
# slurm_test.sh PROGRAM ROOT WORK: scripts/slurm on a Slurm cluster of two nodes on this machine. One
# node is lost half-way, a task goes back into the queue, a record is damaged, and the study has the
# bytes of one run. Needs root and the packages of [cluster]; without, 77. The cluster has a key, a
# socket and ports of its own and leaves nothing behind.
set -euo pipefail
program=$1 root=$2 work=$3
for tool in sbatch squeue scontrol slurmctld slurmd munged; do
  PATH=$PATH:/usr/sbin command -v "$tool" >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
[ "$(id -u)" -eq 0 ] || { echo "skipped: Slurm's daemons are started as root"; exit 77; }
PATH=$PATH:/usr/sbin
rm -rf "$work"
mkdir -p "$work"/{state,spool/n1,spool/n2,log,pids}
cd "$work"
host=$(hostname -s)
port=$((20000 + RANDOM % 10000))

fail() {
  echo "FAILED: $*"
  tail -n 20 "$work"/log/*.log "$work"/out/logs/*.log 2>/dev/null || true
  exit 1
}

stop_cluster() {
  local file
  # Else a job that still runs would outlive the cluster.
  if [ -f "$work/slurm.conf" ] && SLURM_CONF=$work/slurm.conf scancel --user=root 2>/dev/null; then
    sleep 2
  fi
  for file in "$work"/slurmd.n?.pid "$work"/slurmctld.pid "$work"/munged.pid; do
    [ ! -f "$file" ] || kill "$(<"$file")" 2>/dev/null || true
  done
  rm -f "$socket"
}
socket=$(mktemp -u /tmp/mapproof-munge-XXXXXX)
trap stop_cluster EXIT

start_cluster() {
  head -c 1024 /dev/urandom >munge.key
  chmod 400 munge.key
  munged --force --key-file="$work/munge.key" --socket="$socket" --pid-file="$work/munged.pid" \
    --log-file="$work/log/munged.log" --seed-file="$work/munged.seed"
  cat >slurm.conf <<END
ClusterName=one
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$socket,cred_expire=20
CredType=cred/munge
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool/%n
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.%n.pid
SlurmctldLogFile=$work/log/slurmctld.log
SlurmdLogFile=$work/log/%n.log
SlurmctldPort=$port
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SlurmdTimeout=10
InactiveLimit=0
MpiDefault=none
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1 RealMemory=500
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 RealMemory=500
PartitionName=all Nodes=n[1-2] Default=YES MaxTime=INFINITE State=UP
END
  export SLURM_CONF=$work/slurm.conf
  slurmctld -c
  slurmd -N n1
  slurmd -N n2
  for _ in $(seq 60); do
    [ "$(sinfo -h -N -o %T | grep -c idle)" -ne 2 ] || return 0
    sleep 1
  done
  fail "the cluster did not start"
}

# The program, which notes its process and Slurm's behind it, so that a lost node can take both along.
cat >mapproof <<END
#!/bin/bash
echo "\$\$ \$PPID \${SLURM_ARRAY_TASK_ID:-}" >"$work/pids/\${SLURMD_NODENAME:-none}"
[ -z "\${SLURM_RESTART_COUNT:-}" ] || echo "\${SLURM_ARRAY_TASK_ID:-}" >>"$work/restarted"
exec "$program" "\$@"
END
chmod +x mapproof
export MAPPROOF=$work/mapproof
experiment=("$root/tests/data/experiments/small.json")
more=(--layouts 600)

# Waits until a node works on a shard that has some records, but not all.
wait_for_shard() {
  local task records
  for _ in $(seq 1200); do
    if [ -f "pids/$1" ]; then
      task=$(cut -d ' ' -f 3 "pids/$1")
      records=$(find "out/shards/$task-of-4/runs" -name '*.json' 2>/dev/null | wc -l)
      if [ -n "$task" ] && [ "$records" -ge 5 ] && [ "$records" -lt 200 ]; then
        echo "$task"
        return
      fi
    fi
    sleep .05
  done
  return 1
}

expect_same() {
  diff -r --exclude=timings.jsonl --exclude=report.html --exclude=figures --exclude=tables \
    "$work/whole" "$work/out/study" >"$work/differences" ||
    fail "the study is not that of one run: $(head -n 5 "$work/differences")"
}

start_cluster
"$root/scripts/slurm" "${experiment[@]}" --tasks 4 --out out -- "${more[@]}" >slurm.log 2>&1 &
script=$!

lost=$(wait_for_shard n2) || fail "n2 got no shard"
read -r process step _ <pids/n2
kill -9 "$(<slurmd.n2.pid)" "$step" "$process"
rm slurmd.n2.pid
echo "lost n2 with shard $lost"

requeued=$(wait_for_shard n1) || fail "n1 got no shard"
array=$(cut -d , -f 1 out/logs/jobs)
scontrol requeue "${array}_$requeued"
echo "requeued shard $requeued"

wait "$script" || fail "scripts/slurm: $(<slurm.log)"
cat slurm.log
for shard in "$lost" "$requeued"; do
  grep -qx "$shard" restarted || fail "shard $shard was not started again"
done
"$program" run "${experiment[@]}" "${more[@]}" --out whole --quiet >/dev/null
expect_same
[ -f out/study/report.html ] || fail "no report"

# A damaged record: the same command runs that shard alone.
record=$(find out/shards/3-of-4/runs -name '*.json' -print -quit)
echo >>"$record"
"$root/scripts/slurm" "${experiment[@]}" --tasks 4 --out out -- "${more[@]}" >again.log 2>&1 ||
  fail "scripts/slurm again: $(<again.log)"
grep -q "submitted: shards 3 as job" again.log || fail "other shards were run: $(<again.log)"
expect_same

# A shard that fails: its name, no report, and an exit code.
rm -rf out/shards/2-of-4/runs out/study
touch out/shards/2-of-4/runs
code=0
"$root/scripts/slurm" "${experiment[@]}" --tasks 4 --out out -- "${more[@]}" >failed.log 2>&1 ||
  code=$?
[ $code -eq 1 ] || fail "a failed shard gave the exit code $code"
grep -q "of shard 2/4 are missing" failed.log || fail "the failed shard is not named"
[ ! -e out/study ] || fail "a study without a shard was written"
echo "passed"
