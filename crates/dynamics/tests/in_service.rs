//! What a machine does in service: missing strips, run-up, certainty and integrity along the zone.

use rayon::ThreadPoolBuilder;
use softstop::{Machine, RigidStop, Scene, Simulation, Start};
use softstop_dynamics::attractors::{Region, starting_box};
use softstop_dynamics::basin::{
    BasinOptions, BasinTest, ErosionProfile, Establishment, find_basins, zone_box,
};
use softstop_dynamics::figure::Figure;
use softstop_dynamics::missing_strips::{StopWithoutStrip, survives_missing_strips};
use softstop_dynamics::monitor::{stop_if, unmonitored};
use softstop_dynamics::run_up::{Attempt, RunUp, RunUpSettings, Way};
use softstop_dynamics::{Axis, Grid, Orbit, Regime, Zone, orbit, zone};
use softstop_testing::{loaded, unloaded};

fn one(scene: &Scene) -> Orbit {
    orbit::find(scene).expect("z = 1")
}

fn zone_of(scene: &Scene) -> Zone {
    zone::hysteresis(scene).expect("a zone")
}

fn cells(region: &Region, size: usize) -> Grid {
    let ([left, right], [low, high]) = (region.position, region.velocity);
    let axes = (
        Axis::position(left, right, size),
        Axis::velocity(low, high, size),
    );
    Grid::of_states(axes.0, axes.1, 0.0)
}

/// Basins tell all motions apart, by scouts that know none: another way to the same.
#[test]
fn who_comes_home_is_in_the_basin_of_z_1() {
    for scene in [unloaded(1.15), loaded()] {
        let zone = zone_of(&scene);
        let (region, _) = zone_box(&scene, &zone, &unmonitored).expect("a box");
        for place in [0.01, 0.3, 0.6, 0.97] {
            let orbit = zone.orbit_at(place).expect("z = 1");
            let grid = cells(&region, 40);
            let options = BasinOptions::default();
            let found =
                find_basins(&orbit.scene, &grid, &options, &unmonitored, None).expect("basins");
            let starts: Vec<_> = (0..grid.cell_count())
                .map(|cell| grid.start_of_cell(cell).0)
                .collect();
            let reached = BasinTest::of(&orbit).map(|home| home.test_starts(&starts, &unmonitored));
            let reached = reached.expect("computed").expect("not stopped");
            for (cell, reached) in reached.into_iter().enumerate() {
                let class = &found.classes[usize::from(found.cells[cell])];
                let is_one = class.motion.regime() == Some(Regime::ONE);
                assert_eq!(is_one, reached, "s = {place}, cell {cell}");
            }
        }
    }
}

/// docs/paper.md: at A z = 1 takes 54.1 % of |X|, |X'| < 20 at drive angle 0.
#[test]
fn the_certainty_at_a_is_that_of_the_paper_room() {
    let square = Region {
        position: [-20.0, 20.0],
        velocity: [-20.0, 20.0],
    };
    let of =
        |starts| Establishment::within_region(&one(&unloaded(1.15)), &square, starts, &unmonitored);
    let found = of(40_000).expect("computed");
    assert!((found.share - 0.541).abs() < 0.002, "{}", found.share);
    assert!(found.interval[0] < 0.541 && found.interval[1] > 0.541);
    let own = Establishment::of(&one(&unloaded(1.15)), 1000, &unmonitored).expect("computed");
    assert_eq!((own.starts, own.region.position), (1000, [-20.0, 20.0]));
}

/// docs/paper.md: at B an interrupted supply ends no motion.
#[test]
fn b_outlasts_missing_strips() {
    let b = one(&loaded());
    for missing in [0, 1, 2, 5, 25] {
        for reading in [StopWithoutStrip::Near, StopWithoutStrip::Fixed] {
            let found =
                survives_missing_strips(&b, missing, reading, 64, &unmonitored).expect("computed");
            assert_eq!((found.return_share(), found.gaps.len()), (1.0, 64));
            let missed = found.gaps.iter().any(|gap| gap.missed > 0);
            assert!(!missed, "{missing} {reading:?}");
        }
    }
}

/// Beyond the loaded machine's fold nothing is left to come back to; near it long runs end the motion.
#[test]
fn near_the_fold_missing_strips_end_the_motion() {
    let zone = zone_of(&loaded());
    let near = zone.orbit_at(0.995).expect("z = 1");
    let found = survives_missing_strips(&near, 25, StopWithoutStrip::Near, 32, &unmonitored)
        .expect("computed");
    assert!(found.return_share() < 0.5, "{}", found.return_share());
    let lost = found.gaps.iter().filter(|gap| !gap.comes_back);
    assert!(lost.clone().count() > 0 && lost.clone().all(|gap| gap.missed > 3));
}

fn attempt_by(run_up: &RunUp, way: Way) -> &Attempt {
    let mut ways = run_up.ways.iter();
    ways.find(|attempt| attempt.way == way).expect("tried")
}

fn all_ways() -> RunUpSettings {
    RunUpSettings {
        ways: Way::ALL.to_vec(),
        ..RunUpSettings::default()
    }
}

