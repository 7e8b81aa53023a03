#!/usr/bin/env python3
"""Measures the cost of a network between hosts: `skein run --place` over links of known delay, compared with one host.

The two hosts are network namespaces. For a round trip of 0, a veth pair connects them. Otherwise each has a TAP device,
and a process forwards the frames between these and delays each by half of the round trip. Flights on one host and on
both alternate, because the machine's speed drifts; both flights of a pair must have the same digest. Needs root and
sshd. For meaningful results, no other program may run on the machine.

  bench/far_hosts.py build/release/bin/skein --round-trips 0,1,10 --pairs 3 --flight "towers --planner patrol"
"""
import argparse
import contextlib
import ctypes
import fcntl
import heapq
import json
import os
import select
import shlex
import signal
import socket
import statistics
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

CLONE_NEWNET, TUNSETIFF, IFF_TAP, IFF_NO_PI = 0x40000000, 0x400454CA, 0x2, 0x1000
LONGEST_FRAME = 65536


def run(*words, **more):
    subprocess.run(words, check=True, **more)


@contextlib.contextmanager
def inside(space):
    """Within this context, sockets and devices that the process opens belong to the network namespace `space`."""
    libc = ctypes.CDLL(None, use_errno=True)
    with open("/proc/self/ns/net") as home, open(f"/run/netns/{space}") as there:
        if libc.setns(there.fileno(), CLONE_NEWNET) != 0:
            raise OSError(ctypes.get_errno(), "setns")
        try:
            yield
        finally:
            libc.setns(home.fileno(), CLONE_NEWNET)


def tap(space):
    """Creates a TAP device `eth0` in a namespace. Returns its file descriptor."""
    with inside(space):
        device = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
        fcntl.ioctl(device, TUNSETIFF, struct.pack("16sH", b"eth0", IFF_TAP | IFF_NO_PI))
    return device


def carry(a, b, delay_s):
    """Forwards frames between two TAP devices, each `delay_s` after its arrival. Never returns."""
    held = []
    while True:
        timeout = max(0.0, held[0][0] - time.monotonic()) if held else None
        for source in select.select([a, b], [], [], timeout)[0]:
            with contextlib.suppress(BlockingIOError):
                while True:
                    frame = os.read(source, LONGEST_FRAME)
                    heapq.heappush(held, (time.monotonic() + delay_s, len(held), b if source == a else a, frame))
        while held and held[0][0] <= time.monotonic():
            _, _, target, frame = heapq.heappop(held)
            with contextlib.suppress(OSError):  # the frame is lost, as on a full link
                os.write(target, frame)


@contextlib.contextmanager
def hosts(round_trip_s):
    """Creates two connected namespaces, 10.250.0.1 and 10.250.0.2. Yields their names."""
    names = [f"far{os.getpid()}{host}" for host in "ab"]
    carrier = None
    try:
        for name in names:
            run("ip", "netns", "add", name)
        if round_trip_s > 0.0:
            taps = [tap(name) for name in names]
            carrier = os.fork()
            if carrier == 0:
                signal.signal(signal.SIGTERM, signal.SIG_DFL)
                carry(*taps, 0.5 * round_trip_s)
            for device in taps:
                os.close(device)
        else:
            run("ip", "link", "add", "eth0", "netns", names[0], "type", "veth", "peer", "name", "eth0", "netns",
                names[1])
        for host, name in enumerate(names, 1):
            run("ip", "-n", name, "address", "add", f"10.250.0.{host}/24", "dev", "eth0")
            for device in ("lo", "eth0"):
                run("ip", "-n", name, "link", "set", device, "up")
        yield names
    finally:
        if carrier:
            os.kill(carrier, signal.SIGTERM)
            os.waitpid(carrier, 0)
        for name in names:
            subprocess.run(["ip", "netns", "delete", name], check=False)


