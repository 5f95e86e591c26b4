"""Landmark IDs: mapproof's data association compared with robust estimation and with EM.

Usage: association_peers.py MAPPROOF MRCLAM_FOLDER

Reads the detections of landmarks of each set of MRCLAM, spoils a share of their IDs, and makes a map
of each half of the log (blocks of time, in turn) in five ways:

    given        mapproof map, IDs as given
    repaired     mapproof map --repair-ids
    switchable   one map of all distances between detections of a scan, each with a switch (Sunderhauf
                 and Protzel 2012; the switch is eliminated as Agarwal et al. 2013 do)
    em           hard expectation maximisation: the pose of a scan from the pair of detections that
                 most others agree with, each detection then gets the ID that is nearest in the map,
                 or none, and the map is made again

Prints, of each, the mean log-likelihood of the held-out half's distances under the given IDs (a
normal error of one standard deviation for all ways, with a share of outliers fitted to each), the
mean error of the landmarks of the map of the whole log after a rigid fit to the surveyed positions,
and processor seconds.
"""

import csv
import json
import os
import pathlib
import random
import resource
import subprocess
import sys
import tempfile

import numpy as np
from scipy.optimize import least_squares
from scipy.sparse.csgraph import shortest_path

BLOCKS = 20
ROUNDS = 10


def rows(path):
    with open(path) as file:
        return [line.split() for line in file if line.strip() and not line.startswith("#")]


def read_set(folder):
    """Scans, each a list of (landmark, range in m, bearing in rad), in time of all robots."""
    subject = {code: int(name) for name, code in rows(folder / "Barcodes.dat")}
    ground_truth = {int(r[0]): (float(r[1]), float(r[2])) for r in rows(folder / "Landmark_Groundtruth.dat")}
    scans = {}
    for robot, path in enumerate(sorted(folder.glob("Robot*_Measurement.dat"))):
        for time, code, distance, bearing in rows(path):
            landmark = subject.get(code)
            if landmark in ground_truth:
                scans.setdefault((float(time), robot), []).append(
                    (landmark, float(distance), float(bearing)))
    return [scans[key] for key in sorted(scans)], ground_truth


def spoiled(scans, fault, names):
    """A copy of the scans with wrong IDs."""
    draw = random.Random(1)
    kind, size = fault
    out = []
    for index, scan in enumerate(scans):
        new = []
        for landmark, distance, bearing in scan:
            if kind == "random" and draw.random() < size:
                there = [other for other, _, _ in scan] + [other for other, _, _ in new]
                landmark = draw.choice([name for name in names if name not in there])
            if kind == "swapped" and index >= len(scans) * (1 - size):
                landmark = {names[0]: names[5], names[5]: names[0]}.get(landmark, landmark)
            new.append((landmark, distance, bearing))
        out.append(new)
    return out


