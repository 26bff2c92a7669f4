//! Basins against the scalar engine and against what is known of the machine.

mod along_parameter;

use std::sync::atomic::{AtomicU64, Ordering};

use nalgebra::Vector2;
use rayon::ThreadPoolBuilder;
use softstop::{Clock, Ratios, Scene, Start};
use softstop_dynamics::attractors::{SearchOptions, find_attractors, starting_box};
use softstop_dynamics::basin::{
    BasinOptions, Establishment, establishing_certainties, find_basins,
};
use softstop_dynamics::monitor::{stop_if, unmonitored};
use softstop_dynamics::orbit::{OrbitError, find};
use softstop_dynamics::{Axis, Basins, Grid, Orbit, Regime, StroboscopicMap, zone};
use softstop_testing::tolerance::{DIFFERENCED, SOLVED};
use softstop_testing::{assert_near, hertz, is_near, loaded, rigid_stop, unloaded, with_changes};

const NONE: Regime = Regime {
    impacts: 0,
    periods: 1,
};
const ONE: Regime = Regime {
    impacts: 1,
    periods: 1,
};

fn states(size: usize) -> Grid {
    Grid::of_states(
        Axis::position(-25.0, 20.0, size),
        Axis::velocity(-30.0, 30.0, size),
        0.0,
    )
}

fn on(scene: &Scene, grid: &Grid) -> Basins {
    let found = find_basins(scene, grid, &BasinOptions::default(), &unmonitored, None)
        .expect("there is one");
    assert_eq!(found.cells.len(), grid.cell_count());
    let cells: usize = found.classes.iter().map(|class| class.starts).sum();
    assert_eq!(cells, grid.cell_count());
    found
}

fn names(basins: &Basins) -> Vec<String> {
    basins
        .classes
        .iter()
        .map(|class| class.motion.to_string())
        .collect()
}

/// The orbits of all classes.
fn orbits(basins: &Basins) -> Vec<&Orbit> {
    let orbits = basins.classes.iter().map(|class| class.orbit.as_deref());
    orbits.map(|orbit| orbit.expect("an orbit")).collect()
}

/// The class on whose orbit the scalar engine ends.
fn by_scalar(scene: &Scene, basins: &Basins, cell: usize) -> usize {
    let (start, angle) = basins.grid.start_of_cell(cell);
    let mut turned = scene.clone();
    turned.excitation.phase = angle;
    let wait = (-angle).rem_euclid(std::f64::consts::TAU) / turned.excitation.frequency;
    let mut motion = turned.motion(start).expect("there is one");
    let clock = Clock::new(turned.excitation.frequency, angle);
    let at = clock.instant(wait + 250.0 * scene.period());
    motion.advance(at, &mut ()).expect("there is one");
    let end = Vector2::from([motion.state().position, motion.state().velocity]);
    let near = |orbit: &&Orbit| (orbit.state() - end).norm() < 1e-3;
    orbits(basins).iter().position(near).expect("there is one")
}

/// Far from the stop the motion is linear. Its multipliers have modulus exp(-2 pi beta / eta), 0.981 here, so that after the usual
/// transient no start has come within the distance of a return; it rises to 1 without damping, where none ever settles. Each cell
/// counts once.
#[test]
fn cells_that_settle_slowly_settle() {
    let named = |damping: &str| {
        let scene = with_changes("unloaded", &format!("{damping} eta=2.57 clearance=11.6"));
        let most = AtomicU64::new(0);
        let monitor = |done, all| {
            assert!(done <= all && all == 400, "{done} of {all}");
            most.fetch_max(done, Ordering::Relaxed);
            stop_if(false)
        };
        let options = BasinOptions::default();
        let found = find_basins(&scene, &states(20), &options, &monitor, None).expect("computed");
        assert_eq!(most.into_inner(), 400);
        names(&found)
    };
    assert_eq!(named("damping=0.008"), ["z = 0"]);
    let undamped = named("damping=0");
    assert!(
        undamped.iter().any(|it| !it.starts_with('z')),
        "{undamped:?}"
    );
}

#[test]
fn every_cell_is_where_the_scalar_engine_ends() {
    let scene = unloaded(1.15);
    let found = on(&scene, &states(40));
    assert_eq!(names(&found), ["z = 0", "z = 1"]);
    for (cell, class) in found.cells.iter().enumerate() {
        assert_eq!(
            by_scalar(&scene, &found, cell),
            usize::from(*class),
            "cell {cell}"
        );
    }
}

