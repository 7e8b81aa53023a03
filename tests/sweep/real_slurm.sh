#!/bin/sh
# Runs a separate Slurm on this machine: munged, slurmctld, and a slurmd for each of two nodes with one core. Uses
# neither systemd nor cgroups. Runs until a signal ends it. None of its processes remains then, even if it is killed.
#   real_slurm.sh FOLDER     FOLDER/slurm.conf is the file for SLURM_CONF; FOLDER/ready appears once Slurm accepts jobs
# A test may kill the process in FOLDER/slurmctld.pid: it is restarted. If a test kills the process in
# FOLDER/node-n2.pid, all processes of this node die, as in a power failure, and the node stays down.
# Exit code 77: Slurm cannot run here; the script prints the reason.
set -eu
folder=$1
[ "$(id -u)" = 0 ] || { echo "only root can start Slurm's daemons"; exit 77; }
for program in slurmctld slurmd sbatch munged; do
  PATH=$PATH:/usr/sbin:/sbin command -v $program >/dev/null ||
    { echo "there is no $program: apt-get install slurmctld slurmd slurm-client munge"; exit 77; }
done
unshare --pid --fork --kill-child --mount-proc true 2>/dev/null || { echo "no PID namespaces here"; exit 77; }
PATH=$PATH:/usr/sbin:/sbin
mkdir -p "$folder/state" "$folder/spool-n1" "$folder/spool-n2" "$folder/munge"
chmod 0755 "$folder"
chmod 0700 "$folder/munge"

# Three ports that no program uses now.
set -- $(python3 -c 'import socket
sockets = [socket.socket() for _ in range(3)]
[s.bind(("127.0.0.1", 0)) for s in sockets]
print(*[s.getsockname()[1] for s in sockets])')
cat >"$folder/slurm.conf" <<END
ClusterName=skein
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmctldPort=$1
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool-%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd-%n.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd-%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1
ReturnToService=2
KillWait=5
SlurmdTimeout=10
MinJobAge=300
MaxArraySize=8
NodeName=n1 NodeHostname=$(hostname) NodeAddr=127.0.0.1 Port=$2 CPUs=1 State=UNKNOWN
NodeName=n2 NodeHostname=$(hostname) NodeAddr=127.0.0.1 Port=$3 CPUs=1 State=UNKNOWN
PartitionName=debug Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF="$folder/slurm.conf"

daemons=
end() {
  trap - EXIT
  kill -KILL $daemons 2>/dev/null || true  # the end of an `unshare` also ends all processes of its node
  wait
}
trap end EXIT
trap 'exit 0' TERM INT HUP

dd if=/dev/urandom of="$folder/munge/key" bs=128 count=1 2>/dev/null
chmod 0400 "$folder/munge/key"
start() { setpriv --pdeathsig KILL "$@" >/dev/null 2>&1 & daemons="$daemons $!"; }
start munged --foreground --force --key-file="$folder/munge/key" --socket="$folder/munge/socket" \
  --pid-file="$folder/munge/pid" --seed-file="$folder/munge/seed" --log-file="$folder/munge/log"
until [ -S "$folder/munge/socket" ]; do sleep 0.1; done
start sh -c 'while setpriv --pdeathsig KILL slurmctld -D || [ $? -eq 137 ]; do :; done'
for node in n1 n2; do
  start unshare --pid --fork --kill-child --mount-proc slurmd -D -N $node
  echo $! >"$folder/node-$node.pid"
done
until [ "$(sinfo --noheader --states=idle --format=%D 2>/dev/null)" = 2 ]; do
  for daemon in $daemons; do kill -0 "$daemon" || { tail -n 5 "$folder"/*.log; exit 1; }; done
  sleep 0.2
done
touch "$folder/ready"
wait
