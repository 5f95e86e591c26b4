"""Compares the figures of tests with a baseline by the program mapproof.

Copy this file beside your tests and name it in conftest.py:

    pytest_plugins = ["pytest_mapproof"]

A test takes the fixture `figure_check` and gives it a figure of matplotlib, or the path of a file
(PNG, SVG, PDF, ...):

    def test_path(figure_check):
        figure, axes = plt.subplots()
        axes.plot([0, 1, 4])
        figure_check(figure)                # NAME.png, where NAME is that of the test
        figure_check(figure, "path.svg")    # another name or format

Options of pytest, or keys of pytest.ini. The "=" is needed: before it reads conftest.py, pytest takes
a path behind a space for one of tests.

    --mapproof-baseline=DIR    mapproof_baseline    the baseline; default: baseline, below the root
    --mapproof-out=DIR         mapproof_out         what was drawn, and what differs; default:
                                                    out/figures, below the root
    --mapproof-approve                              take what was drawn as the new baseline
    --mapproof=PROGRAM         mapproof_program     the program; default: mapproof

Thresholds, masks and verdicts that pass stand in mapproof-diff.json in the baseline's folder; an
item's id is the name without its extension. A figure without a baseline fails its test.
"""

import pathlib
import re
import shutil
import subprocess

import pytest

_OPTIONS = {
    "mapproof_baseline": ("--mapproof-baseline", "baseline", "folder with the baseline"),
    "mapproof_out": ("--mapproof-out", "out/figures", "folder for what the tests draw"),
    "mapproof_program": ("--mapproof", "mapproof", "the program mapproof"),
}


def pytest_addoption(parser):
    group = parser.getgroup("mapproof")
    for key, (option, default, text) in _OPTIONS.items():
        group.addoption(option, dest=key, help=f"{text}; default: {default}")
        parser.addini(key, text, default=default)
    group.addoption("--mapproof-approve", action="store_true",
                    help="take what the tests draw as the new baseline")


def _option(config, key):
    return config.getoption(key) or config.getini(key)


def _file_name(text):
    """A name that every file system takes: test_path[a/b] becomes test_path_a_b."""
    return re.sub(r"[^A-Za-z0-9._-]+", "_", text).strip("_")


class FigureCheck:
    """Compares the figures of one test."""

    def __init__(self, config, test_name):
        root = pathlib.Path(str(config.rootpath))
        self._program = _option(config, "mapproof_program")
        self._baseline = root / _option(config, "mapproof_baseline")
        self._out = root / _option(config, "mapproof_out")
        self._approve = config.getoption("mapproof_approve")
        self._name = _file_name(test_name)

    def __call__(self, figure, name=None, **savefig):
        """Fails the test unless the figure passes.

        figure: a figure of matplotlib, or the path of a file that was drawn.
        name: of the file in the baseline; default: that of the test. A figure of matplotlib is
            drawn in the format of its extension, by default PNG.
        savefig: further arguments of savefig().
        """
        is_file = isinstance(figure, (str, pathlib.Path))
        suffix = pathlib.Path(figure).suffix if is_file else ".png"
        file = _file_name(name) if name else self._name
        if not pathlib.Path(file).suffix:
            file += suffix
        self._out.mkdir(parents=True, exist_ok=True)
        current, baseline = self._out / file, self._baseline / file
        if is_file:
            shutil.copyfile(figure, current)
        else:
            figure.savefig(current, **savefig)
        if self._approve:
            self._call(["approve", baseline, current])
        elif not baseline.exists():
            pytest.fail(f"{baseline}: there is no baseline; look at {current}, and if it is right: "
                        "pytest --mapproof-approve", pytrace=False)
        else:
            self._call(["diff", baseline, current, "--page", self._out / (file + ".diff.html")])

    def _call(self, words):
        try:
            done = subprocess.run([self._program, *map(str, words)], capture_output=True,
                                  text=True, check=False)
        except OSError as error:
            pytest.fail(f"{self._program}: {error.strerror}; --mapproof names the program",
                        pytrace=False)
        if done.returncode != 0:
            pytest.fail((done.stdout + done.stderr).strip(), pytrace=False)


@pytest.fixture
def figure_check(request):
    return FigureCheck(request.config, request.node.name)
