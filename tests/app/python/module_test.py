"""Tests of the module of Python; the environment names the program, the source and a work folder."""

import ast
import csv
import importlib
import os
import re
import subprocess
from pathlib import Path

import mapproof
import numpy
import pandas
import pytest

ROOT = Path(os.environ["MAPPROOF_SOURCE_DIR"])
PROGRAM = os.environ["MAPPROOF_PROGRAM"]
HALL = ROOT / "examples/hall"


@pytest.fixture(scope="module")
def hall():
    return mapproof.read_observations(HALL / "bearings.csv", "bearing")


def circle(count):
    angles = numpy.arange(count) * 2 * numpy.pi / count
    return numpy.column_stack([numpy.cos(angles), numpy.sin(angles)])


def test_a_map_is_that_of_the_program(hall, tmp_path):
    anchors = mapproof.read_positions(HALL / "anchors.csv")
    made = mapproof.map_observations(hall, "smacof-knn", 7, anchors=anchors)
    subprocess.run(
        [PROGRAM, "map", HALL / "bearings.csv", "--sensor", "bearing", "--method", "smacof-knn",
         "-K", "7", "--anchors", HALL / "anchors.csv", "--quiet", "--out", tmp_path],
        check=True, stdout=subprocess.DEVNULL)
    program = pandas.read_csv(tmp_path / "map.csv", float_precision="round_trip")
    assert list(program["name"].astype(str)) == made.names
    assert numpy.array_equal(program[["x_m", "y_m"]].to_numpy(), made.positions)
    assert made.frame == "ground_truth" and made.anchors == sorted(anchors, key=made.names.index)


def test_distances_are_those_of_the_features():
    history = mapproof.simulate("bearing", landmarks=10, steps=40).history
    rows = mapproof.features(history)
    pairs = numpy.linalg.norm(rows[:, None] - rows[None], axis=2)
    assert rows.shape == (10, 80)
    assert numpy.allclose(mapproof.distances(history), pairs, rtol=1e-9, atol=1e-6)


def test_distances_of_visibility_are_those_of_the_features_divided_by_their_norm():
    history = mapproof.simulate("visibility", seed=3, landmarks=10, steps=400).history
    rows = mapproof.features(history)
    assert set(numpy.unique(rows)) == {0, 1} and rows.any(axis=1).all()
    unit = rows / numpy.linalg.norm(rows, axis=1, keepdims=True)
    pairs = numpy.linalg.norm(unit[:, None] - unit[None], axis=2)
    assert numpy.allclose(mapproof.distances(history), pairs, rtol=1e-9, atol=1e-7)


@pytest.mark.parametrize("method", mapproof.methods(), ids=lambda method: method.name)
def test_every_method_maps_a_circle_from_its_distances(method):
    points = circle(24)
    pairs = numpy.linalg.norm(points[:, None] - points[None], axis=2)
    pairs = (pairs + pairs.T) / 2
    made = mapproof.embed_distances(pairs, method.name)
    assert made.coordinates.shape == (24, 2)
    assert numpy.isfinite(made.coordinates).all()
    if method.name in ("lpca", "smacof"):
        assert mapproof.relative_gap(made.coordinates, points) < 1e-3


def test_alignment_is_exact_where_the_points_are():
    points = circle(5)
    rotation = numpy.array([[0.6, -0.8], [0.8, 0.6]])
    moved = 3 * points @ rotation.T + [1, 2]
    fitted = mapproof.fit_similarity(points, moved)
    assert fitted.scale == pytest.approx(3)
    assert numpy.allclose(fitted.rotation, rotation)
    assert numpy.allclose(fitted(points), moved)
    sheared = points @ numpy.array([[1, 2], [0, 1]]) + [4, 5]
    assert numpy.allclose(mapproof.fit_affine(points, sheared, "least_squares")(points), sheared)
    assert mapproof.score_map(moved, moved).mpe_m == pytest.approx(0, abs=1e-12)


def test_a_seed_gives_the_same_simulation_again():
    first = mapproof.simulate("range", seed=3, landmarks=8, steps=30, noise=0.1)
    again = mapproof.simulate("range", seed=3, landmarks=8, steps=30, noise=0.1)
    other = mapproof.simulate("range", seed=4, landmarks=8, steps=30, noise=0.1)
    assert first.history.values.shape == (8, 30) and first.positions_m.shape == (30, 2)
    assert numpy.array_equal(first.history.values, again.history.values)
    assert not numpy.array_equal(first.history.values, other.history.values)


