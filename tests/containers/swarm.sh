#!/usr/bin/env bash
# Starts a Docker swarm of two engines. Each is on a host of its own: two network namespaces, connected by a veth pair
# (the cable). node1 is the manager.
#   swarm.sh up FOLDER IMAGE...    starts the swarm with these images of the running engine; its manager's socket is
#                                  FOLDER/node1.sock
#   swarm.sh cut FOLDER            cuts the cable
#   swarm.sh down FOLDER           ends the swarm
# Exit code 77: impossible here (not root, no dockerd, no network namespaces, or no overlay networks).
set -euo pipefail
what=$1 folder=$2
shift 2
name=swarm$(basename "$folder" | cksum | cut -c1-5)  # prefix of the namespaces' names; short enough for device names
on() { local node=$1; shift; docker --host "unix://$folder/node$node.sock" "$@"; }
cannot() { echo "swarm.sh: $*" >&2; exit 77; }

down() {
  local node pid
  for node in 2 1; do
    [[ ! -S $folder/node$node.sock ]] ||
      timeout 30 docker --host "unix://$folder/node$node.sock" swarm leave --force || true
    [[ -f $folder/node$node.pid ]] || continue
    pid=$(cat "$folder/node$node.pid")
    kill "$pid" 2>/dev/null || true
    for ((i = 0; i < 300; ++i)); do [[ -d /proc/$pid ]] || break; sleep 0.1; done
  done
  for node in 1 2; do
    # A swarm leaves the mounted network namespaces of its containers behind.
    for mount in $(awk -v below="$folder/" 'index($2, below) == 1 {print $2}' /proc/mounts | sort -r); do
      umount "$mount" || true
    done
    ip netns del "$name-$node" 2>/dev/null || true
  done
} >"$folder/down.log" 2>&1

up() {
  [[ $(id -u) -eq 0 ]] || cannot "only root can make hosts"
  command -v dockerd >/dev/null || cannot "there is no dockerd"
  docker image inspect "$@" >/dev/null 2>&1 || cannot "no engine that answers has the images $*"
  ip netns add "$name-1" && ip netns add "$name-2" || cannot "no network namespaces here"
  ip link add swarm1 netns "$name-1" type veth peer name swarm2 netns "$name-2" || cannot "no cables here"
  ip -n "$name-1" link add probe type vxlan id 1 dstport 4789 dev swarm1 && ip -n "$name-1" link del probe ||
    cannot "no overlay networks here"
  local node
  for node in 1 2; do
    ip -n "$name-$node" link set lo up
    ip -n "$name-$node" addr add "10.99.0.$node/24" dev "swarm$node"
    ip -n "$name-$node" link set "swarm$node" up
    # Not with `ip netns exec`, which hides the control groups.
    setsid nsenter --net="/run/netns/$name-$node" unshare --uts /bin/sh -c "hostname node$node && exec \"\$@\"" sh \
      dockerd --host "unix://$folder/node$node.sock" --data-root "$folder/data$node" --exec-root "$folder/exec$node" \
      --pidfile "$folder/node$node.pid" --bridge none --ip6tables=false >"$folder/node$node.log" 2>&1 </dev/null &
  done
  for node in 1 2; do
    for ((i = 0; i < 300; ++i)); do on $node version >/dev/null 2>&1 && break; sleep 0.1; done
    on $node version >/dev/null || { tail -n 3 "$folder/node$node.log" >&2; cannot "engine $node did not start"; }
  done
  docker save "$@" -o "$folder/images.tar"
  for node in 1 2; do on $node load --quiet --input "$folder/images.tar"; done
  rm "$folder/images.tar"
  on 1 swarm init --advertise-addr 10.99.0.1
  on 2 swarm join --token "$(on 1 swarm join-token --quiet worker)" 10.99.0.1:2377
  on 1 node ls
}

case $what in
  up) up "$@" ;;
  cut) ip -n "$name-2" link set swarm2 down ;;
  down) down ;;
esac
