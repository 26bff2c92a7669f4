//! The before-impact velocity over the drive's frequency.

use std::slice;

use softstop::{Dimension, Machine, Parameter, Scene};
use softstop_console::interrupt;
use softstop_draw::{Axis, Layer, Mark, Panel, style};
use softstop_dynamics::continuation::TestFunction;
use softstop_dynamics::{Zone, parallel, zone};

use super::velocity;
use crate::design::{Design, Problem};
use crate::optimize::reference::Reference;
use crate::optimize::study::ToleranceStudy;
use crate::page::branches::{BORDERS, ZoneBranches};
use crate::page::figure::{
    BESIDE, BOUND, DESIGN, Figure, Section, UNSTABLE, WIDE, bounds, lines, pieces,
};
use crate::page::words::quantity;
use crate::robust::{self, AbsoluteTolerance, Tolerances};

/// Half the size of the marks of designs and references.
const MARK: f64 = 8.0;
const BESIDE_MARK: f64 = 6.0;
/// Opacity of machines within the tolerances, of the tolerance of the frequency, and of what the margin allows.
const BAND: f64 = 0.35;
const ALLOWED: f64 = 0.3;
const MARGIN: f64 = 0.15;

/// The motions of the design's machine, those of references, and the band of machines within the tolerances.
pub fn response(
    problem: &Problem,
    design: &Design,
    references: &[Reference],
    study: Option<&ToleranceStudy>,
) -> Figure {
    let machine = &design.machine;
    let own = |frequency: f64| design.own_frequency(frequency);
    let motions = ZoneBranches::of(&design.zone);
    let corners = study.map_or_else(Vec::new, |it| corners(machine, it));
    let bands = bands(problem, &corners);
    let mut curves = motions.unstable(machine, "design, unstable", UNSTABLE);
    for it in references {
        let scenes = slice::from_ref(&it.machine.scene);
        if let Ok(zone) = zone::find_zones(problem.zone, scenes, &interrupt::watch).remove(0) {
            curves.extend(ZoneBranches::of(&zone).stable(&it.machine, &it.title(), BESIDE));
        }
    }
    curves.extend(motions.stable(machine, "design, stable", DESIGN));

    let whole = (f64::NEG_INFINITY, f64::INFINITY);
    let stripe = |ends, opacity| Layer::boxes([[ends, whole]], style::ALLOWED, opacity);
    let mut layers = Vec::new();
    if problem.margin > 0.0 {
        let ends = [problem.margin, 1.0 - problem.margin];
        let [low, high] = ends.map(|place| own(design.zone.frequency_at(place)));
        let name = format!("allowed by margin M = {}", problem.margin);
        layers.push(stripe((low, high), MARGIN).named(name));
    }
    let at = (design.frequency(), design.before_impact_velocity());
    let built = problem.as_built();
    if let Some(width) = built.half_width(machine, Parameter::Frequency) {
        let ends = (at.0 - width, at.0 + width);
        layers.push(stripe(ends, ALLOWED).named("tolerance of the frequency"));
    }
    layers.extend(bands.iter().map(|band| {
        let band = band.iter().map(|[x, low, high]| (*x, [*low, *high]));
        Layer::band(band, style::OPTIMUM, BAND).named("within the tolerances")
    }));
    let high = &design.zone.high;
    let is_border = [TestFunction::Fold, TestFunction::Flip].map(|test| high.is_critical(test));
    let end = (!is_border.contains(&true)).then_some(high.frequency);
    let ends = BORDERS.into_iter().zip(motions.borders);
    let ends = ends.chain([("end of the zone", end)]);
    let ends: Vec<(&str, f64)> = ends
        .filter_map(|(name, at)| Some((name, own(at?))))
        .collect();
    layers.extend(bounds(&ends, BOUND));
    layers.extend(curves.iter().map(|it| it.layer()));
    for it in references {
        let frequency = it.machine.value(Parameter::Frequency);
        let place = frequency.map(|at| (at, it.orbit.before_impact_velocity()));
        layers.push(Layer::marks(place, Mark::Circle, style::REFERENCE).sized(BESIDE_MARK));
        layers.extend(place.map(|place| Layer::label(place, it.title())));
    }
    let mark = Layer::marks([at], Mark::Triangle, style::OPTIMUM);
    layers.push(mark.sized(MARK).named("design"));
    let labels = [machine.label_of(Parameter::Frequency), velocity(machine)];
    let [x, y] = labels.each_ref();
    let panel = Panel::new(Axis::new(x), Axis::new(y).from(0.0), layers);
    let machines = corners.len() * usize::from(!bands.is_empty());
    let caption = caption(machine, at, &ends, machines);
    let title = "How hard the mass strikes over the drive frequency";
    Figure::new(Section::Place, WIDE, title, [panel], caption).with([lines(
        "response",
        "motion",
        [x, y],
        &curves,
    )])
}