#[test]
fn planes_with_a_drive_angle_are_where_the_scalar_engine_ends() {
    let scene = unloaded(1.15);
    let turn = std::f64::consts::TAU;
    for (across, up) in [
        (Axis::angle(0.0, turn, 16), Axis::velocity(-25.0, 25.0, 16)),
        (
            Axis::position(-20.0, 10.0, 16),
            Axis::angle(-turn, turn, 16),
        ),
    ] {
        let state = Start::new(3.0, -2.0);
        let grid = Grid {
            state,
            ..Grid::of_states(across, up, 0.3)
        };
        let found = on(&scene, &grid);
        assert_eq!(names(&found), ["z = 0", "z = 1"]);
        for (cell, class) in found.cells.iter().enumerate() {
            assert_eq!(
                by_scalar(&scene, &found, cell),
                usize::from(*class),
                "cell {cell}"
            );
        }
    }
}

#[test]
fn z_1_has_all_below_grazing_and_nothing_beyond_the_fold() {
    // g0 = 1.04444, s_SN = 1.369036.
    let below = on(&unloaded(1.02), &states(24));
    assert_eq!(below.regime_share(ONE).0, 1.0);
    // Just below g0 some starts lead to an isolated motion, none to rest.
    let near = on(&unloaded(1.043), &states(24));
    assert_eq!(names(&near), ["z = 1", "z = 3/4"]);
    assert!(near.regime_share(ONE).0 > 0.95 && near.regime_share(NONE).0 == 0.0);
    let beyond = on(&unloaded(1.4), &states(24));
    assert_eq!(beyond.regime_share(ONE).0, 0.0);
    assert_eq!(beyond.regime_share(NONE).0, 1.0);
}

#[test]
fn threads_change_nothing() {
    let scene = unloaded(1.2);
    let grid = states(80);
    let with = |threads| {
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("there is one");
        pool.install(|| on(&scene, &grid))
    };
    assert_eq!(with(1), with(2));
}

#[test]
fn chaos_is_one_set_beside_the_isolated_motions() {
    // Peterka 2003, section 4: at 0.9875 chaos, 2/3 and (2/4)B.
    let found = on(&unloaded(0.9875), &states(24));
    assert_eq!(names(&found), ["z = 2/3", "z = 2/4", "chaos"]);
    let order = found.classes[1].motion.order().expect("an order");
    assert_eq!(order.to_string(), "1-1-0-0");
}

#[test]
fn cells_in_a_basin_go_to_its_orbit_and_the_largest_ball_is_inside() {
    let scene = unloaded(1.15);
    let found = on(&scene, &states(60));
    let ball = found.largest_ball(1).expect("there is one");
    let map = StroboscopicMap::new(&scene.check().expect("there is one"), 250);
    let orbit = orbits(&found)[1];
    for k in 0..12 {
        let (sin, cos) = (f64::from(k) * std::f64::consts::FRAC_PI_6).sin_cos();
        let within = 0.9 * ball.radius;
        let state = Vector2::new(
            ball.centre[0] + within * 22.5 * cos,
            ball.centre[1] + within * 30.0 * sin,
        );
        assert_near(
            (map.image(state).expect("there is one") - orbit.state()).norm(),
            0.0,
            DIFFERENCED,
        );
    }
    assert!(ball.radius > 0.02 && ball.radius < 1.0, "{ball:?}");
    assert_eq!(found.largest_ball(2), None);
}

#[test]
fn the_certainty_falls_along_the_zone() {
    let zone = zone::hysteresis(&Ratios::unloaded().scene().expect("valid")).expect("there is one");
    let places = [0.0, 0.25, 0.5, 0.75, 0.98];
    let found = establishing_certainties(
        &zone,
        &places,
        &states(30),
        &BasinOptions::default(),
        &unmonitored,
        None,
    )
    .expect("there is one");
    let shares: Vec<f64> = found.iter().map(|place| place.certainty).collect();
    // The paper says from 1 at g0 to 0 at s_SN. A few starts at g0 lead to z = 3/4, and near the fold a share
    // above zero is left; in between the certainty hardly falls.
    assert!(shares[0] > 0.98 && shares[1] < 0.75, "{shares:?}");
    assert!(is_near(shares[2], shares[1], 0.15), "{shares:?}");
    assert!(
        shares[4] > 0.02 && shares[4] < 0.5 * shares[3],
        "{shares:?}"
    );
    assert!(
        found
            .iter()
            .all(|place| place.interval[0] <= place.certainty)
    );
}

#[test]
fn whether_a_share_is_enough_is_told_without_counting_all_starts() {
    let zone = zone::hysteresis(&loaded()).expect("it has one");
    let orbit = zone.orbit_at(0.8).expect("it is stable");
    let region = starting_box(&orbit.scene, &unmonitored).expect("there is one");
    let counted = Establishment::within_region(&orbit, &region, 700, &unmonitored);
    let share = counted.expect("it is computed").share;
    assert!(0.1 < share && share < 0.9, "{share}");
    for (least, expected) in [
        (0.0, true),
        (share, true),
        (share + 1e-3, false),
        (2.0, false),
    ] {
        let is_enough = |it: &Establishment| it.share >= least;
        let told =
            Establishment::is_enough_within_region(&orbit, &region, 700, is_enough, &unmonitored);
        assert_eq!(told.expect("it is computed"), expected, "{least} {share}");
    }
}

