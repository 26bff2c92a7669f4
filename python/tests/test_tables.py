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


@pytest.mark.parametrize("between", [(1.1, 1.2), (0.9, 1.5)])
def test_words_are_words_whatever_they_look_like(between):
    points = ss.sweep(A, between, steps=9, periods=300).points
    branch = ss.continue_(A, "eta", between)
    study = ss.study({"outputs": ["kind", "z"], "axis": [{"parameter": "eta", "from": between[0], "to": between[1], "count": 3}]},
                     machine=A).tables["study"]
    words = [points.z, points.order, points.direction, points.before_impact_velocities, branch.points.special,
             branch.specials.symbol, study.z, ss.basin(A, size=4).tables["basin"].z]
    assert {column.dtype.kind for column in words} == {"U"}
    assert "0" in points.z
    schema = pyarrow.table(points).schema
    assert {str(schema.field(name).type) for name in ("z", "order", "kind")} == {"string"}