/// A ramp of more than 16,384 periods changes the frequency in steps of several.
#[test]
fn the_slowest_ramps_last_as_long_as_their_rate_says() {
    let orbit = one(&unloaded(1.15));
    for rate in [1e-4, 3e-5, 1e-5] {
        let settings = RunUpSettings {
            ways: vec![Way::FrequencyRaised],
            ramp: Some(rate),
            ..RunUpSettings::default()
        };
        let found = RunUp::of(&orbit, &settings, 1, &unmonitored).expect("computed");
        let attempt = attempt_by(&found, Way::FrequencyRaised);
        let periods = attempt.periods.expect("periods") as f64;
        let asked = (1.15 - 0.5) / rate;
        assert!(
            asked <= periods && periods < asked + 10.0,
            "{rate} {periods}"
        );
    }
}

/// A rigid stop that the motion itself does not reach: from a larger amplitude the mass strikes it on the way.
#[test]
fn a_blow_at_a_rigid_stop_exceeds_every_force_on_the_way() {
    let soft = one(&unloaded(1.15));
    let force = |orbit: &Orbit| Figure::StopForce.of_orbit(orbit).expect("computed");
    let behind = |gap: f64| {
        let travel = soft.max_position + gap - soft.scene.stop_position();
        let rigid = Some(RigidStop {
            travel,
            restitution: 0.6,
        });
        one(&Scene {
            rigid,
            ..unloaded(1.15)
        })
    };
    let clear = behind(0.05);
    assert_eq!(force(&clear), force(&soft));
    let settings = RunUpSettings {
        ways: vec![Way::AmplitudeLowered],
        most_force: Some(1e6),
        ..RunUpSettings::default()
    };
    let found = RunUp::of(&clear, &settings, 1, &unmonitored).expect("computed");
    let attempt = attempt_by(&found, Way::AmplitudeLowered);
    let peaks = attempt.peaks.expect("computed");
    assert_eq!((attempt.share, peaks.stop_force), (1.0, f64::INFINITY));
    assert_eq!(found.working_ways().count(), 0);
}

/// A ramp by a step of the frequency each drive period, against a plain simulation of its periods, one by one.
#[test]
fn the_peaks_of_a_ramp_are_those_of_a_simulation() {
    let orbit = one(&unloaded(1.15));
    let settings = RunUpSettings {
        ways: vec![Way::FrequencyRaised],
        ramp: Some(0.005),
        with_peaks: true,
        ..RunUpSettings::default()
    };
    let found = RunUp::of(&orbit, &settings, 1, &unmonitored).expect("computed");
    let attempt = attempt_by(&found, Way::FrequencyRaised);
    let steps = attempt.periods.expect("periods");
    assert_eq!(steps, 131, "from 0.5 to 1.15");
    let (mut state, mut highest, mut force) = (Start::REST, 0.0_f64, 0.0_f64);
    for step in 0..steps + 64 {
        let share = (step as f64 / (steps - 1) as f64).min(1.0);
        let scene = orbit.scene.at_frequency(0.5 + share * 0.65);
        let mut run = Simulation::new(&scene, state).expect("a scene");
        let period = scene.period();
        for part in 1..=400 {
            run.advance(period * f64::from(part) / 400.0)
                .expect("computed");
            let now = run.sample();
            (highest, force) = (highest.max(now.position), force.max(now.contact_force));
            state = Start::new(now.position, now.velocity);
        }
    }
    let peaks = attempt.peaks.expect("computed");
    assert!(peaks.highest >= highest && peaks.stop_force >= force);
    assert!(
        peaks.highest < highest * 1.001,
        "{} {highest}",
        peaks.highest
    );
    assert!(
        peaks.stop_force < force * 1.01,
        "{} {force}",
        peaks.stop_force
    );
    let bounded = |most| {
        let settings = RunUpSettings {
            most_force: Some(most),
            ..settings.clone()
        };
        RunUp::of(&orbit, &settings, 1, &unmonitored).expect("computed")
    };
    let reaches = attempt.share == 1.0;
    assert_eq!(
        bounded(1.01 * peaks.stop_force).working_ways().count(),
        usize::from(reaches)
    );
    assert_eq!(bounded(0.99 * peaks.stop_force).working_ways().count(), 0);
}

/// The paper: impacts in the hysteresis zone are reached from impacts, not from rest.
#[test]
fn a_and_b_are_run_up_from_impacts() {
    for scene in [unloaded(1.15), loaded()] {
        let run_up = RunUp::of(&one(&scene), &all_ways(), 64, &unmonitored).expect("computed");
        let works: Vec<Way> = run_up.working_ways().map(|attempt| attempt.way).collect();
        let ways = [
            Way::FrequencyRaised,
            Way::ClearanceOpened,
            Way::AmplitudeLowered,
        ];
        assert_eq!(works, ways, "{run_up}");
        assert_eq!(attempt_by(&run_up, Way::SwitchedOn).share, 0.0);
        let lowered = attempt_by(&run_up, Way::FrequencyLowered);
        assert_eq!((lowered.lost, lowered.from), (None, Some(2.3)));
        assert!(
            run_up
                .to_string()
                .starts_with("the motion is reached by raising the frequency")
        );
    }
}

