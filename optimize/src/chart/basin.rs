//! Pictures of basins, and of the certainty with which z = 1 establishes itself.

use kuva::backend::svg::SvgBackend;
use kuva::plot::LinePlot;
use kuva::plot::band::BandPlot;
use kuva::render::plots::Plot;
use kuva::render::render::render_multiple;
use softstop::basin::{Axis, Basins, Establishing, Kind, Quantity};
use softstop::orbit::Orbit;

use super::pen::{Align, Pen};
use super::style;

/// Basins as cells of colour.
#[derive(Debug, Clone, Copy)]
pub struct BasinPicture<'a> {
    basins: &'a Basins,
    title: &'a str,
    /// Drive angle at which the orbits' own states are known.
    angle: f64,
}

/// Okabe and Ito's colours of what is neither z = 0 nor z = 1.
const OTHERS: [&str; 6] = [
    "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#F0E442", "#D55E00",
];
/// Pixels that the longer side of the grid has about.
const SIDE: usize = 900;
/// Margins around the grid: left, top, right, bottom.
const MARGINS: (f64, f64, f64, f64) = (86.0, 56.0, 330.0, 66.0);
/// Size of letters.
const LETTERS: u32 = 15;
/// Numbers on an axis.
const TICKS: usize = 6;

impl<'a> BasinPicture<'a> {
    /// The picture of basins; `angle`: the drive angle of the machine at time 0.
    #[must_use]
    pub fn new(basins: &'a Basins, title: &'a str, angle: f64) -> Self {
        Self {
            basins,
            title,
            angle,
        }
    }

    /// As PNG.
    ///
    /// # Errors
    /// Why it cannot be made.
    pub fn png(&self) -> Result<Vec<u8>, String> {
        let (width, height) = self.size();
        let page = (
            width + MARGINS.0 + MARGINS.2,
            height.max(200.0) + MARGINS.1 + MARGINS.3,
        );
        let mut pen = Pen::new(page.0, page.1);
        pen.fill(&[(0.0, 0.0, page.0, page.1)], "#ffffff");
        pen.heading((MARGINS.0, 34.0), 19, Align::Left, self.title);
        self.cells(&mut pen);
        self.axes(&mut pen);
        self.attractors(&mut pen);
        self.legend(&mut pen);
        pen.png()
    }

    /// Pixels of a cell's side.
    fn cell(&self) -> f64 {
        let grid = &self.basins.grid;
        (SIDE / grid.across.cells.max(grid.up.cells)).max(1) as f64
    }

    fn size(&self) -> (f64, f64) {
        let grid = &self.basins.grid;
        let cell = self.cell();
        (cell * grid.across.cells as f64, cell * grid.up.cells as f64)
    }

    /// Runs of one colour, row by row.
    fn cells(&self, pen: &mut Pen) {
        let colors = self.colors();
        let cell = self.cell();
        let bottom = MARGINS.1 + self.size().1;
        let mut tiles = Vec::new();
        for (row, classes) in self
            .basins
            .cells
            .chunks(self.basins.grid.across.cells)
            .enumerate()
        {
            let top = bottom - cell * (row + 1) as f64;
            let mut from = 0;
            for run in classes.chunk_by(|a, b| a == b) {
                let area = (
                    MARGINS.0 + cell * from as f64,
                    top,
                    cell * run.len() as f64,
                    cell,
                );
                tiles.push((area, colors[usize::from(run[0])]));
                from += run.len();
            }
        }
        pen.mosaic(&tiles);
    }