@contextlib.contextmanager
def login(names, folder):
    """Runs sshd on the second host. Yields the ssh configuration file with which the host `b` is reached."""
    for key in ("host_key", "user_key"):
        if not (folder / key).exists():
            run("ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", folder / key)
    (folder / "sshd_config").write_text(
        f"ListenAddress 10.250.0.2:22\nHostKey {folder}/host_key\nAuthorizedKeysFile {folder}/user_key.pub\n"
        "UsePAM no\nStrictModes no\nPasswordAuthentication no\nPermitRootLogin yes\nPidFile none\n")
    config = folder / "ssh_config"
    config.write_text(f"Host b\n  HostName 10.250.0.2\n  User root\n  IdentityFile {folder}/user_key\n"
                      "  IdentitiesOnly yes\n  UserKnownHostsFile /dev/null\n  StrictHostKeyChecking no\n"
                      "  LogLevel ERROR\n")
    script = f"mount -t tmpfs none /run && mkdir /run/sshd && exec /usr/sbin/sshd -D -e -f {folder}/sshd_config"
    with open(folder / "sshd.log", "w") as log, subprocess.Popen(
            ["ip", "netns", "exec", names[1], "sh", "-c", script], stderr=log) as sshd:
        try:
            while subprocess.run(["ip", "netns", "exec", names[0], "ssh", "-F", config, "b", "true"],
                                 stderr=subprocess.DEVNULL).returncode != 0:
                if sshd.poll() is not None:
                    sys.exit("no sshd: " + (folder / "sshd.log").read_text())
                time.sleep(0.2)
            yield config
        finally:
            sshd.terminate()


def round_trip_ms(space):
    """Median time to open a TCP connection to sshd, which takes one round trip [ms]."""
    times = []
    for _ in range(30):
        with inside(space):
            connection = socket.socket()
        with connection:
            begin = time.monotonic()
            connection.connect(("10.250.0.2", 22))
            times.append(1e3 * (time.monotonic() - begin))
    return statistics.median(times)


def fly(name, skein, words, folder):
    out = folder / "run"
    flown = subprocess.run(["ip", "netns", "exec", name, skein, "run", *words, "--no-report", "--no-oracle",
                            "--record=none", "--force", "--out", out], capture_output=True, text=True)
    if flown.returncode != 0:
        sys.exit(flown.stderr)
    result = json.loads((out / "result.json").read_text())
    return result["real_time_factor"], result["digest"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("skein", type=Path)
    parser.add_argument("--round-trips", default="0,0.1,0.3,1,3,10", help="[ms]; with commas")
    parser.add_argument("--pairs", type=int, default=3)
    parser.add_argument("--place", default="jurong=b")
    parser.add_argument("--flight", default="towers --planner patrol --duration 60", help="as for `skein run`")
    options = parser.parse_args()
    flight = shlex.split(options.flight)
    print("| round trip, measured [ms] | one host | two hosts | ratio of each pair | median |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for wanted_ms in map(float, options.round_trips.split(",")):
            with hosts(1e-3 * wanted_ms) as names, login(names, folder) as config:
                placed = ["--place", options.place, "--ssh", f"ssh -F {config}"]
                measured_ms, pairs = round_trip_ms(names[0]), []
                for _ in range(options.pairs):
                    one, digest = fly(names[0], options.skein, flight, folder)
                    two, there = fly(names[0], options.skein, [*flight, *placed], folder)
                    if there != digest:
                        sys.exit(f"another flight over two hosts: {there} and not {digest}")
                    pairs.append((one, two))
                ratios = [two / one for one, two in pairs]
                print(f"| {measured_ms:.2f} | {', '.join(f'{one:.1f}' for one, _ in pairs)} "
                      f"| {', '.join(f'{two:.1f}' for _, two in pairs)} "
                      f"| {', '.join(f'{ratio:.2f}' for ratio in sorted(ratios))} "
                      f"| {statistics.median(ratios):.2f} |", flush=True)


if __name__ == "__main__":
    main()
