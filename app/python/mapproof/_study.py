"""Studies as pandas frames."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Generic, Optional, TypeVar, Union

from . import _core

if TYPE_CHECKING:
    import pandas

T = TypeVar("T")


class _Named(Mapping[str, T], Generic[T]):
    """Values by name, each made when it is asked for."""

    def __init__(self, names, make):
        self._names = list(names)
        self._make = make

    def __getitem__(self, name: str) -> T:
        if name not in self._names:
            raise KeyError(name)
        return self._make(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


def _frame(columns) -> "pandas.DataFrame":
    import pandas

    return pandas.DataFrame(columns)


class Study:
    """A folder of records: of a study of any kind, of one map, or of one range log.

    Nothing is computed again. An IoError names the file that cannot be read.
    """

    def __init__(self, folder: Union[str, "os.PathLike[str]"]) -> None:
        self.folder = Path(folder)
        self._contents = _core.read_study(self.folder)

    @property
    def kind(self) -> str:
        """The schema of its records: "mapproof.study", "mapproof.results_study", ..."""
        return self._contents.kind

    @cached_property
    def results(self) -> "pandas.DataFrame":
        """One row per number, with the columns of results.csv; NaN: no number came out."""
        return _frame(self._contents.results)

    @cached_property
    def seconds(self) -> "pandas.DataFrame":
        """What its parts took, as `results`. They vary from run to run."""
        return _frame(self._contents.seconds)

    @cached_property
    def quantities(self) -> "pandas.DataFrame":
        """The quantities in `results`: quantity, label, unit, better (lower, higher, neither)."""
        return _frame(self._contents.quantities)

    @cached_property
    def outcomes(self) -> "pandas.DataFrame":
        """How each method ended in each run: setup, method, run, codes of its statuses."""
        return _frame(self._contents.outcomes)

    @cached_property
    def points(self) -> "Mapping[str, pandas.DataFrame]":
        """Maps and paths by name: columns name, x, y, and true_x, true_y where they are known."""
        all_points = _core.read_study(self.folder, maps=True).points
        return _Named(all_points, lambda name: self._points_frame(*all_points[name]))

    @staticmethod
    def _points_frame(names, points, ground_truth: Optional[object]) -> "pandas.DataFrame":
        columns = {"name": names or [str(i + 1) for i in range(len(points))]}
        columns["x"], columns["y"] = points.T
        if ground_truth is not None:
            columns["true_x"], columns["true_y"] = ground_truth.T
        return _frame(columns)

    @cached_property
    def figures(self) -> Mapping[str, _core.Figure]:
        """The figures that `mapproof report` drew, by id; a notebook shows them."""
        end = ".figure.json"
        files = {p.name[: -len(end)]: p for p in sorted((self.folder / "figures").glob("*" + end))}
        return _Named(files, lambda name: _core.read_figure(files[name]))

    def __repr__(self) -> str:
        return f"<mapproof.Study {str(self.folder)!r}: {self.kind}>"