    fn colors(&self) -> Vec<&'static str> {
        let mut others = OTHERS.iter().cycle();
        let kinds = self.basins.classes.iter().map(|class| &class.kind);
        let color = |kind: &Kind| match kind {
            Kind::Periodic(orbit) => match (orbit.impacts.len(), orbit.periods) {
                (0, _) => "#D9D9D9",
                (1, 1) => style::DESIGN,
                _ => others.next().copied().unwrap_or(OTHERS[0]),
            },
            Kind::AtRest => "#A6A6A6",
            Kind::Chaotic(_) => style::POINT,
            Kind::Unsettled(_) => "#555555",
            Kind::Lost(_) => "#FFFFFF",
        };
        kinds.map(color).collect()
    }

    fn axes(&self, pen: &mut Pen) {
        let grid = &self.basins.grid;
        let (width, height) = self.size();
        let (left, top) = (MARGINS.0, MARGINS.1);
        pen.frame((left, top, width, height));
        for value in ticks(&grid.across) {
            let x = left + width * share(&grid.across, value);
            pen.tick((x, top + height), (x, top + height + 6.0));
            pen.text(
                (x, top + height + 24.0),
                LETTERS,
                Align::Middle,
                &number(value),
            );
        }
        for value in ticks(&grid.up) {
            let y = top + height * (1.0 - share(&grid.up, value));
            pen.tick((left - 6.0, y), (left, y));
            pen.text(
                (left - 10.0, y + 5.0),
                LETTERS,
                Align::Right,
                &number(value),
            );
        }
        let below = (left + 0.5 * width, top + height + 52.0);
        pen.text(below, LETTERS, Align::Middle, name(grid.across.quantity));
        let beside = (left - 58.0, top + 0.5 * height);
        pen.text(beside, LETTERS, Align::Upwards, name(grid.up.quantity));
    }

    /// The points of the periodic motions, where the plane shows them.
    fn attractors(&self, pen: &mut Pen) {
        let grid = &self.basins.grid;
        let plane = (grid.across.quantity, grid.up.quantity);
        if plane != (Quantity::Position, Quantity::Velocity) || grid.angle != self.angle {
            return;
        }
        let (width, height) = self.size();
        for orbit in self.orbits() {
            for state in orbit.states().unwrap_or_default() {
                let (x, y) = (share(&grid.across, state.x), share(&grid.up, state.y));
                if (0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y) {
                    pen.spot((MARGINS.0 + x * width, MARGINS.1 + (1.0 - y) * height), 5.0);
                }
            }
        }
    }

    fn orbits(&self) -> impl Iterator<Item = &Orbit> {
        let kinds = self.basins.classes.iter().map(|class| &class.kind);
        kinds.filter_map(|kind| match kind {
            Kind::Periodic(orbit) => Some(orbit.as_ref()),
            _ => None,
        })
    }

    fn legend(&self, pen: &mut Pen) {
        let left = MARGINS.0 + self.size().0 + 24.0;
        let colors = self.colors();
        for (index, (class, color)) in self.basins.classes.iter().zip(colors).enumerate() {
            let top = MARGINS.1 + 56.0 * index as f64;
            pen.fill(&[(left, top, 22.0, 22.0)], color);
            pen.frame((left, top, 22.0, 22.0));
            let label = match &class.kind {
                Kind::Periodic(orbit) if orbit.periods > 1 => {
                    format!("{} ({})", class.kind.name(), orbit.pattern())
                }
                kind => kind.name(),
            };
            pen.heading((left + 32.0, top + 12.0), LETTERS, Align::Left, &label);
            let [low, high] = class.interval.map(|share| 100.0 * share);
            let share = format!("{:.2} % ({low:.2} to {high:.2})", 100.0 * class.share);
            pen.text((left + 32.0, top + 31.0), LETTERS - 1, Align::Left, &share);
        }
    }
}

/// Where a value lies on an axis, from 0 to 1.
fn share(axis: &Axis, value: f64) -> f64 {
    (value - axis.range[0]) / (axis.range[1] - axis.range[0])
}

/// Round numbers on an axis.
fn ticks(axis: &Axis) -> Vec<f64> {
    let [from, to] = axis.range;
    let rough = (to - from) / TICKS as f64;
    let power = 10_f64.powf(rough.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
    let step = steps
        .into_iter()
        .find(|step| *step >= rough)
        .unwrap_or(rough);
    let (first, last) = ((from / step).ceil() as i64, (to / step).floor() as i64);
    (first..=last).map(|k| k as f64 * step).collect()
}

fn number(value: f64) -> String {
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    text.replace('-', "−")
}

const fn name(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Position => "initial position X",
        Quantity::Velocity => "initial velocity X′",
        Quantity::Angle => "initial drive angle in rad",
    }
}

/// Certainty of z = 1 along the hysteresis zone.
#[derive(Debug, Clone, Copy)]
pub struct CertaintyChart<'a> {
    places: &'a [Establishing],
    title: &'a str,
}

impl<'a> CertaintyChart<'a> {
    /// The chart of these places.
    #[must_use]
    pub fn new(places: &'a [Establishing], title: &'a str) -> Self {
        Self { places, title }
    }

    /// The chart as an SVG document.
    #[must_use]
    pub fn svg(&self) -> String {
        let frequency: Vec<f64> = self.places.iter().map(|place| place.frequency).collect();
        let low = frequency.iter().copied().fold(f64::MAX, f64::min);
        let high = frequency.iter().copied().fold(f64::MIN, f64::max);
        let room = 0.03 * (high - low).max(1e-3);
        let edge = |end: usize| self.places.iter().map(move |place| place.interval[end]);
        let data = self
            .places
            .iter()
            .map(|place| (place.frequency, place.certainty));
        let plots = vec![
            Plot::Band(
                BandPlot::new(frequency.clone(), edge(0), edge(1))
                    .with_color(style::ALLOWED)
                    .with_opacity(0.35),
            ),
            Plot::Line(
                LinePlot::new()
                    .with_data(data.collect::<Vec<_>>())
                    .with_color(style::DESIGN)
                    .with_stroke_width(2.2),
            ),
        ];
        let layout = style::plain((low - room, high + room), (0.0, 1.05))
            .with_width(900.0)
            .with_height(560.0)
            .with_title(self.title)
            .with_subtitle("share of initial states that lead to z = 1, with 95 % interval")
            .with_x_label("drive frequency η = ω/Ω, from g₀ to s_SN")
            .with_y_label("establishing certainty of z = 1");
        SvgBackend::new()
            .with_pretty(true)
            .render_scene(&render_multiple(plots, layout))
    }
}
