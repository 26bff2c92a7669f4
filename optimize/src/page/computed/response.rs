//! The before-impact velocity over the drive's frequency.

use rayon::prelude::*;
use softstop::{Dimension, Machine, Parameter, Scene};
use softstop_console::interrupt;
use softstop_dynamics::{BranchPoint, Zone, zone};

use super::{Motions, is_shown, label_of, refined, velocity};
use crate::design::Design;
use crate::optimize::reference::Reference;
use crate::page::data::{Curve, Response, Role};

/// The motions of the design's machine, and those of references. No tolerance.
pub fn response(design: &Design, beside: &[Reference]) -> Response {
    let machine = &design.machine;
    let own = |frequency: f64| machine.to_own(Dimension::Frequency, frequency);
    let motions = Motions::of(&design.zone);
    let mut curves = stable(
        machine,
        &design.zone,
        &motions,
        "design, stable",
        Role::Design,
    );
    let unstable = motions.above.chunk_by(|a, b| is_lost(a) && is_lost(b));
    curves.extend(unstable.filter(|piece| piece.len() > 1).map(|piece| Curve {
        name: "design, unstable".to_owned(),
        role: Role::Unstable,
        points: points(machine, &refined(&design.zone.scene, piece)),
    }));
    for reference in beside {
        let other = &reference.machine;
        if let Ok(zone) = zone::hysteresis_watched(&other.scene, &interrupt::watch) {
            curves.extend(stable(
                other,
                &zone,
                &Motions::of(&zone),
                &reference.title(),
                Role::Beside,
            ));
        }
    }
    let mut ends = vec![
        ("g₀".to_owned(), own(design.zone.frequency_g0)),
        ("s_SN".to_owned(), own(design.zone.frequency_sn)),
    ];
    ends.extend(motions.flip.map(|flip| ("s_PD".to_owned(), own(flip))));
    Response {
        x: label_of(machine, Parameter::Frequency),
        y: velocity(machine),
        curves,
        ends,
        design: [design.frequency(), design.before_impact_velocity()],
        tolerance: None,
        bands: Vec::new(),
        machines: 0,
    }
}

/// Frequencies at which a band is computed.
const ACROSS: usize = 240;

/// Least and greatest velocity of some machines over the frequencies at which all of them have a stable motion, in the
/// first one's own units; in pieces where one of them has none.
pub fn bands(machines: &[Machine]) -> Vec<Vec<[f64; 3]>> {
    let scenes: Vec<Scene> = machines.iter().map(|it| it.scene.clone()).collect();
    let zones = zone::hysteresis_soon(&scenes, &interrupt::watch);
    let zones: Result<Vec<Zone>, _> = zones.into_iter().collect();
    let (Ok(zones), Some(machine)) = (zones, machines.first()) else {
        return Vec::new();
    };
    let all: Vec<Motions> = zones
        .par_iter()
        .map(|it| Motions::of(it).refined(it))
        .collect();
    let low = all.iter().map(|it| it.range()[0]).fold(0.0, f64::max);
    let high = all
        .iter()
        .map(|it| it.range()[1])
        .fold(f64::INFINITY, f64::min);
    let at = |index: usize| {
        let frequency = low + (high - low) * index as f64 / ACROSS as f64;
        let velocities = all.iter().map(|it| it.velocity_at(frequency));
        let velocities: Vec<f64> = velocities.collect::<Option<_>>()?;
        let least = velocities.iter().copied().fold(f64::INFINITY, f64::min);
        let most = velocities.iter().copied().fold(0.0, f64::max);
        Some([machine.to_own(Dimension::Frequency, frequency), least, most])
    };
    let points: Vec<Option<[f64; 3]>> = (0..=ACROSS).map(at).collect();
    let pieces = points.split(Option::is_none);
    let pieces = pieces.map(|piece| piece.iter().copied().flatten().collect::<Vec<_>>());
    pieces.filter(|piece| piece.len() > 1).collect()
}

/// Unstable, or a fold, where an unstable piece begins.
fn is_lost(point: &BranchPoint) -> bool {
    !point.is_stable() || point.fold_test().abs() < 1e-6
}

/// The stable motions of a zone and below it.
fn stable(machine: &Machine, zone: &Zone, motions: &Motions, name: &str, role: Role) -> Vec<Curve> {
    let above = motions.above.chunk_by(|a, b| is_shown(a) && is_shown(b));
    let below = motions.below.chunk_by(|a, b| is_shown(a) && is_shown(b));
    let pieces = below.chain(above).filter(|piece| piece.len() > 1);
    let curve = |piece: &[BranchPoint]| Curve {
        name: name.to_owned(),
        role,
        points: points(machine, &refined(&zone.scene, piece)),
    };
    pieces.map(curve).collect()
}

fn points(machine: &Machine, piece: &[BranchPoint]) -> Vec<[f64; 2]> {
    let own = |frequency: f64| machine.to_own(Dimension::Frequency, frequency);
    piece
        .iter()
        .map(|point| [own(point.parameter), point.before_impact_velocity()])
        .collect()
}
