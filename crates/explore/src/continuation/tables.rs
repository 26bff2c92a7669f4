//! The tables of branches and curves: a row for each point.

use nalgebra::Complex;
use softstop_console::column::Column;
use softstop_console::columns;
use softstop_dynamics::continuation::{Curve, CurvePoint};
use softstop_dynamics::{Branch, BranchPoint};

/// A row of `branches.csv`.
pub(super) struct BranchRow<'a> {
    number: usize,
    branch: &'a Branch,
    point: &'a BranchPoint,
    multipliers: [Complex<f64>; 2],
}

/// The columns of `branches.csv`.
pub(super) fn branch_columns<'a>() -> [Column<BranchRow<'a>>; 13] {
    columns! { BranchRow<'a>, row;
        "branch" [None], "its number, that of the start first" => row.number;
        "periods" [None], "drive periods n of its orbits" => row.branch.periods;
        "value" [Of("own")], "of the parameter, in its own unit" => row.point.parameter;
        "position" [Length], "at time 0, that is at drive angle phi" => row.point.position;
        "velocity" [Velocity], "there" => row.point.velocity;
        "impacts" [None], "in n drive periods" => row.point.impacts.len();
        "before_impact_velocity" [Velocity], "of the hardest impact" => row.point.before_impact_velocity();
        "multiplier1_real" [None], "of the first Floquet multiplier" => row.multipliers[0].re;
        "multiplier1_imaginary" [None], "of the same" => row.multipliers[0].im;
        "multiplier2_real" [None], "of the second Floquet multiplier" => row.multipliers[1].re;
        "multiplier2_imaginary" [None], "of the same" => row.multipliers[1].im;
        "stable" [None], "true or false" => row.point.is_stable();
        "special" [None], "SN, PD, NS, G or PF where the point is one" => symbol_at(row.branch, row.point);
    }
}

/// The rows of a branch with its number.
pub(super) fn branch_rows(
    (number, branch): (usize, &Branch),
) -> impl Iterator<Item = BranchRow<'_>> {
    branch.points.iter().map(move |point| BranchRow {
        number,
        branch,
        point,
        multipliers: point.monodromy.multipliers(),
    })
}

fn symbol_at(branch: &Branch, point: &BranchPoint) -> &'static str {
    let special = branch.special_at(point);
    special.map_or("", |special| special.kind.symbol())
}

/// A row of `curves.csv`.
pub(super) struct CurveRow<'a> {
    number: usize,
    curve: &'a Curve,
    point: &'a CurvePoint,
}

/// The columns of `curves.csv`.
pub(super) fn curve_columns<'a>() -> [Column<CurveRow<'a>>; 10] {
    columns! { CurveRow<'a>, row;
        "curve" [None], "its number" => row.number;
        "periods" [None], "drive periods n of its orbits" => row.curve.periods;
        "special" [None], "SN, PD, NS or G" => row.curve.kind.symbol();
        "value" [Of("own")], "of the parameter, in its own unit" => row.point.parameters[0];
        "second_value" [Of("own")], "of the second parameter" => row.point.parameters[1];
        "position" [Length], "at time 0, that is at drive angle phi" => row.point.position;
        "velocity" [Velocity], "there" => row.point.velocity;
        "before_impact_velocity" [Velocity], "of the hardest impact" => row.point.before_impact_velocity();
        "trace" [None], "of the monodromy matrix, without the touch where the orbit grazes" => row.point.monodromy.trace();
        "determinant" [None], "of the same" => row.point.monodromy.determinant();
    }
}

/// The rows of a curve with its number.
pub(super) fn curve_rows((number, curve): (usize, &Curve)) -> impl Iterator<Item = CurveRow<'_>> {
    curve.points.iter().map(move |point| CurveRow {
        number,
        curve,
        point,
    })
}
