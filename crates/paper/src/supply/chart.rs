//! How many z = 1 motions outlast an interrupted supply.

use kuva::backend::svg::SvgBackend;
use kuva::plot::LinePlot;
use kuva::plot::band::BandPlot;
use kuva::plot::legend::LegendPosition;
use kuva::render::annotations::ReferenceLine;
use kuva::render::plots::Plot;
use kuva::render::render::{collect_legend_entries, render_multiple};

use softstop_draw::style;

const COLORS: [&str; 3] = [style::DESIGN, style::REFERENCE, "#009E73"];

/// A name, and for each frequency eta, share that stays z = 1, and both ends of its 95 % interval.
pub(super) type Curve = (String, Vec<[f64; 4]>);

/// The chart as an SVG document, with a curve for each kind of supply; `folds` is where z = 1 ends with strips, and
/// without.
pub(super) fn svg(curves: &[Curve], grazing: f64, folds: [f64; 2], clearance: f64) -> String {
    let plots: Vec<Plot> = curves.iter().zip(COLORS).flat_map(curve).collect();
    let right = curves.iter().flat_map(|(_, points)| points);
    let right = right.map(|point| point[0]).fold(folds[0], f64::max);
    let room = 0.03 * (right - grazing);
    let line = |eta: f64, name: &str| {
        ReferenceLine::vertical(eta)
            .with_color(style::INK)
            .with_dasharray("5 4")
            .with_label(name)
    };
    let mut layout = style::plain((grazing - room, right + room), (0.0, 1.08))
        .with_width(960.0)
        .with_height(520.0)
        .with_title("z = 1 under an interrupted supply of strips")
        .with_subtitle(format!(
            "share of motions that are z = 1 in the end, ρ = {clearance}, with 95 % interval"
        ))
        .with_x_label("drive frequency η = ω/Ω")
        .with_y_label("share that stays z = 1")
        .with_legend_position(LegendPosition::InsideBottomLeft)
        .with_reference_line(line(grazing, "g₀"))
        .with_reference_line(line(folds[0], "s_SN with strips"));
    if folds[1] <= right + room {
        layout = layout.with_reference_line(line(folds[1], "s_SN without"));
    }
    let layout = layout.with_legend_entries(collect_legend_entries(&plots));
    SvgBackend::new()
        .with_pretty(true)
        .render_scene(&render_multiple(plots, layout))
}

fn curve(((name, points), color): (&Curve, &str)) -> [Plot; 2] {
    let column = |index: usize| points.iter().map(move |point| point[index]);
    let band = BandPlot::new(column(0), column(2), column(3));
    let line = LinePlot::new().with_data(column(0).zip(column(1)).collect::<Vec<_>>());
    [
        Plot::Band(band.with_color(color).with_opacity(0.2)),
        Plot::Line(
            line.with_color(color)
                .with_stroke_width(2.2)
                .with_legend(name.clone()),
        ),
    ]
}