def test_results_are_those_of_the_table():
    for name in ("study", "slam_study", "topic_study"):
        folder = ROOT / "tests/data" / name
        results = mapproof.Study(folder).results
        with open(folder / "results.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        assert list(results.columns) == list(rows[0])
        assert len(results) == len(rows)
        for column in ("setup", "method", "quantity", "run", "group", "subject"):
            assert list(results[column]) == [row[column] for row in rows]
        values = [float(row["value"] or "nan") for row in rows]
        assert numpy.array_equal(results["value"], values, equal_nan=True)


def test_a_study_holds_maps_quantities_and_outcomes():
    study = mapproof.Study(ROOT / "tests/data/study")
    assert study.kind == "mapproof.study"
    assert set(study.results["quantity"]) == set(study.quantities["quantity"])
    assert len(study.outcomes) > 0
    name = next(iter(study.points))
    assert {"name", "x", "y", "true_x", "true_y"} <= set(study.points[name].columns)
    with pytest.raises(KeyError):
        study.points["nothing"]


def test_figures_are_shown_in_a_notebook(hall, tmp_path):
    made = mapproof.map_observations(
        hall, "isomap", 6, anchors=mapproof.read_positions(HALL / "anchors.csv"),
        ground_truth=mapproof.read_positions(HALL / "ground_truth.csv"))
    assert made._repr_svg_().startswith("<?xml") or made._repr_svg_().startswith("<svg")
    figure = made.figure()
    assert figure.png()[:4] == b"\x89PNG" and figure.pdf("paper")[:5] == b"%PDF-"
    (tmp_path / "figures").mkdir()
    figure.write(tmp_path / "figures")
    read = mapproof.read_figure(tmp_path / "figures/map.figure.json")
    assert read._repr_svg_() == made._repr_svg_()
    assert made.score.mpe_m > 0


def test_what_cannot_be_is_refused_with_words(hall, tmp_path):
    with pytest.raises(ValueError, match="did you mean isomap"):
        mapproof.embed(hall, "isomapp")
    with pytest.raises(ValueError, match="K of isomap is an integer"):
        mapproof.embed(hall, "isomap", 2.5)
    with pytest.raises(ValueError, match=r"values\[0, 1\]: 2.*visibility is 0 or 1"):
        mapproof.ObservationHistory("visibility", ["a"], [[0, 2]])
    with pytest.raises(ValueError, match="anchors: no landmark nobody"):
        mapproof.map_observations(hall, "lpca", anchors={"nobody": (0, 0)})
    with pytest.raises(ValueError, match="not symmetric"):
        mapproof.embed_distances([[0, 1], [2, 0]], "lpca")
    with pytest.raises(mapproof.IoError, match="nowhere"):
        mapproof.Study(tmp_path / "nowhere")
    assert issubclass(mapproof.IoError, OSError)


def test_a_failed_map_says_why():
    made = mapproof.embed(mapproof.ObservationHistory("range", ["a", "b"], [[1, 2], [2, 1]]), "lpca")
    assert "failed" in [status.code for status in made.statuses]
    assert str(made.statuses[0])


def stub_names(body):
    return {node.name for node in body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}


def test_the_stub_names_everything_and_every_argument():
    package = Path(mapproof.__file__).parent
    assert (package / "py.typed").exists()
    core = importlib.import_module("mapproof._core")
    tree = ast.parse((package / "_core.pyi").read_text())
    there = {name for name in dir(core) if not name.startswith("_")}
    assert stub_names(tree.body) == there
    for node in tree.body:
        if isinstance(node, ast.FunctionDef) and node.name != "simulate":
            documented = re.search(r"\((.*)\)", getattr(core, node.name).__doc__).group(1)
            named = re.findall(r"(?:^|, )(\w+): ", documented)
            assert [argument.arg for argument in node.args.args] == named, node.name
        if isinstance(node, ast.ClassDef) and node.name != "IoError":
            members = {name for name in vars(getattr(core, node.name)) if not name.startswith("_")}
            assert {name for name in stub_names(node.body) if not name.startswith("_")} == members