/// The box is wider than its least by what the hardest z = 1 needs, which few starts come to near the fold, if any.
#[test]
fn the_box_of_starts_holds_the_hardest_motion_with_room() {
    let mut widened = 0;
    for scene in [unloaded(1.15), loaded()] {
        for clearance in [2.0, 6.0, 10.0, 14.0] {
            let zone = zone::hysteresis(&Scene {
                clearance,
                ..scene.clone()
            })
            .expect("it has one");
            for place in [0.1, 0.5, 0.9, 0.97] {
                let scene = zone.scene_at(place);
                let hardest = find(&scene).expect("there is one");
                let region = starting_box(&scene, &unmonitored).expect("there is one");
                let needed = [hardest.position, hardest.velocity].map(|it| 1.5 * it.abs());
                let sides = [region.position, region.velocity];
                for (needed, side) in needed.into_iter().zip(sides) {
                    assert!(needed <= side[1] * (1.0 + SOLVED), "{clearance} {place}");
                    widened += usize::from(is_near(needed, side[1], SOLVED));
                }
            }
        }
    }
    assert!(widened > 16, "{widened}");
}

/// A strip that stops the mass at one amplitude and is pierced at another: both motions are z = 1, and few starts come to the softer.
#[test]
fn the_box_of_starts_holds_both_of_two_single_impact_motions() {
    let strip = "piercing.stiffness=13.78 piercing.friction=10.722 piercing.thickness=0.40456 piercing.travel=0.1276";
    let own = "damping=0.0266 contact.damping=0.032 clearance=2 excitation.frequency=1.2405";
    let scene = Scene {
        stop: hertz(79.56, 2.5677, 0.1151),
        ..with_changes("loaded", &format!("{own} {strip}"))
    };
    let region = starting_box(&scene, &unmonitored).expect("there is one");
    let options = SearchOptions {
        starts: 256,
        region: Some(region),
        ..SearchOptions::default()
    };
    let found = find_attractors(&scene, &options, &unmonitored).expect("motions");
    let orbits = found.attractors.iter().filter_map(|it| it.orbit.as_ref());
    let singles: Vec<_> = orbits.filter(|orbit| orbit.regime() == ONE).collect();
    assert_eq!(singles.len(), 2);
    for orbit in &singles {
        assert!(1.5 * orbit.velocity.abs() <= region.velocity[1] * (1.0 + SOLVED));
        assert!(1.5 * orbit.position.abs() <= region.position[1] * (1.0 + SOLVED));
    }
    let hardest = find(&scene).expect("there is one");
    let velocities = singles.iter().map(|orbit| orbit.before_impact_velocity());
    let harder = velocities.fold(0.0, f64::max);
    assert_near(hardest.before_impact_velocity(), harder, SOLVED);
    let needed = 1.5 * hardest.velocity.abs();
    assert_near(region.velocity[1], needed, SOLVED);
}

/// The orbit of a machine without damping neither attracts nor repels: what is told at once is what counting all starts gives.
#[test]
fn nothing_comes_to_a_neutral_orbit() {
    let scene = Scene {
        damping: 0.0,
        contact_damping: 0.0,
        ..unloaded(1.15)
    };
    let orbit = find(&scene).expect("there is one");
    let region = starting_box(&orbit.scene, &unmonitored).expect("there is one");
    let counted = Establishment::within_region(&orbit, &region, 64, &unmonitored);
    assert_eq!(counted.expect("it is computed").share, 0.0);
    let is_half = |it: &Establishment| it.share >= 0.5;
    let told = Establishment::is_enough_within_region(&orbit, &region, 64, is_half, &unmonitored);
    assert_eq!(told, Ok(false));
}

#[test]
fn it_stops_when_told() {
    let stopped = find_basins(
        &unloaded(1.15),
        &states(80),
        &BasinOptions::default(),
        &|done, all| {
            assert!(done <= all && all == 6400);
            stop_if(done >= 1000)
        },
        None,
    );
    assert_eq!(stopped, Err(OrbitError::Stopped));
}

#[test]
fn cells_that_cannot_be_are_lost() {
    let mut ratios = Ratios::unloaded();
    ratios.rigid = Some(rigid_stop(2.0, 0.6));
    let found = on(&ratios.scene().expect("there is one"), &states(24));
    let beyond = (0..found.grid.cell_count())
        .filter(|cell| found.grid.start_of_cell(*cell).0.position > 12.0);
    let lost = found.classes.last().expect("there is one");
    assert_eq!(lost.motion.to_string(), "lost");
    assert_eq!(lost.starts, beyond.count());
}
