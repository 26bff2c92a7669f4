//! What the pictures of a report show.

use serde::Serialize;

use super::Label;

/// What a line of a picture is; this decides how it looks.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// The design's own motion.
    #[default]
    Design,
    /// A motion that no mass stays on.
    Unstable,
    /// Another machine, or the same one in other circumstances.
    Beside,
    /// The boundary g0 of the zone.
    Grazing,
    /// The boundary `s_SN` of the zone.
    Fold,
    /// The boundary `s_PD`: the period doubles.
    Flip,
}

/// A line through points.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Curve {
    /// What it is called in the legend; curves of one name share an entry.
    pub name: String,
    /// What it is.
    pub role: Role,
    /// Values across and upwards.
    pub points: Vec<[f64; 2]>,
}

/// The before-impact velocity over two parameters.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Map {
    /// Axis across.
    pub x: Label,
    /// Axis upwards.
    pub y: Label,
    /// What is shaded.
    pub shade: Label,
    /// Ends of the axis across.
    pub x_range: [f64; 2],
    /// Ends of the axis upwards.
    pub y_range: [f64; 2],
    /// Cells in a row.
    pub columns: usize,
    /// The cells, row by row, the lowest row first; none where there is no such motion.
    pub cells: Vec<Option<f64>>,
    /// Boundaries.
    pub curves: Vec<Curve>,
    /// Where the design is.
    pub design: [f64; 2],
    /// Half widths of its tolerance, across and upwards.
    pub tolerance: Option<[f64; 2]>,
}

/// The before-impact velocity over the drive's frequency.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Response {
    /// Axis across.
    pub x: Label,
    /// Axis upwards.
    pub y: Label,
    /// Motions of the design and beside it.
    pub curves: Vec<Curve>,
    /// Names and frequencies of the ends of the zone.
    pub ends: Vec<(String, f64)>,
    /// Where the design is.
    pub design: [f64; 2],
    /// Lowest and highest frequency within the tolerance of the drive's speed.
    pub tolerance: Option<[f64; 2]>,
    /// Frequency with the least and greatest velocity of machines at the corners of the tolerances, in pieces without a gap.
    pub bands: Vec<Vec<[f64; 3]>>,
    /// How many machines these are.
    pub machines: usize,
}

/// One period of motions in the phase plane.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Portrait {
    /// Axis across.
    pub x: Label,
    /// Axis upwards.
    pub y: Label,
    /// The motions.
    pub curves: Vec<Curve>,
    /// Names and positions of what the mass meets.
    pub faces: Vec<(String, f64)>,
}

/// Which initial state leads to which motion.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Basin {
    /// Axis across.
    pub x: Label,
    /// Axis upwards.
    pub y: Label,
    /// Ends of the axis across.
    pub x_range: [f64; 2],
    /// Ends of the axis upwards.
    pub y_range: [f64; 2],
    /// Cells in a row.
    pub columns: usize,
    /// For each cell its motion, row by row, the lowest row first.
    pub cells: Vec<u16>,
    /// The motions.
    pub motions: Vec<BasinMotion>,
    /// Radius, in units of half of each axis, and middle of the largest ball inside the basin of the design's motion.
    pub ball: Option<(f64, [f64; 2])>,
    /// Where the design's motion passes the plane.
    pub spots: Vec<[f64; 2]>,
}

/// A motion and the share of initial states that lead to it.
#[derive(Debug, Clone, Default, Serialize)]
pub struct BasinMotion {
    /// Its name.
    pub name: String,
    /// Its colour, as in SVG.
    pub color: &'static str,
    /// Share of the cells.
    pub share: f64,
    /// Its 95 % interval.
    pub interval: [f64; 2],
}

/// Share and integrity of the basin of z = 1 along the zone.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Erosion {
    /// From g0 to `s_SN`.
    pub points: Vec<ErosionPoint>,
    /// Place of the design.
    pub design: Option<f64>,
    /// Least share that is required.
    pub required: Option<f64>,
    /// From where motions were started, in words.
    pub starts: String,
}

/// A place of the zone.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub struct ErosionPoint {
    /// 0 at g0, 1 at `s_SN`.
    pub place: f64,
    /// Drive frequency there.
    pub frequency: f64,
    /// Share of initial states that lead to z = 1.
    pub share: f64,
    /// Its 95 % interval.
    pub interval: [f64; 2],
    /// Radius of the largest ball about the motion inside its basin, in units of half of each axis.
    pub integrity: Option<f64>,
}

/// What more of one good costs of another.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Front {
    /// A name for its file.
    pub name: String,
    /// What is traded.
    pub title: String,
    /// Axis across.
    pub x: Label,
    /// Axis upwards.
    pub y: Label,
    /// The best designs, in order.
    pub points: Vec<[f64; 2]>,
    /// Where the design is.
    pub design: Option<[f64; 2]>,
    /// How they were found; may be empty.
    pub note: String,
}

/// How often a value occurs.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Histogram {
    /// What is counted.
    pub x: Label,
    /// Lower end of the first bar and upper end of the last one; all are equally wide.
    pub range: [f64; 2],
    /// Machines in each bar.
    pub counts: Vec<u64>,
    /// The value of the design itself.
    pub nominal: f64,
    /// The worst within the tolerances.
    pub worst: Option<f64>,
    /// Machines that were looked at.
    pub samples: u64,
    /// Those of them without the motion.
    pub lost: u64,
}
