//! Orbits between two stops, against a closed form.

mod grazing;

use std::f64::consts::PI;

use crate::branches::{self, go_on};
use crate::continuation::outgrown::Outgrown;
use nalgebra::{Complex, Matrix2, Vector2};
use softstop::{Below, Parameter, Release, Scene, Start, Stop};
use softstop_dynamics::continuation::{BranchEnd, SpecialKind};
use softstop_dynamics::figure::Figure;
use softstop_dynamics::orbit::{StroboscopicMap, multipliers};
use softstop_dynamics::{
    BranchLimits, Continuation, CycleMetrics, Orbit, ParameterFamily, derivatives, zone,
};
use softstop_testing::assert_near;

/// The orbit with one impact at each of two rigid stops at +-d, x(t + T/2) = -x(t) (Shaw 1985, J. Appl. Mech. 52): half a
/// period after an impact at d with the velocity V the mass hits the other stop with -V. With P the transition of the free
/// motion y over half a period and g = -(1 + R) (P + 1)^-1 (0, 1) it begins with y = V g, and the harmonic motion h = x - y has
/// the amplitude A:
///
/// ```text
/// (d - V g1)^2 + (V (R + g2) / w)^2 = A^2
/// ```
struct Symmetric {
    velocity: f64,
    /// The free motion right after the impact above.
    free: Vector2<f64>,
    /// The drive angle then.
    angle: f64,
    /// Jacobian of the map over half a period, from right after one impact to right after the other.
    half: Matrix2<f64>,
    /// Of the map over a whole period.
    multipliers: [Complex<f64>; 2],
}

impl Symmetric {
    fn of(scene: &Scene, larger: bool) -> Self {
        let Stop::Rigid { restitution: r } = scene.stop else {
            panic!("a rigid stop");
        };
        let (m, b, k, d) = (scene.mass, scene.damping, scene.stiffness, scene.clearance);
        let (w, force) = (scene.excitation.frequency, scene.excitation.amplitude);
        let half = transition(b / m, k / m, PI / w);
        let back = (half + Matrix2::identity()).try_inverse().expect("regular");
        let g = back * Vector2::new(0.0, -(1.0 + r));
        let response = force / Complex::new(k - m * w * w, b * w);
        let rate = (r + g.y) / w;
        let square = g.x * g.x + rate * rate;
        let root = (square * response.norm_sqr() - d * d * rate * rate).sqrt();
        let velocity = (d * g.x + if larger { root } else { -root }) / square;
        let free = velocity * g;
        // h = Re(response e^(i angle)), h' = -w Im(...).
        let harmonic = Complex::new(d - free.x, (r * velocity + free.y) / w);
        let angle = (harmonic / response).arg();
        let push = force * angle.cos() - k * d;
        let (before, after) = ((push - b * velocity) / m, (push + b * r * velocity) / m);
        let saltation = Matrix2::new(-r, 0.0, (after + r * before) / velocity, -r);
        Self {
            velocity,
            free,
            angle,
            half: saltation * half,
            multipliers: multipliers(&(saltation * half)).map(|one| one * one),
        }
    }

    /// The scene with time 0 an eighth of a period after the impact above, and the state there.
    fn begin(&self, scene: &Scene) -> (Scene, Vector2<f64>) {
        let (m, b, k) = (scene.mass, scene.damping, scene.stiffness);
        let w = scene.excitation.frequency;
        let angle = self.angle + 0.25 * PI;
        let response = scene.excitation.amplitude / Complex::new(k - m * w * w, b * w);
        let harmonic = response * Complex::from_polar(1.0, angle);
        let free = transition(b / m, k / m, 0.25 * PI / w) * self.free;
        let mut scene = scene.clone();
        scene.excitation.phase = angle;
        (scene, free + Vector2::new(harmonic.re, -w * harmonic.im))
    }
}

