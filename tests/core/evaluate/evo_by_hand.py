#!/usr/bin/env python3
"""Errors of trajectories as evo defines them, in plain numpy: relative errors over all pairs
(--all_pairs) and errors in one plane (--project_to_plane).

    evo_by_hand.py FOLDER      prints the rows of evo_test.cpp for evo's test data

Written from evo's documentation and its definitions alone, not from mapproof: association by the
nearest time within 0.01 s, alignment of least squares in space, projection after it, pairs from
every pose to the later one nearest to the spacing away, within a tenth of it. It prints the
numbers that evo printed for consecutive pairs and in space, too, by which it is checked.
"""
import sys

import numpy as np

SETS = [("kFr1", "kRgbd", "freiburg1_xyz-groundtruth.txt", "freiburg1_xyz-rgbdslam.txt"),
        ("kFr2", "kFr2Orb", "fr2_desk_groundtruth.txt", "fr2_desk_ORB.txt"),
        ("kKitti", "kKittiOrb", "KITTI_00_gt.txt", "KITTI_00_ORB.txt"),
        ("kV102", "kV102Estimate", "V102_groundtruth.csv", "V102.txt")]


def matrix(w, x, y, z):
    norm = np.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = w / norm, x / norm, y / norm, z / norm
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def read(path):
    """Times or None, positions (n x 3), rotations (n x 3 x 3)."""
    if path.endswith(".csv"):
        rows = np.genfromtxt(path, delimiter=",", comments="#")
        return rows[:, 0] / 1e9, rows[:, 1:4], np.array([matrix(*row[4:8]) for row in rows])
    rows = np.genfromtxt(path, comments="#")
    if rows.shape[1] == 12:
        poses = rows.reshape(-1, 3, 4)
        return None, poses[:, :, 3], poses[:, :, :3]
    return rows[:, 0], rows[:, 1:4], np.array([matrix(q[3], *q[:3]) for q in rows[:, 4:8]])


def associated(reference, estimate):
    if reference[0] is None or estimate[0] is None:
        return reference[1:], estimate[1:]
    longer, shorter = (reference, estimate) if len(reference[0]) >= len(estimate[0]) else (estimate, reference)
    pairs = []
    for i, time in enumerate(shorter[0]):
        k = int(np.argmin(np.abs(longer[0] - time)))
        if abs(longer[0][k] - time) <= 0.01:
            pairs.append((k, i))
    of_longer, of_shorter = np.array(pairs).T
    first = (longer[1][of_longer], longer[2][of_longer])
    second = (shorter[1][of_shorter], shorter[2][of_shorter])
    return (first, second) if longer is reference else (second, first)


def aligned(reference, estimate):
    """By the rotation and translation of least squares (Horn 1987, by singular values)."""
    x, y = estimate[0], reference[0]
    covariance = (y - y.mean(0)).T @ (x - x.mean(0)) / len(x)
    u, _, vt = np.linalg.svd(covariance)
    flip = np.diag([1.0, 1.0, np.sign(np.linalg.det(u) * np.linalg.det(vt))])
    rotation = u @ flip @ vt
    offset = y.mean(0) - rotation @ x.mean(0)
    return x @ rotation.T + offset, rotation @ estimate[1]


def in_plane(path, plane):
    axis = {"xy": 2, "xz": 1, "yz": 0}[plane]
    positions, rotations = path[0].copy(), []
    positions[:, axis] = 0.0
    for matrix_ in path[1]:
        # Rz(c) Ry(b) Rx(a): its angles from the columns and rows that hold one sine alone.
        angle = [np.arctan2(matrix_[2, 1], matrix_[2, 2]),
                 np.arctan2(-matrix_[2, 0], np.hypot(matrix_[0, 0], matrix_[1, 0])),
                 np.arctan2(matrix_[1, 0], matrix_[0, 0])][axis]
        rotation = np.eye(3)
        first, second = [i for i in range(3) if i != axis]
        sign = -1.0 if axis == 1 else 1.0
        rotation[first, first] = rotation[second, second] = np.cos(angle)
        rotation[first, second] = -sign * np.sin(angle)
        rotation[second, first] = sign * np.sin(angle)
        rotations.append(rotation)
    return positions, np.array(rotations)


def pairs_of(positions, length, unit, everywhere):
    n = len(positions)
    steps = np.linalg.norm(np.diff(positions, axis=0), axis=1)
    if unit == "poses":
        starts = range(0, n - length, 1 if everywhere else length)
        return [(i, i + length) for i in starts]
    way = np.concatenate([[0.0], np.cumsum(steps)])
    if everywhere:
        pairs = []
        for i in range(n - 1):
            gaps = np.abs(way[i + 1:] - way[i] - length)
            k = int(np.argmin(gaps))
            if gaps[k] <= 0.1 * length:
                pairs.append((i, i + 1 + k))
        return pairs
    ends, walked = [], 0.0
    for i in range(1, n):
        walked += steps[i - 1]
        if walked >= length:
            ends.append(i)
            walked = 0.0
    return list(zip(ends, ends[1:]))


def relative_errors(reference, estimate, length, unit, everywhere):
    errors = []
    for i, j in pairs_of(estimate[0], length, unit, everywhere):
        moved = [path[1][i].T @ (path[0][j] - path[0][i]) for path in (reference, estimate)]
        turned = reference[1][i].T @ reference[1][j]
        errors.append(np.linalg.norm(turned.T @ (moved[1] - moved[0])))
    return np.array(errors)


def print_row(names, poses, errors, words):
    numbers = [np.sqrt(np.mean(errors ** 2)), errors.mean(), np.median(errors), errors.max()]
    print("    {{{}, {}, {}, {}, {{{}}}}},".format(
        *names, poses, words, ", ".join(f"{number:.12g}" for number in numbers)))


def main(folder):
    for reference_name, name, reference_file, file in SETS:
        reference, estimate = associated(read(f"{folder}/{reference_file}"), read(f"{folder}/{file}"))
        names, poses = (reference_name, name), len(reference[0])
        for everywhere in (False, True):
            for length, unit, word in ((1.0, "m", "kMetre"), (100, "poses", "kHundredPoses")):
                errors = relative_errors(reference, estimate, length, unit, everywhere)
                print_row(names, poses, errors,
                          f"kRelative, {word}, {'kAll' if everywhere else 'kConsecutive'}, kSpace")
        fitted = aligned(reference, estimate)
        for plane, word in ((None, "kSpace"), ("xy", "kXy"), ("xz", "kXz"), ("yz", "kYz")):
            flat = reference if plane is None else in_plane(reference, plane)
            other = fitted if plane is None else in_plane(fitted, plane)
            print_row(names, poses, np.linalg.norm(other[0] - flat[0], axis=1),
                      f"kRigid, kMetre, kConsecutive, {word}")
            if plane is None:
                continue
            raw = in_plane(estimate, plane)
            print_row(names, poses, relative_errors(flat, raw, 1.0, "m", True),
                      f"kRelative, kMetre, kAll, {word}")
            print_row(names, poses, relative_errors(flat, raw, 100, "poses", False),
                      f"kRelative, kHundredPoses, kConsecutive, {word}")


if __name__ == "__main__":
    main(sys.argv[1])
