"""What commands return: figures, tables and files."""

from __future__ import annotations

import csv
import io
import json
import os
import pathlib
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _softstop
from ._machine import Machine

Column = npt.NDArray[np.float64] | list[str | None]


class Table:
    """Columns of equal length by name: arrays of numbers (NaN: no value) or lists of words.

    pandas, polars, pyarrow and DuckDB read it by Arrow's PyCapsule interface: `polars.DataFrame(table)`,
    `pandas.DataFrame.from_arrow(table)`, `pyarrow.table(table)`.
    """

    def __init__(self, columns: Mapping[str, Column]) -> None:
        self._columns = dict(columns)

    @classmethod
    def of_csv(cls, text: str) -> Table:
        """The table of a CSV file with a head."""
        head, *rows = csv.reader(io.StringIO(text))
        return cls({name: _column([row[index] for row in rows]) for index, name in enumerate(head)})

    def __getitem__(self, name: str) -> Column:
        return self._columns[name]

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns."""
        return tuple(self._columns)

    def __len__(self) -> int:
        """Rows."""
        return len(next(iter(self._columns.values()), []))

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        return _softstop.stream(list(self._columns.items()))

    def __repr__(self) -> str:
        return f"<Table of {len(self)} rows: {', '.join(self._columns)}>"

    def _repr_html_(self) -> str:
        from html import escape

        shown = [[str(column[row]) for column in self._columns.values()] for row in range(min(len(self), 20))]
        head = "".join(f"<th>{escape(name)}</th>" for name in self._columns)
        rows = "".join("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in shown)
        return f"<table><caption>{len(self)} rows</caption><tr>{head}</tr>{rows}</table>"


def _column(cells: list[str]) -> Column:
    """Numbers, if all cells that are not empty are numbers."""
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells], dtype=np.float64)
    except ValueError:
        return [cell or None for cell in cells]


class Result(Mapping[str, Any]):
    """What a command has found: the fields of its JSON as keys and attributes, its tables and files.

    Attributes
    ----------
    text : str
        The report as the program prints it.
    tables : dict of Table
        The program's CSV files, by name.
    files : dict of bytes
        All files that the program writes, by name.
    """

    def __init__(self, text: str, values: Mapping[str, Any], files: Mapping[str, bytes]) -> None:
        self.text = text
        self.files = dict(files)
        self._values = dict(values)
        self._values.pop("files", None)
        self.tables = {
            name.removesuffix(".csv"): Table.of_csv(content.decode())
            for name, content in self.files.items()
            if name.endswith(".csv")
        }

    def __getitem__(self, key: str) -> Any:
        return self._values[key]

    def __getattr__(self, key: str) -> Any:
        if key.startswith("_"):
            raise AttributeError(key)
        if key in self._values:
            return self._values[key]
        raise AttributeError(f"{key}: no such field; there are {', '.join(self._values)}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._values]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __repr__(self) -> str:
        return self.text

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Writes all files into a folder."""
        place = pathlib.Path(folder)
        place.mkdir(parents=True, exist_ok=True)
        for name, content in self.files.items():
            (place / name).write_bytes(content)

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, Any]:
        bundle: dict[str, Any] = {"text/plain": self.text}
        for name, content in self.files.items():
            if name.endswith(".svg"):
                bundle["image/svg+xml"] = content.decode()
            elif name.endswith(".png"):
                bundle["image/png"] = content
        return bundle


class Design(Result):
    """The best design of a task."""

    @property
    def machine(self) -> Machine:
        """The machine, starting in the design's motion."""
        return Machine.from_toml(self.files["design.toml"].decode())

    def fmu(self, path: str | os.PathLike[str]) -> None:
        """Writes the design as an FMU 2.0 for co-simulation."""
        pathlib.Path(path).write_bytes(self.files["design.fmu"])

    def report(self, path: str | os.PathLike[str]) -> None:
        """Writes the report, one HTML page; the task was solved with `report=True`."""
        if "report.html" not in self.files:
            raise _softstop.MachineError("optimize(..., report=True) makes the report")
        pathlib.Path(path).write_bytes(self.files["report.html"])


def result_of(text: str, values: str, folder: pathlib.Path, kind: type[Result] = Result) -> Result:
    """A result with the files of a folder."""
    files = {path.name: path.read_bytes() for path in sorted(folder.iterdir()) if path.is_file()}
    return kind(text, json.loads(values), files)
