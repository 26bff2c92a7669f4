"""Tables are read by others without a copy of ours."""

import numpy as np
import pandas
import polars
import pyarrow
import pytest

import softstop as ss

A = ss.Machine.unloaded(eta=1.15, clearance=10)


def test_arrow():
    table = ss.simulate(A, start=(0, 14), periods=20).crossings
    arrow = pyarrow.table(table)
    assert arrow.column_names == list(table.columns) == ["time", "position", "velocity", "velocity_after", "kind"]
    np.testing.assert_array_equal(arrow["time"].to_numpy(), table["time"])
    assert arrow["kind"].to_pylist() == table["kind"].tolist()
    np.testing.assert_array_equal(polars.DataFrame(table)["velocity"].to_numpy(), table["velocity"])
    np.testing.assert_array_equal(pandas.DataFrame.from_arrow(table)["position"].to_numpy(), table["position"])


def test_no_value():
    table = ss.Table({"a": np.array([1.0, np.nan]), "b": ["x", None]})
    assert pyarrow.table(table).to_pylist() == [{"a": 1.0, "b": "x"}, {"a": None, "b": None}]
    assert table.b.tolist() == ["x", ""]
    assert "2 rows" in table._repr_html_()


def test_columns_choose_rows():
    points = ss.continue_(A, "eta", (0.9, 1.5)).points
    assert points.stable.dtype == np.bool_
    assert points.value[points.special == "PD"] == pytest.approx([0.988907], abs=1e-6)
    modulus = np.hypot(points.multiplier1_real, points.multiplier1_imaginary)
    assert (points.stable == (modulus < 1))[points.special == ""].all()
    assert polars.DataFrame(points)["stable"].to_list() == points.stable.tolist()
