#!/usr/bin/env bash
# The script of the catalog on a real Slurm: two nodes of one core each, both on this machine.
#
#   lab/tests/slurm.sh [PATH OF viewcert-lab]
#
# Needs slurmctld, slurmd and munged (Debian: slurmctld slurmd munge), and root. Takes three minutes, most of which Slurm
# waits before it gives what a dead node had to another one. Without Slurm it says SKIPPED and ends with 0, with
# 1 if VIEWCERT_REQUIRE_SLURM is set.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
lab=$(realpath "${1:-$root/target/debug/viewcert-lab}")
script=$root/lab/catalog_array.sh
for program in slurmctld slurmd munged sbatch; do
    if ! PATH=$PATH:/usr/sbin command -v "$program" >/dev/null || [ "$(id -u)" != 0 ]; then
        echo "SKIPPED: $program is not installed, or this is not root"
        exit "${VIEWCERT_REQUIRE_SLURM:+1}"
    fi
done
PATH=$PATH:/usr/sbin
work=$(mktemp -d)
chmod 755 "$work"
daemons=()
end() {
    local code=$?
    [ "$code" = 0 ] || tail -n 15 "$work"/log/* 2>/dev/null || true
    kill "${daemons[@]}" 2>/dev/null || true
    for pid in $(cat "$work"/jobs.pid 2>/dev/null); do kill -9 -- "-$pid" 2>/dev/null || true; done
    wait 2>/dev/null || true
    rm -rf "$work"
}
trap end EXIT

step() { printf '\n== slurm: %s (after %d s)\n' "$*" "$SECONDS"; }
fail() { echo "FAILED: $*" >&2; exit 1; }

step "the daemons"
mkdir "$work"/{log,state,spool,munge}
chmod 700 "$work/munge"
chmod 755 "$work/munge"
head -c 1024 /dev/urandom >"$work/munge/key"
chmod 600 "$work/munge/key"
# Foreground and apart from a munge that the machine may have.
munged --foreground --force --key-file="$work/munge/key" --socket="$work/munge/socket" --pid-file="$work/munge/pid" \
    --log-file="$work/log/munged" --seed-file="$work/munge/seed" >"$work/log/munged.out" 2>&1 &
daemons+=($!)
host=$(hostname -s)
cat >"$work/slurm.conf" <<CONF
ClusterName=viewcert
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket
CryptoType=crypto/munge
SlurmctldPort=26817
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool/%n
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/%n.pid
SlurmctldLogFile=$work/log/slurmctld
SlurmdLogFile=$work/log/%n
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=2,batch_sched_delay=0
ReturnToService=2
SlurmdTimeout=6
SlurmctldTimeout=10
InactiveLimit=0
KillWait=2
MaxArraySize=41
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=26818 CPUs=1 RealMemory=1500
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=26819 CPUs=1 RealMemory=1500
PartitionName=main Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$work/slurm.conf
sleep 1
slurmctld -D >"$work/log/slurmctld.out" 2>&1 &
daemons+=($!)
node() {
    mkdir -p "$work/spool/$1"
    setsid slurmd -D -N "$1" >"$work/log/$1.out" 2>&1 &
    nodes[$1]=$!
    daemons+=($!)
}
declare -A nodes
node n1
node n2
for _ in $(seq 60); do
    [ "$(sinfo --noheader --Node --states=idle 2>/dev/null | wc -l)" = 2 ] && break
    sleep 0.5
done
sinfo --Node
[ "$(sinfo --noheader --Node --states=idle | wc -l)" = 2 ] || fail "the nodes do not come up"

export LAB=$lab RECHECK=all
submit() { OUT=$1 bash "$script"; }
# Waits until no job is left, at most so many seconds.
idle() {
    for _ in $(seq "$1"); do
        [ -z "$(squeue --noheader)" ] && return
        sleep 1
    done
    squeue
    fail "jobs are left after $1 s"
}
# The table and the digests without times.
single() {
    "$lab" catalog --out "$work/single-$1" --nodes "${@:2}" >/dev/null
    "$lab" catalog merge "$work/single-$1" --recheck all
}

step "verdicts: prepared, 9 shards, merged by dependency; the same as one process"
export NODES=13 SHARDS=9
submit "$work/verdicts"
idle 120
diff "$work/verdicts/merge.txt" <(single verdicts 13 --necessary --verdicts) || fail "another table"
tail -n 2 "$work/verdicts/merge.txt"

step "too many shards, and a folder with another split: refused before any work"
if SHARDS=41 submit "$work/many"; then fail "41 shards were taken"; fi
export NODES=10 OPTIONS='--certificates --part 100'
SHARDS=6 submit "$work/split" >/dev/null
SHARDS=7 submit "$work/split" >/dev/null
idle 240
grep -h "the number of shards is" "$work"/split/slurm-*.log || fail "another split was not refused"
[ "$(find "$work/split" -maxdepth 1 -name 'shard-*' | wc -l)" = 6 ] || fail "shards of another split"
diff "$work/split/merge.txt" <(single lines 10 --certificates --part 100) || fail "another table"

step "a part is corrupted, one is truncated, a shard is lost: the merge names them, a subset of the array makes them again"
cd "$work/split"
dd if=/dev/zero of=shard-2-of-6/part-000001.tsv bs=1 seek=300 count=3 conv=notrunc status=none
truncate -s 1000 shard-5-of-6/part-000000.tsv
rm -r shard-6-of-6
if "$lab" catalog merge . 2>"$work/named"; then fail "a damaged folder was merged"; fi
cat "$work/named"
for words in shard-2-of-6/part-000001.tsv shard-5-of-6/part-000000.tsv 6/6; do
    grep -q "$words" "$work/named" || fail "$words is not named"
done
SHARDS=6 OUT=$work/split sbatch --wait --array=2,5-6 --output="$work/split/again-%a.log" "$script"
SHARDS=6 OUT=$work/split TASK=merge sbatch --wait --output="$work/split/again-merge.log" "$script"
grep -h "computed again" again-*.log
[ "$(cat again-*.log | grep -c 'computed again')" = 2 ] || fail "it is not said what was damaged"
diff merge.txt <("$lab" catalog merge "$work/single-lines" --recheck all) || fail "another table"
cd "$work"

step "a node is killed with all that runs on it; Slurm gives its shards to the other one"
export NODES=11 OPTIONS='--part 500' SHARDS=4
submit "$work/killed"
for _ in $(seq 60); do
    [ "$(find "$work/killed" -name 'part-*.tsv' | wc -l)" -ge 4 ] && break
    sleep 0.5
done
squeue --states=running
before=$(find "$work/killed" -name 'part-*.tsv' | wc -l)
# The daemon, what it started, and what that started: as if the machine had lost its power.
dead=$(ps -e -o pid=,args= | grep "slurmstepd: \[.*\.batch\]\|slurmstepd: \[.*extern\]" | grep -v grep | awk '{print $1}')
victims=${nodes[n2]}
on_n2=$(squeue --noheader --states=running --nodelist=n2 --format=%A | head -n 1)
[ -n "$on_n2" ] || fail "nothing runs on the second node"
for stepd in $dead; do
    if ps -o args= -p "$stepd" | grep -q "\[$on_n2\."; then
        victims+=" $stepd $(pgrep -P "$stepd" | while read -r child; do echo "$child"; pgrep -P "$child" || true; done)"
    fi
done
echo "killed:" && ps -o pid=,args= -p "$(tr '\n ' ',,' <<<"$victims" | sed 's/,,*/,/g; s/,$//')" | cut -c 1-110
# shellcheck disable=SC2086
kill -9 $victims
echo "$before part files were there; job $on_n2 has lost its node"
for _ in $(seq 60); do
    [ "$(sinfo --noheader --Node --nodes=n2 --format=%t)" = "down*" ] && break
    sleep 1
done
sinfo --Node
idle 420
grep -h "requeue\|not responding\|Killing JobId\|Requeuing" "$work/log/slurmctld" | tail -n 5
diff "$work/killed/merge.txt" <(single killed 11 --part 500) || fail "another table"
tail -n 2 "$work/killed/merge.txt"

step "done"