def half(scans, which):
    return [s for k, s in enumerate(scans) if k * BLOCKS // len(scans) % 2 == which]


def pairs_of(scans):
    """Arrays of both landmarks and the distance of each two detections of a scan."""
    out = []
    for scan in scans:
        for i, (a, ra, ba) in enumerate(scan):
            for b, rb, bb in scan[i + 1:]:
                if a != b:
                    out.append((min(a, b), max(a, b),
                                abs(ra * np.exp(1j * ba) - rb * np.exp(1j * bb))))
    return out


class Map:
    """Positions of the landmarks of some scans, from distances within scans."""

    def __init__(self, scans, names):
        self.index = {name: k for k, name in enumerate(names)}
        pairs = pairs_of(scans)
        self.a = np.array([self.index[p[0]] for p in pairs])
        self.b = np.array([self.index[p[1]] for p in pairs])
        self.d = np.array([p[2] for p in pairs])
        self.x = self.start(len(names))

    def start(self, count):
        """Classical scaling of shortest paths over the medians of the distances."""
        graph = np.full((count, count), np.inf)
        for i in range(count):
            for j in range(i):
                seen = self.d[(self.a == j) & (self.b == i)]
                if len(seen) >= 3:
                    graph[i, j] = graph[j, i] = np.median(seen)
        paths = shortest_path(np.where(np.isinf(graph), 0, graph), directed=False)
        paths[np.isinf(paths)] = paths[np.isfinite(paths)].max()
        centre = np.eye(count) - 1 / count
        values, vectors = np.linalg.eigh(-0.5 * centre @ paths**2 @ centre)
        return vectors[:, -2:] * np.sqrt(np.maximum(values[-2:], 0))

    def residuals(self, x):
        return np.linalg.norm(x[self.a] - x[self.b], axis=1) - self.d

    def sigma(self):
        return max(1e-3, 1.4826 * np.median(np.abs(self.residuals(self.x))))

    def switchable(self):
        """Each distance has a switch s in [0, 1]: s^2 r^2 + (1 - s)^2, least over s. The standard
        deviation starts wide and is estimated again in each round."""
        for _ in range(ROUNDS):
            sigma = self.sigma()

            def weighted(flat):
                r = self.residuals(flat.reshape(-1, 2)) / sigma
                s = np.minimum(1.0, 2.0 / (1.0 + r**2))
                return np.sqrt(s**2 * r**2 + (1 - s) ** 2)

            self.x = least_squares(weighted, self.x.ravel(), max_nfev=20).x.reshape(-1, 2)
        return self


def pose(seen, placed):
    """The rigid motion of least squares that takes the points seen to their places (complex)."""
    turn = np.sum((placed - placed.mean()) * np.conj(seen - seen.mean()))
    turn = turn / abs(turn) if abs(turn) > 0 else 1.0
    return turn, placed.mean() - turn * seen.mean()


def reassigned(scans, names, places, sigma):
    """The scans with the ID that fits best, without detections that fit none."""
    out = []
    for scan in scans:
        seen = np.array([r * np.exp(1j * b) for _, r, b in scan])
        ids = [names.index(name) for name, _, _ in scan]
        best = None
        for i in range(len(scan)):
            for j in range(i):
                turn, shift = pose(seen[[i, j]], places[[ids[i], ids[j]]])
                error = np.abs(turn * seen + shift - places[ids])
                count = (int(np.sum(error < 3 * sigma)), -error.sum())
                if best is None or count > best[0]:
                    best = (count, turn, shift)
        if best is None or best[0][0] < 3:
            out.append(scan)  # Nothing to check the IDs with.
            continue
        _, turn, shift = best
        new = []
        for z, name, (_, r, b) in zip(seen, ids, scan):
            errors = np.abs(turn * z + shift - places)
            nearest = int(np.argmin(errors))
            if errors[name] < 3 * sigma:
                nearest = name
            if errors[nearest] < 3 * sigma:
                new.append((names[nearest], r, b))
        out.append(new)
    return out


def by_em(scans, names):
    log = scans
    for _ in range(5):
        result = Map(log, names).switchable()
        log = reassigned(scans, names, result.x @ [1, 1j], np.sqrt(2) * result.sigma())
    return Map(log, names).switchable()


def by_mapproof(program, scans, names, options):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "log.csv")
        with open(path, "w", newline="") as file:
            table = csv.writer(file)
            table.writerow(["step", "landmark", "range", "bearing"])
            for step, scan in enumerate(scans, 1):
                for name, distance, bearing in scan:
                    table.writerow([step, name, distance, bearing])
        out = os.path.join(folder, "out")
        done = subprocess.run([program, "map", path, "--sensor", "range-bearing", "--json", "--out",
                               out, *options], capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(done.stderr)
        record = json.loads(done.stdout)
        places = np.full((len(names), 2), np.nan)
        for landmark in record["landmarks"]:
            if landmark["x_m"] is not None:
                places[names.index(int(landmark["name"]))] = landmark["x_m"], landmark["y_m"]
        return places


def likelihood(residuals, sigma, width):
    share = 0.1
    for _ in range(30):
        inside = (1 - share) * np.exp(-0.5 * (residuals / sigma) ** 2) / (sigma * np.sqrt(2 * np.pi))
        outside = share / width
        total = np.mean(np.log(inside + outside))
        share = np.clip(np.mean(outside / (inside + outside)), 1e-4, 0.999)
    return total


def landmark_error(places, ground_truth, names):
    seen = places @ [1, 1j]
    true = np.array([complex(*ground_truth[name]) for name in names])
    known = np.isfinite(seen)
    best = np.inf
    for points in (seen, np.conj(seen)):
        turn, shift = pose(points[known], true[known])
        best = min(best, np.mean(np.abs(turn * points[known] + shift - true[known])))
    return best


def seconds():
    return sum(resource.getrusage(who).ru_utime + resource.getrusage(who).ru_stime
               for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))


def main():
    program, data = sys.argv[1], pathlib.Path(sys.argv[2])
    ways = {
        "given": lambda s, n: by_mapproof(program, s, n, []),
        "repaired": lambda s, n: by_mapproof(program, s, n, ["--repair-ids"]),
        "switchable": lambda s, n: Map(s, n).switchable().x,
        "em": lambda s, n: by_em(s, n).x,
    }
    print("set fault way held_out_nats error_m cpu_s")
    for folder in sorted(p for p in data.iterdir() if (p / "Barcodes.dat").exists()):
        sound, ground_truth = read_set(folder)
        names = sorted({name for scan in sound for name, _, _ in scan})
        for fault in (("none", 0), ("random", 0.1), ("random", 0.3), ("swapped", 0.3)):
            scans = spoiled(sound, fault, names)
            residuals, errors, times = {}, {}, {}
            for way, make in ways.items():
                residuals[way] = []
                for which in (0, 1):
                    places = make(half(scans, which), names)
                    a, b, d = zip(*pairs_of(half(scans, 1 - which)))
                    a, b = ([names.index(name) for name in ids] for ids in (a, b))
                    r = np.abs(np.linalg.norm(places[a] - places[b], axis=1) - d)
                    residuals[way].append(r[np.isfinite(r)])
                residuals[way] = np.concatenate(residuals[way])
                start = seconds()
                errors[way] = landmark_error(make(scans, names), ground_truth, names)
                times[way] = seconds() - start
            sigma = max(1e-3, 1.4826 * min(np.median(r) for r in residuals.values()))
            width = max(d for _, _, d in pairs_of(scans))
            for way in ways:
                print(folder.name, f"{fault[0]}:{fault[1]}", way,
                      f"{likelihood(residuals[way], sigma, width):.3f} {errors[way]:.3f}",
                      f"{times[way]:.1f}", flush=True)


if __name__ == "__main__":
    main()
