//! How many z = 1 motions outlast an interrupted supply, and how many miss no stroke.

use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Pen, Stroke};
use softstop_draw::shade::ordered;
use softstop_draw::shapes::Sign;
use softstop_draw::style;
use softstop_dynamics::basin::wilson;

use super::{Outcome, READINGS, RUNS, of_run};

/// Width and height of a panel, from one to the next, left and top of the first.
const AREA: (f64, f64) = (560.0, 360.0);
const NEXT: f64 = 660.0;
const FIRST: (f64, f64) = (84.0, 112.0);
const LETTERS: u32 = 14;
/// Dots of the share without a missed stroke.
const DOTS: (f64, f64) = (2.0, 4.0);
const MARK: Stroke = Stroke::dashed(style::INK, 1.2, (5.0, 4.0));

/// The chart as an SVG document; `fold` is where z = 1 ends with strips.
pub(super) fn svg(outcomes: &[Outcome], grazing: f64, fold: f64, clearance: f64) -> String {
    let right = outcomes.iter().map(|it| it.eta).fold(fold, f64::max);
    let room = 0.03 * (right - grazing);
    let mut pen = Pen::page(FIRST.0 + 2.0 * NEXT + 180.0, FIRST.1 + AREA.1 + 72.0);
    let title = format!("z = 1 under an interrupted supply of strips, ρ = {clearance}");
    let explanation = "strips come and fail in runs of a mean length; bands: 95 % intervals";
    heading(&mut pen, (FIRST.0, 36.0), &title, explanation);
    let axes = Axes::new(
        LETTERS,
        Some("drive frequency η = ω/Ω"),
        "share of motions",
        (6, 6),
    );
    for (index, (reading, name)) in READINGS.into_iter().enumerate() {
        let left = FIRST.0 + NEXT * index as f64;
        let area = (left, FIRST.1, AREA.0, AREA.1);
        let panel = Panel::new(area, (grazing - room, right + room), (0.0, 1.02));
        panel.ground(&mut pen, &axes);
        let own = outcomes
            .iter()
            .filter(|it| it.stop_without_strip == reading);
        let own: Vec<Outcome> = own.copied().collect();
        for (mean, color) in runs() {
            curves(&mut pen, &panel, of_run(&own, mean), color);
        }
        for eta in [grazing, fold] {
            panel.curve(&mut pen, &[(eta, 0.0), (eta, 1.02)], MARK);
        }
        let beside = (panel.across(grazing) + 6.0, panel.height(0.5));
        pen.text(beside, LETTERS, Align::Left, "g₀");
        let above = (panel.across(fold), FIRST.1 - 8.0);
        pen.text(above, LETTERS, Align::Middle, "s_SN with strips");
        panel.axes(&mut pen, &axes);
        let place = (left, FIRST.1 - 12.0);
        let name = name.replace("rho", "ρ");
        pen.heading(place, LETTERS + 2, Align::Left, &name);
    }
    let solid = Stroke::solid(style::INK, 2.2);
    let dotted = Stroke::dashed(style::INK, 1.6, DOTS);
    let lines = [(solid, "z = 1 in the end"), (dotted, "no stroke missed")];
    let lines = lines.map(|(stroke, name)| (Sign::Line(stroke), name.to_owned()));
    let signs = runs().map(|(mean, color)| {
        let sign = Sign::Line(Stroke::solid(color, 2.2));
        (sign, format!("runs of {mean} periods"))
    });
    let signs = signs.chain(lines);
    let place = (FIRST.0 + 2.0 * NEXT - 50.0, FIRST.1 + 14.0);
    pen.legend(place, LETTERS, &signs.collect::<Vec<_>>());
    pen.svg()
}

/// Mean lengths of runs, and their colours.
fn runs() -> impl Iterator<Item = (f64, &'static str)> {
    let runs = RUNS.into_iter().enumerate();
    runs.map(|(index, mean)| (mean, ordered(index, RUNS.len())))
}

/// How many are z = 1 in the end, and how many have missed no stroke.
fn curves<'a>(
    pen: &mut Pen,
    panel: &Panel,
    outcomes: impl Iterator<Item = &'a Outcome>,
    color: &'static str,
) {
    let (mut stay, mut sure, mut struck) = (Vec::new(), Vec::new(), Vec::new());
    for it in outcomes {
        let share = |lost: usize| (it.motions - lost) as f64 / it.motions as f64;
        stay.push((it.eta, share(it.ended)));
        sure.push((it.eta, wilson(it.motions - it.ended, it.motions)));
        struck.push((it.eta, share(it.missed)));
    }
    panel.band(pen, &sure, color, 0.2);
    panel.curve(pen, &stay, Stroke::solid(color, 2.2));
    panel.curve(pen, &struck, Stroke::dashed(color, 1.6, DOTS));
}