fn caption(machine: &Machine, at: (f64, f64), ends: &[(&str, f64)], machines: usize) -> String {
    let [frequency, velocity] = [Dimension::Frequency, Dimension::Velocity];
    let mut caption = format!(
        "The design runs at {} and strikes with {}.",
        quantity(at.0, machine.unit(frequency)),
        quantity(at.1, machine.unit(velocity))
    );
    for (name, end) in ends {
        let away = 100.0 * (end / at.0 - 1.0);
        let side = if away < 0.0 { "below" } else { "above" };
        caption += &format!(" {name} lies {:.1} % {side} that frequency.", away.abs());
    }
    if machines > 0 {
        caption += &format!(
            " The band reaches from the least to the greatest velocity of {machines} machines at the corners of the tolerances, \
             that of the frequency apart, and ends where the first of them has no such motion."
        );
    }
    caption
}

/// Corners of the tolerances at most.
const CORNERS: usize = 64;

/// Machines at corners of the tolerances but that of the drive's frequency.
fn corners(machine: &Machine, study: &ToleranceStudy) -> Vec<Machine> {
    let is_kept = |it: &&AbsoluteTolerance| it.parameter != Parameter::Frequency;
    let all: Vec<AbsoluteTolerance> = study.tolerances.iter().filter(is_kept).copied().collect();
    match Tolerances::new(machine, &all) {
        Ok(spread) if !all.is_empty() => {
            let places = robust::corners(all.len(), CORNERS);
            places.iter().map(|place| spread.machine(place)).collect()
        }
        _ => Vec::new(),
    }
}

/// Frequencies at which a band is computed.
const ACROSS: usize = 240;

/// Frequency with the least and greatest velocity of some machines, where all of them have a stable motion, in the first
/// one's own units; in pieces where one of them has none.
fn bands(problem: &Problem, machines: &[Machine]) -> Vec<Vec<[f64; 3]>> {
    let scenes: Vec<Scene> = machines.iter().map(|it| it.scene.clone()).collect();
    let zones: Result<Vec<Zone>, _> = problem.zones_of(&scenes).into_iter().collect();
    let (Ok(zones), Some(machine)) = (zones, machines.first()) else {
        return Vec::new();
    };
    let all = parallel::map(&zones, |it| ZoneBranches::of(it).refined(it));
    let ends = || all.iter().map(ZoneBranches::range);
    let low = ends().map(|it| it[0]).fold(0.0, f64::max);
    let high = ends().map(|it| it[1]).fold(f64::INFINITY, f64::min);
    let at = |index: usize| {
        let frequency = low + (high - low) * index as f64 / ACROSS as f64;
        let velocities = all.iter().map(|it| it.velocity_at(frequency));
        let velocities: Vec<f64> = velocities.collect::<Option<_>>()?;
        let least = velocities.iter().copied().fold(f64::INFINITY, f64::min);
        let most = velocities.iter().copied().fold(0.0, f64::max);
        Some([machine.to_own(Dimension::Frequency, frequency), least, most])
    };
    pieces(&Vec::from_iter((0..=ACROSS).map(at)))
}