/// exp(t A) of x'' = -b x' - k x, by its eigenvalues.
fn transition(b: f64, k: f64, t: f64) -> Matrix2<f64> {
    let root = Complex::new(0.25 * b * b - k, 0.0).sqrt();
    let [one, other] = [root, -root].map(|root| root - 0.5 * b);
    let (a, c) = ((one * t).exp(), (other * t).exp());
    let over = (one - other).inv();
    let of = |value: Complex<f64>| (value * over).re;
    Matrix2::new(
        of(one * c - other * a),
        of(a - c),
        of(one * other * (c - a)),
        of(one * a - other * c),
    )
}

fn machine(stiffness: f64, damping: f64, frequency: f64, restitution: f64) -> Scene {
    let stop = Stop::Rigid { restitution };
    let mut scene = Scene {
        stiffness,
        damping,
        clearance: 0.5,
        below: Some(Box::new(Below {
            clearance: 0.5,
            stop: stop.clone(),
        })),
        ..Scene::of_stop(stop)
    };
    scene.excitation.frequency = frequency;
    scene
}

/// A rattle, a free mass between two stops, and suspended masses.
fn machines() -> [Scene; 5] {
    [
        machine(0.0, 0.05, 1.0, 0.6),
        machine(0.0, 0.3, 0.8, 0.8),
        machine(1.0, 0.04, 1.8, 0.8),
        machine(1.0, 0.1, 0.9, 0.7),
        machine(4.0, 0.2, 2.2, 0.5),
    ]
}

#[test]
fn symmetric_orbits_and_their_multipliers_have_a_closed_form() {
    for scene in machines() {
        let exact = Symmetric::of(&scene, true);
        let (scene, state) = exact.begin(&scene);
        let beside = state + 1e-4 * Vector2::new(1.0, -1.0);
        let orbit = Orbit::find_periodic(&scene, beside, 1).expect("an orbit");
        assert_eq!((orbit.periods, orbit.impacts.len()), (1, 2), "{scene:?}");
        assert_near(orbit.position, state.x, 1e-11);
        assert_near(orbit.velocity, state.y, 1e-11);
        for velocity in orbit.before_impact_velocities() {
            assert_near(velocity, exact.velocity, 1e-11);
        }
        let found = orbit.monodromy.multipliers();
        for (one, other) in [(0, 0), (1, 1)] {
            let near = [exact.multipliers[other], exact.multipliers[1 - other]];
            let apart = near.map(|near| (found[one] - near).norm());
            assert!(
                apart[0].min(apart[1]) < 1e-9 * found[0].norm().max(1.0),
                "{found:?} {:?}",
                exact.multipliers
            );
        }
    }
}

#[test]
fn a_branch_keeps_to_the_closed_form() {
    let scene = machine(1.0, 0.04, 1.8, 0.8);
    let exact = Symmetric::of(&scene, true);
    let (scene, state) = exact.begin(&scene);
    let family = ParameterFamily::new(scene.clone(), [Parameter::Frequency]).expect("a parameter");
    let branch = branches::follow(&family, 1, (1.8, state), (1.6, 2.2), 500).expect("a branch");
    let both = branch
        .points
        .iter()
        .filter(|point| point.impacts.len() == 2);
    let points: Vec<_> = both.collect();
    assert!(points.len() > 10, "{}", points.len());
    for point in points {
        let at = scene.at_frequency(point.parameter);
        let near = |larger: bool| (Symmetric::of(&at, larger).velocity - point.impacts[0]).abs();
        assert!(near(true).min(near(false)) < 1e-9, "{point:?}");
        assert_near(point.impacts[0], point.impacts[1], 1e-9);
    }
}

/// The frequency between two at which half a round and a mirror have a multiplier -1, half a round a multiplier 1: bisection of
/// the closed form.
fn pitchfork(scene: &Scene, (mut low, mut high): (f64, f64)) -> f64 {
    let test = |frequency: f64| {
        let half = Symmetric::of(&scene.at_frequency(frequency), true).half;
        1.0 - half.trace() + half.determinant()
    };
    let begins = test(low);
    assert!(begins * test(high) < 0.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        match test(middle) * begins > 0.0 {
            true => low = middle,
            false => high = middle,
        }
    }
    0.5 * (low + high)
}

