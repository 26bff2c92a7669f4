//! The chart of models: their error over what they cost.

use kuva::backend::svg::SvgBackend;
use kuva::plot::ScatterPlot;
use kuva::plot::scatter::MarkerShape;
use kuva::render::annotations::{ReferenceLine, TextAnnotation};
use kuva::render::layout::TickFormat;
use kuva::render::plots::Plot;
use kuva::render::render::render_multiple;

use softstop_draw::style;

/// A model as it is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// What it is called.
    pub name: String,
    /// Evaluations per drive period.
    pub cost: f64,
    /// Its error; none if it does not give the quantity.
    pub error: Option<f64>,
    /// It is the cheapest within the tolerance.
    pub is_chosen: bool,
}

/// What is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct FidelityPicture {
    /// The title.
    pub title: String,
    /// What the error is one of.
    pub quantity: String,
    /// The largest error that is allowed.
    pub tolerance: f64,
    /// The models.
    pub candidates: Vec<Candidate>,
}

/// The chart of a picture.
#[derive(Debug, Clone)]
pub struct FidelityChart<'a> {
    picture: &'a FidelityPicture,
    x: (f64, f64),
    y: (f64, f64),
}

impl<'a> FidelityChart<'a> {
    /// Both axes are logarithmic: what has no error stands at the lower edge, what has no value at the
    /// upper one.
    #[must_use]
    pub fn new(picture: &'a FidelityPicture) -> Self {
        let costs = picture.candidates.iter().map(|one| one.cost);
        let errors = picture
            .candidates
            .iter()
            .filter_map(|one| one.error.filter(|error| error.is_finite()))
            .chain([picture.tolerance])
            .filter(|error| *error > 0.0);
        let range = |values: &mut dyn Iterator<Item = f64>| {
            values.fold((f64::INFINITY, 0.0f64), |(low, high), value| {
                (low.min(value), high.max(value))
            })
        };
        let (cheap, dear) = range(&mut costs.clone());
        let (small, large) = range(&mut errors.clone().chain([1e-3]));
        Self {
            picture,
            x: (decade(0.7 * cheap).min(10.0), 2.5 * dear),
            y: (0.1 * decade(small), (100.0 * decade(large)).min(1e3)),
        }
    }

    /// The chart as an SVG document.
    #[must_use]
    pub fn svg(&self) -> String {
        let mut layout = style::plain(self.x, self.y)
            .with_log_scale()
            .with_width(900.0)
            .with_height(620.0)
            .with_title(self.picture.title.clone())
            .with_x_label("evaluations of the law of force per drive period")
            .with_y_label(format!("model error of the {}", self.picture.quantity))
            .with_y_tick_format(TickFormat::Sci);
        if self.picture.tolerance > 0.0 {
            layout = layout.with_reference_line(
                ReferenceLine::horizontal(self.picture.tolerance)
                    .with_color(style::OPTIMUM)
                    .with_stroke_width(1.5)
                    .with_dasharray("6 4")
                    .with_label(format!("tolerance {}", self.picture.tolerance)),
            );
        }
        for (place, name) in self.names() {
            layout = layout
                .with_annotation(TextAnnotation::new(name, place.0, place.1).with_font_size(13));
        }
        let plots = self.picture.candidates.iter().map(|one| self.mark(one));
        let scene = render_multiple(plots.collect(), layout);
        SvgBackend::new().with_pretty(true).render_scene(&scene)
    }

    fn place(&self, candidate: &Candidate) -> (f64, f64) {
        let error = match candidate.error {
            Some(0.0) => 2.0 * self.y.0,
            Some(error) if error.is_finite() => error,
            _ => 0.3 * self.y.1,
        };
        (candidate.cost, error)
    }

    fn mark(&self, candidate: &Candidate) -> Plot {
        let (color, shape, size) = match candidate.error {
            _ if candidate.is_chosen => (style::OPTIMUM, MarkerShape::Star, 11.0),
            Some(error) if error <= self.picture.tolerance => {
                (style::DESIGN, MarkerShape::Circle, 6.0)
            }
            Some(error) if error.is_finite() => (style::POINT, MarkerShape::Diamond, 6.0),
            _ => (style::ASIDE, MarkerShape::Cross, 6.0),
        };
        Plot::Scatter(
            ScatterPlot::new()
                .with_data([self.place(candidate)])
                .with_color(color)
                .with_marker(shape)
                .with_size(size),
        )
    }

    /// Names beside the marks, moved down where they would cover one another.
    fn names(&self) -> Vec<((f64, f64), String)> {
        let pixel = (
            (self.x.1 / self.x.0).powf(1.0 / PLOT.0),
            (self.y.1 / self.y.0).powf(1.0 / PLOT.1),
        );
        let line = pixel.1.powf(LETTER.1);
        let mut names: Vec<((f64, f64), String)> = Vec::new();
        let mut candidates: Vec<&Candidate> = self.picture.candidates.iter().collect();
        candidates.sort_by(|a, b| self.place(b).1.total_cmp(&self.place(a).1));
        for candidate in candidates {
            let (cost, error) = self.place(candidate);
            let note = match candidate.error {
                Some(0.0) => ": exact",
                Some(error) if error.is_finite() => "",
                Some(_) => ": another regime",
                None => ": no value",
            };
            let name = format!("{}{note}", candidate.name);
            let width = LETTER.0 * name.chars().count() as f64;
            let away = pixel.0.powf(0.5 * width + LETTER.1);
            let fits = cost * away * away < self.x.1;
            let x = if fits { cost * away } else { cost / away };
            let mut y = error / line.powf(0.3);
            let near =
                |other: &(f64, f64)| (other.0 / x).ln().abs() < 24.0 * LETTER.0 * pixel.0.ln();
            let covers = |y: f64, other: f64| y > other / line && y < other * line;
            while names
                .iter()
                .any(|(other, _)| near(other) && covers(y, other.1))
            {
                y /= pixel.1;
            }
            names.push(((x, y), name));
        }
        names
    }
}

/// Width and height of the area within the axes, in pixels.
const PLOT: (f64, f64) = (822.0, 522.0);
/// Width and height of a letter, in pixels.
const LETTER: (f64, f64) = (7.3, 15.0);

/// The power of ten at or below a value.
fn decade(value: f64) -> f64 {
    10f64.powf(value.log10().floor())
}
