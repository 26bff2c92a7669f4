//! Special points as curves in two parameters.

use anyhow::anyhow;
use nalgebra::Vector2;
use softstop::Machine;
use softstop_dynamics::Branch;
use softstop_dynamics::continuation::{
    ContinuationSettings, Curve, CurveLimits, CurvePoint, Family, SpecialKind, SpecialPoint,
    follow_special, switch_curves,
};
use softstop_dynamics::orbit::OrbitError;

use super::branches::{STEP, count};
use super::{ContinueArguments, FollowedParameter, family};
use softstop_console::failure::{Failure, check_interrupt};
use softstop_console::progress::Progress;

/// The curves of special points of some branches in two parameters.
pub(super) struct Curves<'a> {
    /// The curves.
    pub found: Vec<Curve>,
    /// The special points that lie on none.
    pub not_followed: Vec<NotFollowed<'a>>,
}

/// A special point that no curve in two parameters could be followed from, and why.
pub(super) struct NotFollowed<'a> {
    /// Drive periods of its orbit.
    pub periods: u64,
    pub special: &'a SpecialPoint,
    pub error: OrbitError,
}

/// Follows the special points of branches, as of the start and doubled ones, in both parameters.
///
/// # Errors
/// [`Failure::Run`] if none of them could be followed.
pub(super) fn curves<'a>(
    machine: &Machine,
    arguments: &ContinueArguments,
    both: [&FollowedParameter; 2],
    branches: &'a [Branch],
) -> Result<Curves<'a>, Failure> {
    let family: &dyn Family<2> = &family(machine, both.map(|one| one.parameter))?;
    let region = CurveLimits {
        ranges: both.map(|one| one.range),
        points: arguments.points,
        settings: ContinuationSettings::of_curves(STEP),
    };
    let bar = Progress::open("points of curves");
    let (mut found, mut not_followed) = (Vec::<Curve>::new(), Vec::new());
    let start = |special: &SpecialPoint| [special.point.parameter, both[1].start];
    let is_on = |(periods, special): (u64, &SpecialPoint), curves: &[Curve]| {
        let mut curves = curves.iter();
        curves.any(|it| is_of(it, &special.kind, periods) && passes(it, start(special)))
    };
    let all = branches.iter().flat_map(|branch| {
        let specials = branch.specials.iter();
        specials.map(|special| (branch.periods, special))
    });
    for (periods, special) in all.filter(|(_, it)| it.kind != SpecialKind::Pitchfork) {
        if is_on((periods, special), &found) {
            continue;
        }
        let kind = (special.kind, special.point.state());
        let start = start(special);
        let curve = follow_special(family, periods, kind, start, &region, |_| count(&bar));
        match curve {
            Ok(curve) => found.push(curve),
            Err(error) => not_followed.push(NotFollowed {
                periods,
                special,
                error,
            }),
        }
    }
    let place = |point: &CurvePoint| Vector2::from(family.scaled_parameters(point.parameters));
    let mut done = 0;
    for _ in 0..arguments.switch {
        let round = done..found.len();
        done = found.len();
        for from in round {
            let is_known = |kind: &SpecialKind, periods, point: &CurvePoint| {
                let mut curves = found.iter();
                curves.any(|it| is_of(it, kind, periods) && has_special(it, point, place))
            };
            let fresh = switch_curves(family, &found[from], &region, is_known, |_| count(&bar));
            for curve in fresh {
                let is_same = |other: &Curve| {
                    let mut specials = curve.specials.iter();
                    is_of(other, &curve.kind, curve.periods)
                        && specials.any(|(_, point)| has_special(other, point, place))
                };
                if !found.iter().any(is_same) {
                    found.push(curve);
                }
            }
        }
    }
    drop(bar);
    check_interrupt()?;
    not_followed.retain(|it: &NotFollowed<'_>| !is_on((it.periods, it.special), &found));
    if found.is_empty() && !not_followed.is_empty() {
        let name = machine.name(both[0].parameter);
        let failed = not_followed
            .iter()
            .map(|NotFollowed { special, error, .. }| {
                let (kind, place) = (special.kind.name(), special.point.parameter);
                format!("no curve of the {kind} at {name} = {place}: {error}")
            });
        let failed: Vec<_> = failed.collect();
        return Err(Failure::Run(anyhow!(failed.join("\n       "))));
    }
    Ok(Curves {
        found,
        not_followed,
    })
}

/// True if a curve is of this kind, with so many drive periods.
fn is_of(curve: &Curve, kind: &SpecialKind, periods: u64) -> bool {
    curve.periods == periods && curve.kind.symbol() == kind.symbol()
}

/// True if a point of codimension two of a curve is this one; `place` scales the parameters of a point.
fn has_special(
    curve: &Curve,
    point: &CurvePoint,
    place: impl Fn(&CurvePoint) -> Vector2<f64>,
) -> bool {
    let mut specials = curve.specials.iter();
    specials.any(|(_, other)| (place(other) - place(point)).norm() <= SAME_POINT)
}

/// Scaled distance of a point of codimension two from itself on another curve: generalised flips are good to a tenth of it.
const SAME_POINT: f64 = 1e-5;

/// True if a curve passes a point.
fn passes(curve: &Curve, [p, q]: [f64; 2]) -> bool {
    let between = |a: f64, b: f64, value: f64| (a - value) * (b - value) <= 0.0;
    let crosses = |pair: &[CurvePoint]| {
        let ([a, c], [b, d]) = (pair[0].parameters, pair[1].parameters);
        if !between(c, d, q) || c == d {
            return false;
        }
        let at = a + (b - a) * (q - c) / (d - c);
        (at - p).abs() < SAME * (b - a).abs().max(SAME * p.abs())
    };
    curve.points.windows(2).any(crosses)
}

/// Share of a step of a curve within which it passes a point.
const SAME: f64 = 0.1;