#[test]
fn branches_pass_pitchforks_and_asymmetric_orbits_come_out_of_them() {
    let ranges = [(1.3, 2.0), (1.3, 2.0), (1.4, 2.0), (1.4, 2.0), (1.8, 2.3)];
    for (scene, range) in machines().into_iter().zip(ranges) {
        let exact = pitchfork(&scene, range);
        let from = range.1 - 0.01;
        let (scene, state) =
            Symmetric::of(&scene.at_frequency(from), true).begin(&scene.at_frequency(from));
        let family =
            ParameterFamily::new(scene.clone(), [Parameter::Frequency]).expect("a parameter");
        let limits = BranchLimits { range, points: 500 };
        let continuation = Continuation::new(&family, 1)
            .with_steps(0.05)
            .expect("valid");
        let branch = continuation
            .branch(from, state, &limits, go_on)
            .expect("a branch");
        let kinds: Vec<_> = branch.specials.iter().map(|special| special.kind).collect();
        let found = branch
            .specials
            .iter()
            .find(|special| special.kind == SpecialKind::Pitchfork);
        let found = found.unwrap_or_else(|| panic!("{kinds:?} {:?}", branch.ends));
        assert_near(found.point.parameter, exact, 1e-10);
        let beyond = branch
            .points
            .iter()
            .filter(|point| point.parameter < exact - 1e-3);
        let beyond: Vec<_> = beyond.collect();
        assert!(beyond.len() > 3, "{kinds:?} {:?}", branch.ends);
        for point in beyond {
            assert!(!point.is_stable());
            let symmetric = Symmetric::of(&scene.at_frequency(point.parameter), true);
            assert_near(point.impacts[0], symmetric.velocity, 1e-9);
            assert_near(point.impacts[1], symmetric.velocity, 1e-9);
        }
        let asymmetric = continuation
            .branch_asymmetric(&found.point, &limits, go_on)
            .expect("a branch");
        assert!(matches!(asymmetric.ends.0, BranchEnd::Symmetric));
        let outgrown = Outgrown(family.clone());
        let same = Continuation::new(&outgrown, 1).branch_asymmetric(&found.point, &limits, go_on);
        let same = same.expect("a branch");
        assert_near(same.points[0].parameter, exact, 1e-2);
        let first = &asymmetric.points[0];
        assert_near(first.parameter, exact, 1e-2);
        // They are stable where the symmetric orbits no longer are.
        assert_eq!(first.is_stable(), first.parameter < exact, "{first:?}");
        let at = scene.at_frequency(first.parameter);
        let motion = at.trajectory(Start::new(first.position, first.velocity), 1);
        let motion = motion.expect("a motion");
        let times: Vec<f64> = motion
            .impacts()
            .map(|it| motion.clock.time(it.instant))
            .collect();
        let share = (times[1] - times[0]) / at.period();
        assert!((share - 0.5).abs() > 1e-4, "{share}");
        let there = asymmetric
            .points
            .iter()
            .filter(|point| point.impacts.len() == 2);
        assert!(there.count() > 3, "{:?}", asymmetric.ends);
    }
}

