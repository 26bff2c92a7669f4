//! Colours, sizes and the frame of the charts.

use kuva::plot::legend::LegendPosition;
use kuva::render::annotations::TextAnnotation;
use kuva::render::layout::Layout;
use kuva::render::theme::Theme;

// The colours are Okabe and Ito's, told apart by colour-blind readers too
// (https://jfly.uni-koeln.de/color/).
/// Blue.
pub const DESIGN: &str = "#0072B2";
/// Orange.
pub const REFERENCE: &str = "#E69F00";
/// Black.
pub const POINT: &str = "#000000";
/// Vermilion.
pub const OPTIMUM: &str = "#D55E00";
/// Sky blue.
pub const ALLOWED: &str = "#56B4E9";
/// Grey, of what stands beside the matter.
pub const ASIDE: &str = "#777777";

/// Almost black, of lines and letters of drawings.
pub const INK: &str = "#222222";

/// The letters.
pub const FONTS: &str = "DejaVu Sans, Helvetica, Arial, sans-serif";

/// The ranges of both axes.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    x: (f64, f64),
    y: (f64, f64),
    /// Whether the curves leave room for the legend at the lower right.
    roomy: bool,
}

impl Frame {
    /// Room around points of eta and X'-, more at the top, where the names are.
    pub fn around(points: &[(f64, f64)]) -> Self {
        let low = points.iter().map(|point| point.0).fold(f64::MAX, f64::min);
        let high = points.iter().map(|point| point.0).fold(f64::MIN, f64::max);
        let top = 1.2 * points.iter().map(|point| point.1).fold(0.0, f64::max);
        let pad = 0.08 * (high - low);
        let x = (low - pad, high + pad);
        let corner = (x.0 + 0.64 * (x.1 - x.0), 0.24 * top);
        let roomy = !points
            .iter()
            .any(|&(eta, velocity)| eta > corner.0 && velocity < corner.1);
        Self {
            x,
            y: (0.0, top),
            roomy,
        }
    }

    /// A name below and to the right of a point.
    pub fn beside(&self, (x, y): (f64, f64), name: &str) -> TextAnnotation {
        let (across, up) = (self.x.1 - self.x.0, self.y.1 - self.y.0);
        TextAnnotation::new(name, x + 0.018 * across, y - 0.045 * up).with_font_size(14)
    }

    /// A velocity above all curves and below the names of the vertical lines.
    pub fn near_top(&self) -> f64 {
        0.88 * self.y.1
    }
}

/// Axes, title and legend.
pub fn layout(frame: &Frame, title: &str, subtitle: &str) -> Layout {
    let (legend, width) = if frame.roomy {
        (LegendPosition::InsideBottomRight, 860.0)
    } else {
        (LegendPosition::OutsideRightTop, 1080.0)
    };
    plain(frame.x, frame.y)
        .with_width(width)
        .with_height(620.0)
        .with_title(title)
        .with_subtitle(subtitle)
        .with_x_label("drive frequency η = ω/Ω")
        .with_y_label("before-impact velocity X′₋")
        .with_legend_position(legend)
}

/// Axes of these ranges in the style of all charts.
pub fn plain(x: (f64, f64), y: (f64, f64)) -> Layout {
    Layout::new(x, y)
        .with_theme(Theme {
            grid_color: "#e6e6e6".into(),
            legend_border: "#bbbbbb".into(),
            ..Theme::light()
        })
        .with_font_family(FONTS)
        .with_x_axis_min(x.0)
        .with_x_axis_max(x.1)
        .with_y_axis_min(y.0)
        .with_y_axis_max(y.1)
        .with_ticks(8)
}

/// Words in the middle of axes of these ranges that have nothing else to show.
#[must_use]
pub fn message(layout: Layout, x: (f64, f64), y: (f64, f64), words: &str) -> Layout {
    let place = (x.0 + 0.42 * (x.1 - x.0), f64::midpoint(y.0, y.1));
    let words = TextAnnotation::new(words, place.0, place.1).with_font_size(15);
    layout.with_annotation(words.with_color(ASIDE))
}
