#!/usr/bin/env python3
"""Write trajectories whose errors are known in closed form.

    make_trajectories.py FOLDER

FOLDER/ground-truth/SEQUENCE.txt and FOLDER/SYSTEM/SEQUENCE.txt in TUM format, and
FOLDER/expected.json: the errors that `mapproof evaluate --align none` has to report.
"""

import json
import math
import pathlib
import sys

RADIUS_M = 10.0
POSES = 360


def quaternion(yaw):
    """x y z w of a rotation about z."""
    return 0.0, 0.0, math.sin(0.5 * yaw), math.cos(0.5 * yaw)


def line(scale=1.0, yaw_rate=0.0):
    """101 poses along x at 1 m/s, the first at 0."""
    return [(i, (scale * i, 0.0, 0.0), quaternion(yaw_rate * i)) for i in range(101)]


def helix(offset=(0.0, 0.0, 0.0), growth=1.0):
    """Once around a circle that rises by 0.01 m per pose, heading along it."""
    path = []
    for i in range(POSES):
        angle = 2.0 * math.pi * i / POSES
        position = (growth * RADIUS_M * math.cos(angle) + offset[0],
                    growth * RADIUS_M * math.sin(angle) + offset[1],
                    0.01 * i + offset[2])
        path.append((0.1 * i, position, quaternion(angle + 0.5 * math.pi)))
    return path


def write(file, path):
    file.parent.mkdir(parents=True, exist_ok=True)
    with file.open("w") as out:
        out.write("# t x y z qx qy qz qw\n")
        for time, position, orientation in path:
            out.write(" ".join(repr(float(v)) for v in (time, *position, *orientation)) + "\n")


def main(folder):
    write(folder / "ground-truth" / "line.txt", line())
    write(folder / "ground-truth" / "helix.txt", helix())
    # 1 % too long: pose i is 0.01 i m off, and ten poses are 0.1 m too long.
    write(folder / "stretched" / "line.txt", line(scale=1.01))
    # A circle that is 5 % too large: every pose is 0.5 m off. The chord of a degree is too long
    # by 5 %, as seen from the first pose of a pair, which heads along the circle as it should.
    write(folder / "stretched" / "helix.txt", helix(growth=1.05))
    # A shift of (0.3, 0, 0.4) m: every pose is 0.5 m off, no motion is wrong.
    write(folder / "shifted" / "line.txt",
          [(t, (x + 0.3, y, z + 0.4), q) for t, (x, y, z), q in line()])
    write(folder / "shifted" / "helix.txt", helix(offset=(0.3, 0.0, 0.4)))
    chord_m = 2.0 * RADIUS_M * math.sin(math.pi * 10 / POSES)
    expected = {
        "stretched/line": {"ate": {"rmse_m": 0.01 * math.sqrt(100.0 * 201.0 / 6.0), "mean_m": 0.5,
                                   "median_m": 0.5, "max_m": 1.0}, "rpe_10_poses_m": 0.1},
        "stretched/helix": {"ate": {"rmse_m": 0.5, "mean_m": 0.5, "median_m": 0.5, "max_m": 0.5},
                            "rpe_10_poses_m": 0.05 * chord_m},
        "shifted/line": {"ate": {"rmse_m": 0.5, "mean_m": 0.5, "median_m": 0.5, "max_m": 0.5},
                         "rpe_10_poses_m": 0.0},
        "shifted/helix": {"ate": {"rmse_m": 0.5, "mean_m": 0.5, "median_m": 0.5, "max_m": 0.5},
                          "rpe_10_poses_m": 0.0},
    }
    (folder / "expected.json").write_text(json.dumps(expected, indent=2) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
