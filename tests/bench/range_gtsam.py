"""Errors and coverage of the maps of range_gtsam and of `mapproof slam`.

    range_gtsam.py NAME FOLDER REFERENCE

FOLDER is what `mapproof slam --out` wrote, with own.txt and odometry.txt of range_gtsam; REFERENCE a
folder with groundtruth.csv and landmarks.csv, or a g2o file.
"""

import csv
import json
import pathlib
import sys

import numpy as np


def rows(path):
    with open(path, newline="") as file:
        return list(csv.reader(file))[1:]


def rigid(source, target):
    """The rotation and translation that fit source to target best."""
    mean, goal = source.mean(0), target.mean(0)
    u, _, vt = np.linalg.svd((source - mean).T @ (target - goal))
    flip = np.diag([1.0, np.sign(np.linalg.det(vt.T @ u.T))])
    rotation = vt.T @ flip @ u.T
    return rotation, goal - rotation @ mean


def true_positions(path, times):
    """True positions at the times, rows that have one, and the landmarks by name."""
    if path.is_dir():
        drive = np.array([[float(x) for x in row[:3]] for row in rows(path / "groundtruth.csv")])
        at = np.stack([np.interp(times, drive[:, 0], drive[:, k]) for k in (1, 2)], axis=1)
        known = (times >= drive[0, 0]) & (times <= drive[-1, 0])
        return at, known, {r[0]: (float(r[1]), float(r[2])) for r in rows(path / "landmarks.csv")}
    fields = [line.split() for line in path.read_text().splitlines()]
    poses = [f for f in fields if f and f[0] == "VERTEX_SE2"]
    poses.sort(key=lambda f: int(f[1]))
    at = np.array([[float(f[2]), float(f[3])] for f in poses])[: len(times)]
    return at, np.ones(len(at), bool), {}


def coverage(landmarks, covariances, reference):
    rotation, shift = rigid(reference, landmarks)
    errors = landmarks - (reference @ rotation.T + shift)
    nees = [e @ np.linalg.solve(c, e) for e, c in zip(errors, covariances)]
    return sum(n <= 5.991 for n in nees), float(np.mean(nees))


def free_of_frame(landmarks, joint):
    """The 2 x 2 blocks of the joint covariance without shifts and rotations of the whole map."""
    count = len(landmarks)
    frame = np.zeros((2 * count, 3))
    frame[0::2, 0] = frame[1::2, 1] = 1.0
    centred = landmarks - landmarks.mean(0)
    frame[0::2, 2], frame[1::2, 2] = -centred[:, 1], centred[:, 0]
    project = np.eye(2 * count) - frame @ np.linalg.pinv(frame)
    free = project @ joint @ project.T
    return [free[2 * i : 2 * i + 2, 2 * i : 2 * i + 2] for i in range(count)]


def print_row(name, method, seconds, path, landmarks, covariances, reference):
    at, known, true_landmarks = reference
    rotation, shift = rigid(path[known], at[known])
    mean = np.linalg.norm(path[known] @ rotation.T + shift - at[known], axis=1).mean()
    text = f"{name:10} {method:24} {seconds:>8} {mean:8.3f} m"
    if len(true_landmarks):
        errors = np.linalg.norm(landmarks @ rotation.T + shift - true_landmarks, axis=1)
        inside, nees = coverage(landmarks, covariances, true_landmarks)
        text += f" {errors.mean():8.3f} m {inside:3} of {len(landmarks)} {nees:8.2f}"
    print(text)


def main(name, folder, reference):
    path = np.array([[float(x) for x in row[:3]] for row in rows(folder / "path.csv")])
    names = [row[0] for row in rows(folder / "landmarks.csv")]
    at, known, by_name = true_positions(reference, path[:, 0])
    reference = at, known, np.array([by_name[n] for n in names]) if by_name else []
    records = json.loads((folder / "slam.json").read_text())["records"]
    refined = next(r for r in records if r["method"] == "refined")
    ours, blocks = [], []
    if by_name:
        ours = np.array(refined["landmarks_m"], dtype=float)
        blocks = [np.array([[c[0], c[1]], [c[1], c[2]]]) for c in refined["landmark_cov_m2"]]
    print_row(name, "mapproof, refined", "", path[:, 1:], ours, blocks, reference)
    for start in ("own", "odometry"):
        fields = [line.split() for line in (folder / f"{start}.txt").read_text().splitlines()]
        poses = np.array([[float(x) for x in f[2:4]] for f in fields if f[0] == "pose"])
        found = [f for f in fields if f[0] == "landmark"]
        landmarks = np.array([[float(x) for x in f[2:4]] for f in found])
        count = len(landmarks)
        joint = np.array([[float(x) for x in f[4:]] for f in found]).reshape(count, count, 2, 2)
        joint = joint.transpose(0, 2, 1, 3).reshape(2 * count, 2 * count)
        print_row(name, f"GTSAM, from {start}", f"{float(fields[0][1]):.2f} s", poses, landmarks,
                  free_of_frame(landmarks, joint), reference)


main(sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]))
