"""For each run: the share of the time in which photographers that wait for an explorer are linked to it.

    python3 python/examples/waiting_in_sight.py runs/towers-xxh-1 ...
"""

import sys

import skein


def waits(run: skein.Run) -> list[tuple[str, str, float, float]]:
    """Waits according to activity.csv, except on the ground and during takeoff: photographer, explorer, from, until."""
    roles = {uav["name"]: uav["role"] for uav in run.result["uavs"]}
    found = []
    for uav, role in roles.items():
        rows = run.activity[run.activity["uav"] == uav]
        ends = [*rows["time_s"][1:], run.sim_time_s]
        for row, until_s in zip(rows, ends):
            mate = str(row["waits_for"])
            on_the_ground = str(row["mode"]).startswith(("on the ground", "takes off", "waits to be shown"))
            if role == "photographer" and roles.get(mate) == "explorer" and not on_the_ground:
                found.append((uav, mate, float(row["time_s"]), float(until_s)))
    return found


for path in sys.argv[1:]:
    run = skein.Run(path)
    waited_s = linked_s = 0.0
    for uav, mate, from_s, until_s in waits(run):
        links = run.links[(run.links["a"] == mate) & (run.links["b"] == uav)]
        linked_s += sum(max(0.0, min(until_s, link["to_s"]) - max(from_s, link["from_s"])) for link in links)
        waited_s += until_s - from_s
    share = f"{100.0 * linked_s / waited_s:.0f} % of {waited_s:.0f} s" if waited_s else "no UAV waited"
    print(f"{path}: {share}")
