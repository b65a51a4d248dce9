#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes synthetic_left_hand_path.csv and synthetic_right_hand_path.csv: paths of two hands that
nobody moved.

Each path is a sum of smooth moves, from rest to rest with continuous acceleration, so it can be
sampled at any rate. A trigger is pressed once, while both hands do the same at the same time:
  down to a work piece, a stand-still, up by 0.2 m, down again, a stand-still, back to the start
The left hand stands still while its work piece is up, and the right one moves along a figure of
eight. With the trigger released each hand moves a little to the side and back. The motion while
pressed adds up to nothing, and the path ends where it began, so it may be played in a loop.

    make_hand_paths.py            writes the files beside this script
    make_hand_paths.py --check    exit code 1 if one of them is not what this script writes
"""

import math
import pathlib
import sys

RATE = 100  # samples per second
DURATION = 24
FOLDER = pathlib.Path(__file__).parent
HEADER = (
    "# Synthetic {side} hand path, written by make_hand_paths.py; nobody's hand was recorded.\n"
    "# Base frame, x ahead, z up. time in s, position in m, unit quaternion, trigger 0 or 1.\n"
    "time,x,y,z,qx,qy,qz,qw,trigger\n"
)

PRESS = (2.4, 22.3)  # from, until (s)
LIFT = 0.2  # m


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


def eight(u):
    a = 2 * math.pi * cruise(u)
    return [0.06 * math.sin(2 * a), 0.14 * math.sin(a), 0, 0, 0, 12 * math.sin(a)]


def up(way):
    return line(0, 0, way, 0, 0, 0)


def moves(down, aside, *more):
    """The moves of one hand: start (s), duration (s), way of (x y z roll pitch yaw) over 0..1."""
    return [
        (0.4, 1.8, line(*aside)),
        (2.6, 1.9, up(-down)),
        (7.0, 2.0, up(LIFT)),
        *more,
        (16.0, 2.0, up(-LIFT)),
        (20.0, 2.0, up(down)),
        (22.4, 1.4, line(*(-way for way in aside))),
    ]


# The palm of each gripper stays 10 mm above the work piece. x y z (m), roll pitch yaw (degrees).
HANDS = {
    "left": ((0.35, 0.25, 1.05, 0, 0, 0), moves(0.144, (0.06, 0.08, -0.05, 0, 10, 15))),
    "right": ((0.35, -0.25, 1.05, 0, 0, 0),
              moves(0.104, (0.06, -0.08, -0.05, 0, 10, -15), (9.8, 5.0, eight))),
}


def moved(start, way_points, time):
    pose = list(start)
    for begin, duration, way in way_points:
        u = min(max((time - begin) / duration, 0), 1)
        pose = [a + b for a, b in zip(pose, way(u))]
    return pose


def quaternion(roll, pitch, yaw):
    """x y z w of the turn about fixed axes: roll about x, then pitch about y, then yaw about z."""
    sr, sp, sy = (math.sin(math.radians(a) / 2) for a in (roll, pitch, yaw))
    cr, cp, cy = (math.cos(math.radians(a) / 2) for a in (roll, pitch, yaw))
    return (sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy)


def number(value):
    return f"{value:.6f}".replace("-0.000000", "0.000000")


def path_text(side):
    start, way_points = HANDS[side]
    lines = [HEADER.format(side=side)]
    for i in range(DURATION * RATE + 1):
        time = i / RATE
        pose = moved(start, way_points, time)
        values = [*pose[:3], *quaternion(*pose[3:])]
        pressed = PRESS[0] <= time < PRESS[1]
        lines.append(f"{time:.2f},{','.join(map(number, values))},{int(pressed)}\n")
    return "".join(lines)


def main(arguments):
    if arguments not in ([], ["--check"]):
        sys.exit(__doc__)
    for side in HANDS:
        file = FOLDER / f"synthetic_{side}_hand_path.csv"
        if not arguments:
            file.write_text(path_text(side), encoding="utf-8")
        elif file.read_text(encoding="utf-8") != path_text(side):
            sys.exit(f"{file.name} is not what {pathlib.Path(__file__).name} writes: run it")


if __name__ == "__main__":
    main(sys.argv[1:])
