//! Colours and letters of the charts.

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

/// Of curves or motions in a row.
pub const SERIES: [&str; 4] = [DESIGN, REFERENCE, "#009E73", "#882255"];

/// Almost black, of lines and letters of drawings.
pub const INK: &str = "#222222";

/// What stands for a colour in a page, light or dark.
const THEME: [(&str, &str); 9] = [
    (INK, "var(--ink)"),
    (POINT, "var(--ink)"),
    ("#ffffff", "var(--card)"),
    ("#e9e9e9", "var(--grid)"),
    (ASIDE, "var(--aside)"),
    (DESIGN, "var(--design)"),
    (OPTIMUM, "var(--mark)"),
    (REFERENCE, "var(--reference)"),
    (ALLOWED, "var(--allowed)"),
];

/// Elements of SVG with variables of the page in place of colours.
pub(crate) fn themed(elements: &str) -> String {
    THEME
        .iter()
        .fold(elements.to_owned(), |elements, (color, variable)| {
            elements.replace(&color.to_lowercase(), variable)
        })
}

/// The letters.
pub const FONTS: &str = "DejaVu Sans, Helvetica, Arial, sans-serif";

/// Colours and letters of pages, light and dark, as CSS.
pub const PAGE: &str = include_str!("../assets/page.css");

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
