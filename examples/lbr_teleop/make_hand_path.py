#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes synthetic_hand_path.csv: the path of a hand that nobody moved.

The path is a sum of smooth moves, each from rest to rest with continuous acceleration, so it can be
sampled at any rate. The trigger is pressed three times:
  1. an oval across the work space; released at rest
  2. a reach, a stand-still of 1.5 s, and back; released while the hand moves
  3. a figure of eight that also makes up for what the second one left; released at rest
Between them the hand moves with the trigger released. It ends where it began, so the path may be
played in a loop, and the motions while pressed add up to nothing.

    make_hand_path.py            writes the file beside this script
    make_hand_path.py --check    exit code 1 if that file is not what this script writes
"""

import math
import pathlib
import sys

RATE = 100  # samples per second
DURATION = 24
TARGET = pathlib.Path(__file__).with_name("synthetic_hand_path.csv")
HEADER = (
    "# Synthetic hand path, written by make_hand_path.py; nobody's hand was recorded.\n"
    "# Base frame, x ahead, z up. time in s, position in m, unit quaternion, trigger 0 or 1.\n"
    "time,x,y,z,qx,qy,qz,qw,trigger\n"
)

PRESSES = ((2.4, 7.2), (9.2, 14.6), (16.8, 22.0))  # from, until (s)
START = (0.35, -0.20, 1.05, 0.0, 0.0, 0.0)  # x y z (m), roll pitch yaw (degrees)


def cruise(u):
    """0 to 1 with a fifth of the time each for a smooth start and stop, the rest at one speed."""
    ramp = 0.2
    if u > 0.5:
        return 1 - cruise(1 - u)
    if u > ramp:
        return (u - ramp / 2) / (1 - ramp)
    w = u / ramp
    return ramp * w**3 * (1 - w / 2) / (1 - ramp)


def step(u):
    """0 to 1 with the least jerk."""
    return u**3 * (10 - 15 * u + 6 * u * u)


def line(*target):
    return lambda u: [step(u) * way for way in target]


def oval(u):
    a = 2 * math.pi * cruise(u)
    return [0.03 * math.sin(2 * a), 0.23 * math.sin(a), 0.09 * (1 - math.cos(a)),
            0, 6 * math.sin(2 * a), 20 * math.sin(a)]


def eight(u):
    a = 2 * math.pi * cruise(u)
    return [0.05 * math.sin(2 * a), 0.22 * math.sin(a), 0.05 * math.sin(2 * a),
            20 * math.sin(a), 0, 8 * math.sin(2 * a)]


# start (s), duration (s), way of (x y z roll pitch yaw) over 0..1
MOVES = [
    (0.4, 1.8, line(0.08, 0.15, -0.06, 0, 0, 10)),
    (2.6, 4.4, oval),
    (7.3, 1.7, line(-0.05, 0.24, 0.12, 10, 0, -15)),
    (9.4, 1.8, line(-0.08, -0.26, 0.06, 0, -20, 0)),
    (12.7, 1.7, line(0, 0, 0, 0, 20, 0)),
    (12.7, 2.7, line(0.08, 0.36, -0.06, 0, 0, 0)),
    (15.5, 1.2, line(0.09, -0.26, -0.08, -10, 0, 10)),
    (17.0, 4.8, eight),
    (22.1, 1.7, None),  # back to the start
]


def moved(moves, time):
    pose = list(START)
    for start, duration, way in moves:
        u = min(max((time - start) / duration, 0), 1)
        pose = [a + b for a, b in zip(pose, way(u))]
    return pose


def closed_moves():
    """The moves with the two that make the path and its pressed parts come back."""
    moves = MOVES[:-1]
    pressed, released = (moved(moves, time) for time in PRESSES[1])
    moves.append((17.0, 4.8, line(*(a - b for a, b in zip(pressed, released)))))
    end = moved(moves, DURATION)
    moves.append((*MOVES[-1][:2], line(*(a - b for a, b in zip(START, end)))))
    return moves


def quaternion(roll, pitch, yaw):
    """x y z w of the turn about fixed axes: roll about x, then pitch about y, then yaw about z."""
    sr, sp, sy = (math.sin(math.radians(a) / 2) for a in (roll, pitch, yaw))
    cr, cp, cy = (math.cos(math.radians(a) / 2) for a in (roll, pitch, yaw))
    return (sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy)


def number(value):
    return f"{value:.6f}".replace("-0.000000", "0.000000")


def path_text():
    moves = closed_moves()
    lines = [HEADER]
    for i in range(DURATION * RATE + 1):
        time = i / RATE
        pose = moved(moves, time)
        pressed = any(start <= time < end for start, end in PRESSES)
        values = [*pose[:3], *quaternion(*pose[3:])]
        lines.append(f"{time:.2f},{','.join(map(number, values))},{int(pressed)}\n")
    return "".join(lines)


def main(arguments):
    if arguments == ["--check"]:
        if TARGET.read_text(encoding="utf-8") != path_text():
            sys.exit(f"{TARGET.name} is not what {pathlib.Path(__file__).name} writes: run it")
    elif arguments:
        sys.exit(__doc__)
    else:
        TARGET.write_text(path_text(), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