/// Impacts that pass drive angle 0 end no branch: whatever that angle is, the asymmetric motions go on to the same graze.
#[test]
fn asymmetric_branches_do_not_depend_on_the_drive_angle() {
    let scene = softstop::Machine::from_toml(include_str!("../../../docs/scenes/two-sided.toml"));
    let scene = scene.expect("a machine").scene.at_frequency(1.9);
    let limits = BranchLimits {
        range: (1.2, 2.0),
        points: 500,
    };
    let ends = (0..16).map(|index| {
        let mut scene = scene.clone();
        scene.excitation.phase = f64::from(index) * std::f64::consts::TAU / 16.0;
        let map = StroboscopicMap::new(&scene.check().expect("valid"), 500);
        let settled = map.apply(Vector2::new(0.0, 1.0));
        let state = settled.expect("a motion").end;
        let family = ParameterFamily::new(scene, [Parameter::Frequency]).expect("a parameter");
        let continuation = Continuation::new(&family, 1);
        let branch = continuation.branch(1.9, state, &limits, go_on);
        let specials = branch.expect("a branch").specials.into_iter();
        let mut pitchforks = specials.filter(|it| it.kind == SpecialKind::Pitchfork);
        let found = pitchforks.next().expect("a pitchfork").point;
        let asymmetric = continuation.branch_asymmetric(&found, &limits, go_on);
        let asymmetric = asymmetric.expect("asymmetric orbits");
        asymmetric.points.last().expect("points").parameter
    });
    for end in ends {
        assert_near(end, 1.266_048_034_127, 1e-9);
    }
}

#[test]
fn orbits_change_with_the_stop_below_as_differences_say() {
    let (scene, state) = Symmetric::of(&machines()[2], true).begin(&machines()[2]);
    let orbit = Orbit::find_periodic(&scene, state, 1).expect("an orbit");
    for parameter in [
        Parameter::BelowClearance,
        Parameter::BelowRestitution,
        Parameter::Clearance,
    ] {
        let slopes = derivatives::differentiate_orbit(&orbit, &[parameter]).expect("slopes");
        let moved = |by: f64| {
            let mut moved = scene.clone();
            parameter.set(&mut moved, parameter.get(&scene).expect("it has it") + by);
            let orbit = Orbit::find_periodic(&moved, orbit.state(), 1).expect("an orbit");
            let first = orbit.before_impact_velocities().next();
            first.expect("an impact")
        };
        let difference = (moved(1e-5) - moved(-1e-5)) / 2e-5;
        let slope = slopes.impacts[0].velocity.by[0];
        assert_near(slope, difference, 1e-6);
    }
}

#[test]
fn what_zones_ask_for_is_refused_by_name() {
    let error = zone::hysteresis(&machine(1.0, 0.04, 1.8, 0.8)).expect_err("no zone");
    assert!(error.to_string().contains("stop.below"), "{error}");
    let error = zone::stable_ranges(&machine(1.0, 0.04, 1.8, 0.8)).expect_err("no ranges");
    assert!(error.to_string().contains("stop.below"), "{error}");
}

#[test]
fn of_two_stops_the_one_pressed_farther_tells_the_deflection() {
    let soft = |stiffness| Stop::KelvinVoigt {
        stiffness,
        release: Release::Clearance,
    };
    let [hard, weak] = [soft(200.0), soft(20.0)];
    let deflection = |above: &Stop, below: &Stop| {
        let mut scene = machine(1.0, 0.2, 1.8, 0.8);
        (scene.stop, scene.contact_damping) = (above.clone(), 0.5);
        scene.below.as_mut().expect("a stop below").stop = below.clone();
        let settled = scene
            .trajectory(Start::new(0.0, 1.0), 300)
            .expect("a motion")
            .end;
        let orbit = Orbit::find_periodic(&scene, settled.into(), 1).expect("an orbit");
        let metrics = CycleMetrics::of(&orbit).expect("metrics");
        let figure = Figure::StopDeflection.of_motion(&orbit, &metrics);
        let pressed = [metrics.highest - 0.5, -metrics.lowest - 0.5];
        (figure.expect("of the motion"), pressed)
    };
    let (figure, [above, below]) = deflection(&hard, &weak);
    assert!(below > 2.0 * above && above > 0.0, "{above} {below}");
    assert_near(figure, below, 1e-15);
    let (mirrored, _) = deflection(&weak, &hard);
    assert_near(mirrored, figure, 1e-9);
}