#[test]
fn a_way_says_where_it_loses_the_motion() {
    // A narrow stretch of z = 1 above a gap: at rho = 22, loaded, the flip ends it at 1.016794.
    let mut scene = loaded();
    (scene.clearance, scene.excitation.frequency) = (22.0, 1.005);
    let run_up = RunUp::of(&one(&scene), &all_ways(), 64, &unmonitored).expect("computed");
    for attempt in &run_up.ways {
        let is_lost = attempt.lost.is_some_and(|lost| Some(lost) != attempt.from);
        assert!(attempt.share == 0.0 || !is_lost, "{attempt:?}");
    }
}

#[test]
fn integrity_falls_to_nothing_at_the_fold() {
    let zone = zone_of(&unloaded(1.15));
    let places = ErosionProfile::evenly_spaced_places(5);
    let (region, _) = zone_box(&zone.scene, &zone, &unmonitored).expect("a box");
    let profile = ErosionProfile::of(&zone, &region, (&places, 1024), &unmonitored);
    let profile = profile.expect("computed");
    assert!(profile.region == region && !profile.widened);
    let at = |place: usize| &profile.places[place];
    assert!(at(0).certainty.share > 0.99);
    let grid = cells(&profile.region, 60);
    for place in &profile.places[..4] {
        let orbit = zone.orbit_at(place.place).expect("z = 1");
        assert_eq!(place.velocity, orbit.before_impact_velocity());
        // No cell of a survey lies in the ball but not in the basin, and one just outside of it is lost.
        let options = BasinOptions::default();
        let found = find_basins(&orbit.scene, &grid, &options, &unmonitored, None).expect("basins");
        let largest = found.largest_ball_of(Regime::ONE).expect("a basin").radius;
        assert!(
            place.radius > 0.05 && place.radius < largest + 0.04,
            "{} {largest}",
            place.radius
        );
        let half = [grid.across, grid.up].map(|axis| 0.5 * (axis.range[1] - axis.range[0]));
        for cell in 0..grid.cell_count() {
            let start = grid.start_of_cell(cell).0;
            let gap = [
                start.position - orbit.position,
                start.velocity - orbit.velocity,
            ];
            if (gap[0] / half[0]).hypot(gap[1] / half[1]) < 0.97 * place.radius {
                let class = &found.classes[usize::from(found.cells[cell])];
                assert_eq!(class.motion.regime(), Some(Regime::ONE), "{place:?}");
            }
        }
    }
}

#[test]
fn one_box_tells_the_same_of_a_motion_alone_and_along_its_zone() {
    let a = one(&unloaded(1.15));
    let zone = zone_of(&a.scene);
    let alone = Establishment::of(&a, 512, &unmonitored).expect("computed");
    let width = zone.high.frequency - zone.frequency_g0;
    let place = (a.scene.excitation.frequency - zone.frequency_g0) / width;
    let along = ErosionProfile::of(&zone, &alone.region, (&[place], 512), &unmonitored);
    assert_eq!(
        along.expect("computed").places[0].certainty.share,
        alone.share
    );
    // Of a box that is too small for the motion a wider one is made.
    let small = Region {
        position: [-1.0, 1.0],
        velocity: [-1.0, 1.0],
    };
    let wider = ErosionProfile::of(&zone, &small, (&[0.9], 512), &unmonitored).expect("computed");
    assert!(wider.widened && wider.region.position[1] > a.position.abs());
    assert!(wider.places[0].radius > 0.0);
}

#[test]
fn threads_and_watchers() {
    let all = || {
        let (a, b) = (one(&unloaded(1.15)), one(&loaded()));
        let zone = zone_of(&a.scene);
        let region = starting_box(&a.scene, &unmonitored).expect("a box");
        (
            Establishment::of(&a, 2000, &unmonitored).expect("computed"),
            survives_missing_strips(&b, 3, StopWithoutStrip::Near, 300, &unmonitored)
                .expect("computed"),
            RunUp::of(&a, &RunUpSettings::default(), 32, &unmonitored).expect("computed"),
            ErosionProfile::of(&zone, &region, (&[0.2, 0.8], 700), &unmonitored).expect("computed"),
        )
    };
    let on = |threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("a pool").install(all)
    };
    assert_eq!(on(1), on(3));
    let a = one(&unloaded(1.15));
    let stop = |_, _| stop_if(true);
    assert!(Establishment::of(&a, 10, &stop).is_err());
    assert!(RunUp::of(&a, &RunUpSettings::default(), 4, &stop).is_err());
    assert!(survives_missing_strips(&a, 1, StopWithoutStrip::Fixed, 4, &stop).is_err());
}

#[test]
fn a_box_is_told_in_the_machine_s_own_units() {
    let square = Region {
        position: [-20.0, 20.0],
        velocity: [-23.0, 23.0],
    };
    let machine = Machine::from(unloaded(1.15));
    let told =
        "-20.000000 <= x <= 20.000000 m and -23.000000 <= x' <= 23.000000 m/s at drive angle phi";
    assert_eq!(square.describe(&machine), told);
}
