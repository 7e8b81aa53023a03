#!/usr/bin/env python3
"""Writes the reference vectors of this folder: the rules of docs/rules.md in a second, independent implementation.

Plain Python without packages, rotation matrices in place of quaternions, so that it shares nothing with Skein's C++:
    python3 make.py            writes scoring.csv and gimbal.csv beside this file
    skein check --golden scoring.csv
No row lies on a border of a decision, where rounding would decide.
"""
import csv
import math
import pathlib
import random

HERE = pathlib.Path(__file__).resolve().parent
SCORING_ROWS = 300
GIMBAL_SEQUENCES, GIMBAL_TICKS = 20, 50


# ---- vectors and matrices --------------------------------------------------------------------------------------

def add(a, b):
    return [x + y for x, y in zip(a, b)]


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def scale(k, a):
    return [k * x for x in a]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def norm(a):
    return math.sqrt(sum(x * x for x in a))


def product(m, n):
    return [[sum(m[i][k] * n[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def apply(m, v):
    return [sum(m[i][k] * v[k] for k in range(3)) for i in range(3)]


def transposed(m):
    return [[m[j][i] for j in range(3)] for i in range(3)]


def turn(axis, angle):
    """Rotation about x (0), y (1) or z (2)."""
    c, s = math.cos(angle), math.sin(angle)
    m = [[0.0] * 3 for _ in range(3)]
    j, k = (axis + 1) % 3, (axis + 2) % 3
    m[axis][axis], m[j][j], m[k][k] = 1.0, c, c
    m[k][j], m[j][k] = s, -s
    return m


def quaternion(roll, pitch, yaw):
    """(w, x, y, z) of Rz(yaw) Ry(pitch) Rx(roll)."""
    def times(a, b):
        return (a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
                a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
                a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
                a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0])

    def about(axis, angle):
        q = [math.cos(angle / 2), 0.0, 0.0, 0.0]
        q[1 + axis] = math.sin(angle / 2)
        return q
    return times(times(about(2, yaw), about(1, pitch)), about(0, roll))


def single(value):
    """The nearest single-precision number."""
    mantissa, exponent = math.frexp(value)
    return math.ldexp(round(mantissa * 2**24), exponent - 24)


def unit(rng):
    while True:
        v = [rng.uniform(-1, 1) for _ in range(3)]
        if 0.1 < norm(v) < 1.0:
            return scale(1 / norm(v), v)


# ---- one picture of one point -----------------------------------------------------------------------------------

CAMERA = {"focal_length": 0.016, "pixel_size": 4.35e-6, "exposure": 0.001, "hfov_deg": 80.0, "vfov_deg": 60.0}
OFFSETS = ([0.2, 0.0, -0.3], [0.25, 0.0, 0.0], [0.0, 0.0, 0.0])
COUNTS_FROM = 0.2


def pixel_moves(p_C, p_dot):
    """By how many pixels a point moves during the exposure, in u and v; None on a border. From the position of the
    point when the shutter closes."""
    mx, my, mz = add(p_C, scale(CAMERA["exposure"], p_dot))
    if abs(mx) < 1e-3:
        return None
    x, y, z = p_C
    f, s = CAMERA["focal_length"], CAMERA["pixel_size"]
    return f / s * abs(z / x - mz / mx), f / s * abs(y / x - my / mx)


def mm_per_pixel(p_C, n_C):
    """Millimetres of the surface per pixel, in u and v; None on a border. From the size of a millimetre of the surface
    on the sensor."""
    m = scale(1 / norm(n_C), n_C)
    steps = [scale(0.0005, [-m[2], 0.0, m[0]]), scale(0.0005, [-m[1], m[0], 0.0])]
    ends = [(add(p_C, d), sub(p_C, d)) for d in steps]
    (v_plus, v_minus), (u_plus, u_minus) = ends
    v_span = abs(v_plus[2] / v_plus[0] - v_minus[2] / v_minus[0])
    u_span = abs(u_plus[1] / u_plus[0] - u_minus[1] / u_minus[0])
    if min(v_span, u_span) < 1e-9:
        return None
    f, s = CAMERA["focal_length"], CAMERA["pixel_size"]
    return s / (f * u_span), s / (f * v_span)


def capture(rng):
    """Draws a camera and a point. Returns the row, or None if it lies on a border."""
    roll, pitch, yaw = (math.radians(rng.uniform(-d, d)) for d in (35, 35, 180))
    p_WB = [rng.uniform(-50, 50), rng.uniform(-50, 50), rng.uniform(2, 60)]
    still = rng.random() < 0.15
    v_B, w_B = ([0.0] * 3, [0.0] * 3) if still else (
        [rng.uniform(-3, 3) for _ in range(3)], [rng.uniform(-1, 1) for _ in range(3)])
    a, b = math.radians(rng.uniform(-90, 90)), math.radians(rng.uniform(-80, 80))
    a_rate, b_rate = (0.0, 0.0) if still else (rng.uniform(-1, 1), rng.uniform(-1, 1))
    offset = rng.choice(OFFSETS)
    desired = rng.choice((1.0, 1.5, 2.0))
    f, s = CAMERA["focal_length"], CAMERA["pixel_size"]
    half_h, half_v = math.radians(CAMERA["hfov_deg"]) / 2, math.radians(CAMERA["vfov_deg"]) / 2

    R_WB = product(product(turn(2, yaw), turn(1, pitch)), turn(0, roll))
    R_WC = product(product(turn(2, yaw), turn(2, a)), turn(1, b))  # the gimbal removes roll and pitch
    p_WC = add(p_WB, apply(R_WB, offset))
    # The point is mostly in the picture, sometimes beside it, above it or behind the camera.
    beyond = 1.0 if rng.random() < 0.8 else 2.0
    depth = rng.uniform(0.5, 15.0) * (1 if rng.random() < 0.95 else -1)
    aim = [depth, abs(depth) * math.tan(half_h) * rng.uniform(-beyond, beyond),
           abs(depth) * math.tan(half_v) * rng.uniform(-beyond, beyond)]
    p_W = [single(x) for x in add(p_WC, apply(R_WC, aim))]
    n_W = [single(x) for x in unit(rng)]

    p_C = apply(transposed(R_WC), sub(p_W, p_WC))
    reach = f / s * 0.001 * desired
    radius = math.hypot(reach / math.cos(half_h), reach * math.tan(half_v)) + 5.0
    x, y, z = p_C
    in_radius = norm(p_C) < radius
    in_fov = x > 0 and abs(math.atan(y / x)) <= half_h and abs(math.atan(z / x)) <= half_v
    if abs(norm(p_C) - radius) < 1e-3 or abs(x) < 1e-3:
        return None
    if min(abs(abs(math.atan(y / x)) - half_h), abs(abs(math.atan(z / x)) - half_v)) < 1e-6:
        return None

    row = {"p_W": p_WB, "q": quaternion(roll, pitch, yaw), "v_B": v_B, "w_B": w_B, "gimbal_yaw": a, "gimbal_pitch": b,
           "gimbal_yaw_rate": a_rate, "gimbal_pitch_rate": b_rate, "cam": offset, **CAMERA,
           "desired_mm_per_pixel": desired, "pt": p_W, "n": n_W, "search_radius": radius, "pt_cam": p_C,
           "in_search_radius": int(in_radius), "in_fov": int(in_fov), "counted": 0}
    if not in_fov:
        return row

    v_WC = apply(R_WB, add(v_B, cross(w_B, offset)))
    yaw_rate = (math.sin(roll) * w_B[1] + math.cos(roll) * w_B[2]) / math.cos(pitch)
    omega_W = add([0.0, 0.0, yaw_rate + a_rate], scale(b_rate, apply(turn(2, yaw + a), [0.0, 1.0, 0.0])))
    p_dot = scale(-1.0, add(cross(apply(transposed(R_WC), omega_W), p_C), apply(transposed(R_WC), v_WC)))
    moves, sizes = pixel_moves(p_C, p_dot), mm_per_pixel(p_C, apply(transposed(R_WC), n_W))
    if moves is None or sizes is None:
        return None
    row["pixel_move_u"], row["pixel_move_v"] = moves
    row["mm_per_pixel_u"], row["mm_per_pixel_v"] = sizes
    row["q_blur"] = 1.0 if max(moves) == 0.0 else min(1.0, 1.0 / max(moves))
    row["q_res"] = min(1.0, desired / max(sizes))
    row["score"] = row["q_blur"] * row["q_res"]
    if abs(row["score"] - COUNTS_FROM) < 1e-6:
        return None
    row["counted"] = int(in_radius and row["score"] >= COUNTS_FROM)
    return row


SCORING = ["p_W_x", "p_W_y", "p_W_z", "q_w", "q_x", "q_y", "q_z", "v_B_x", "v_B_y", "v_B_z", "w_B_x", "w_B_y", "w_B_z",
           "gimbal_yaw", "gimbal_pitch", "gimbal_yaw_rate", "gimbal_pitch_rate", "cam_x", "cam_y", "cam_z",
           "focal_length", "pixel_size", "exposure", "hfov_deg", "vfov_deg", "desired_mm_per_pixel", "pt_x", "pt_y",
           "pt_z", "n_x", "n_y", "n_z", "search_radius", "pt_cam_x", "pt_cam_y", "pt_cam_z", "in_search_radius",
           "in_fov", "pixel_move_u", "pixel_move_v", "q_blur", "mm_per_pixel_u", "mm_per_pixel_v", "q_res", "score",
           "counted"]


def cell(row, column):
    name, _, axis = column.rpartition("_")
    if name in row and axis in "wxyz" and isinstance(row[name], (list, tuple)):
        return row[name][("wxyz" if name == "q" else "xyz").index(axis)]
    return row.get(column, "")


def text(value):
    return value if isinstance(value, str) else format(value, ".17g")


def write(name, columns, rows):
    with open(HERE / name, "w", newline="") as out:
        table = csv.writer(out, lineterminator="\n")
        table.writerow(columns)
        for row in rows:
            table.writerow([text(cell(row, column)) for column in columns])


# ---- the gimbal -------------------------------------------------------------------------------------------------

GIMBAL = ["sequence_id", "tick", "mode", "cmd_pitch", "cmd_yaw", "ticks_since_command", "pitch_limit_deg",
          "yaw_limit_deg", "rate_limit_deg_s", "pitch_before", "yaw_before", "effective_mode", "pitch", "yaw",
          "pitch_rate", "yaw_rate", "saturated_reference_quirk", "partial_saturation_quirk", "stale_rate_quirk"]
TICK = 1 / 20
LIMITS_DEG = {"pitch": 80.0, "yaw": 90.0}
RATE_LIMIT_DEG_S = 60.0
LAPSES_AFTER = 2  # ticks without a rate command
DEGREE = 0.01745329251  # rad; the rounded value of the reference
STILL = 1e-9  # rad/s; a smaller rate is 0 up to rounding


def clamp(value, limit):
    return max(-limit, min(limit, value))


def wrapped(angle):
    return (angle + math.pi) % (2 * math.pi) - math.pi


def gimbal_sequence(rng, number):
    angle, rate = {"pitch": 0.0, "yaw": 0.0}, {"pitch": 0.0, "yaw": 0.0}
    mode, command, age, held = 0, {"pitch": 0.0, "yaw": 0.0}, 0, None
    pushes = number % 2 == 0
    for tick in range(GIMBAL_TICKS):
        age += 1
        if tick == 0 or rng.random() < (0.04 if pushes else 0.15):
            modes = (1, 1, -1, -1, 0)
            if any(0 < abs(r) < STILL for r in rate.values()) or mode == 1:
                modes = (1, -1)  # whether the rate is exactly 0 would depend on rounding
            mode, age, held = rng.choice(modes), 0, None
            most = {1: 3.0, -1: 2.0, 0: 0.0}[mode]
            command = {axis: rng.uniform(-most, most) for axis in angle}
        elif mode == -1 and pushes:
            age = 0  # the same rate in each tick, until the gimbal reaches its limit
        before = dict(angle)
        if mode == -1 and age > LAPSES_AFTER and held is None:
            held = dict(angle)
        effective, wanted = (1, held) if held is not None else (mode, command)
        partial = saturated = stale = False
        for axis in angle:
            limit, most_rate = LIMITS_DEG[axis] * DEGREE, RATE_LIMIT_DEG_S * DEGREE
            if effective == 1:
                target = clamp(wrapped(wanted[axis]), limit)
                rate[axis] = clamp((target - angle[axis]) / TICK, most_rate)
                angle[axis] += rate[axis] * TICK
            elif effective == -1:
                rate[axis] = clamp(wanted[axis], most_rate)
                free = angle[axis] + rate[axis] * TICK
                angle[axis] = clamp(free, limit)
                moved = angle[axis] - before[axis]
                saturated |= rate[axis] != 0 and moved == 0
                partial |= moved != 0 and abs(angle[axis] - free) > STILL
            else:
                stale |= rate[axis] != 0
        yield {"sequence_id": number, "tick": tick, "mode": mode, "cmd_pitch": command["pitch"],
               "cmd_yaw": command["yaw"], "ticks_since_command": age, "pitch_limit_deg": LIMITS_DEG["pitch"],
               "yaw_limit_deg": LIMITS_DEG["yaw"], "rate_limit_deg_s": RATE_LIMIT_DEG_S,
               "pitch_before": before["pitch"], "yaw_before": before["yaw"], "effective_mode": effective,
               "pitch": angle["pitch"], "yaw": angle["yaw"], "pitch_rate": rate["pitch"], "yaw_rate": rate["yaw"],
               "saturated_reference_quirk": int(saturated), "partial_saturation_quirk": int(partial),
               "stale_rate_quirk": int(stale)}


def main():
    rng = random.Random(30)
    captures = []
    while len(captures) < SCORING_ROWS:
        row = capture(rng)
        if row:
            captures.append(row)
    write("scoring.csv", SCORING, captures)
    write("gimbal.csv", GIMBAL, (row for n in range(1, GIMBAL_SEQUENCES + 1) for row in gimbal_sequence(rng, n)))


if __name__ == "__main__":
    main()
