"""Tables: columns by name."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _softstop

Column = npt.NDArray[np.float64] | npt.NDArray[np.bool_] | npt.NDArray[np.str_]
WORDS = frozenset("before_impact_velocities direction kind order special symbol z".split())
"""Columns of words whatever their cells are: a regime z = p/n is "1" or "2/3"."""


class Table:
    """Columns of equal length, by name as keys and attributes: arrays of numbers (NaN: no value), of True and False, or of words
    ("": no value). Always words are kind, z (p/n: "1", "2/3"), order, special, symbol, direction and before_impact_velocities.

    pandas, polars, pyarrow and DuckDB read it by Arrow's PyCapsule interface: `polars.DataFrame(table)`,
    `pandas.DataFrame.from_arrow(table)`, `pyarrow.table(table)`.

    Examples
    --------
    >>> import numpy as np
    >>> table = Table({"time": np.array([0.5, 1.0]), "kind": ["impact", "back"]})
    >>> table.time[table.kind == "back"], table["kind"][0], len(table)
    (array([1.]), np.str_('impact'), 2)
    """

    def __init__(self, columns: Mapping[str, Column | Sequence[str | None]]) -> None:
        self._columns = {
            name: cells if isinstance(cells, np.ndarray) else np.array([cell or "" for cell in cells], dtype=np.str_)
            for name, cells in columns.items()
        }

    @classmethod
    def of_csv(cls, text: str) -> Table:
        """The table of a CSV file with a head.

        Examples
        --------
        >>> Table.of_csv("time,kind\\n0.5,impact\\n").columns
        ('time', 'kind')
        """
        head, *rows = csv.reader(io.StringIO(text))
        return cls({name: _column(name, [row[index] for row in rows]) for index, name in enumerate(head)})

    def __getitem__(self, name: str) -> Any:
        return self._columns[name]

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in self._columns:
            raise AttributeError(f"{name}: no such column")
        return self._columns[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._columns]

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns."""
        return tuple(self._columns)

    def __len__(self) -> int:
        """Rows."""
        return len(next(iter(self._columns.values()), []))

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        return _softstop.stream([
            (name, [cell or None for cell in cells.tolist()] if cells.dtype.kind == "U" else np.ascontiguousarray(cells))
            for name, cells in self._columns.items()
        ])

    def __repr__(self) -> str:
        return f"<Table of {len(self)} rows: {', '.join(self._columns)}>"

    def _repr_html_(self) -> str:
        from html import escape

        shown = [[str(column[row]) for column in self._columns.values()] for row in range(min(len(self), 20))]
        head = "".join(f"<th>{escape(name)}</th>" for name in self._columns)
        rows = "".join("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in shown)
        return f"<table><caption>{len(self)} rows</caption><tr>{head}</tr>{rows}</table>"


def _column(name: str, cells: list[str]) -> Column:
    """Words, if the name says so; numbers, if all cells that are not empty are numbers; True and False; or words."""
    words = np.array(cells, dtype=np.str_)
    if name in WORDS:
        return words
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells], dtype=np.float64)
    except ValueError:
        return words == "true" if np.isin(words, ["true", "false"]).all() else words
