//! Figures of one period of a motion: against many points of the same motion, and the energy balance.

use proptest::prelude::*;
use softstop::internals::Phase;
use softstop::{Arc, Clock, Observer, PhaseKind, Ratios, Scene, Simulation};
use softstop_dynamics::cycle_metrics::Losses;
use softstop_dynamics::{CycleMetrics, Orbit, Regime, orbit};
use softstop_testing::machines::{machines, start_below};
use softstop_testing::{assert_near, cases, loaded, rigid_stop, unloaded};

/// What many points of a period show.
#[derive(Default)]
struct SettledMotion {
    lowest: f64,
    highest: f64,
    force: f64,
    power: f64,
    amplitude: f64,
    stiffness: f64,
}

/// Points of an arc.
const POINTS: u32 = 400;

impl Observer for SettledMotion {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        for point in 0..=POINTS {
            let after = elapsed * f64::from(point) / f64::from(POINTS);
            let state = arc.at(after);
            self.lowest = self.lowest.min(state.position);
            self.highest = self.highest.max(state.position);
            let drive = self.amplitude * arc.drive(after).cos;
            let held = match arc.kind {
                PhaseKind::Stuck | PhaseKind::Resting => drive - self.stiffness * state.position,
                _ => 0.0,
            };
            let force = |phase: &Phase| phase.contact_force(state.position, state.velocity);
            self.force = self.force.max(arc.phase.map_or(held, force));
            self.power = self.power.max(drive * state.velocity);
        }
    }
}

fn seen(orbit: &Orbit) -> SettledMotion {
    let mut motion = orbit.scene.motion(orbit.state().into()).expect("valid");
    let mut seen = SettledMotion {
        lowest: orbit.position,
        highest: orbit.position,
        amplitude: orbit.scene.excitation.amplitude,
        stiffness: orbit.scene.stiffness,
        ..SettledMotion::default()
    };
    motion
        .advance(Clock::at_cycle(orbit.periods), &mut seen)
        .expect("bounded");
    motion.tell_arc(&mut seen);
    seen
}

fn total_loss(losses: &Losses) -> f64 {
    losses.free_damping + losses.contact_damping + losses.impacts + losses.strip + losses.stop
}

/// A motion on which a machine settles, if it repeats soon.
fn settled(scene: &Scene) -> Option<Orbit> {
    let start = start_below(scene, 0.5, 1.0);
    let (regime, state) = Regime::after_transient(scene, start, 200).ok()?;
    Orbit::find_periodic(scene, state.into(), regime?.periods).ok()
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn what_is_supplied_is_dissipated_and_no_point_lies_beyond(scene in machines()) {
        let Some(orbit) = settled(&scene) else { return Ok(()) };
        let stroke = CycleMetrics::of(&orbit).expect("computed");
        let defect = stroke.supplied - total_loss(&stroke.losses);
        let size = 1.0 + stroke.supplied.abs();
        prop_assert!(defect.abs() <= 1e-10 * size, "{defect:e} of {size}: {scene:?}");
        let seen = seen(&orbit);
        for (found, seen, most) in [
            (-stroke.lowest, -seen.lowest, 1e-3),
            (stroke.highest, seen.highest, 1e-3),
            (stroke.peak_power, seen.power, 1e-3),
            // A force falls steeply after a touch under heavy damping.
            (stroke.contact_force, seen.force, 2e-2),
        ] {
            let size = 1.0 + found.abs();
            prop_assert!(found - seen >= -1e-12 * size && found - seen <= most * size, "{found} {seen}: {scene:?}");
        }
    }
}

/// The same energies as those of a machine that runs.
#[test]
fn a_running_machine_tallies_the_same() {
    for scene in [unloaded(1.15), loaded()] {
        let orbit = orbit::find(&scene).expect("z = 1");
        let stroke = CycleMetrics::of(&orbit).expect("computed");
        let mut machine =
            Simulation::new(&scene, softstop::Start::from(orbit.state())).expect("valid");
        machine.advance(scene.period()).expect("bounded");
        assert_near(machine.energy().supplied, stroke.supplied, 1e-10);
        assert_near(
            machine.energy().dissipated,
            total_loss(&stroke.losses),
            1e-10,
        );
        assert_eq!(machine.pierce_count(), stroke.strips);
    }
}

/// A and B (Peterka 2003, fig. 7): docs/paper.md has the same X_m, velocities and energies from the pictures' data.
#[test]
fn points_a_and_b() {
    let of =
        |scene: &Scene| CycleMetrics::of(&orbit::find(scene).expect("z = 1")).expect("computed");
    let (a, b) = (of(&unloaded(1.15)), of(&loaded()));
    assert_near(a.highest, 10.260_591, 1e-6);
    assert_near(b.highest, 11.155_995, 1e-6);
    assert_near(total_loss(&a.losses), 16.69, 0.005);
    assert_near(total_loss(&b.losses), 26.42, 0.005);
    assert_near(a.impact_energy, 0.5 * 6.494_627_f64.powi(2), 1e-5);
    assert_eq!((a.strips, b.strips, a.beyond_strip), (0, 1, None));
    assert_near(b.beyond_strip.expect("a strip"), 0.755_995, 1e-6);
    // The preload and 7 times the way beyond the stop, but for the damper.
    let stop = |stroke: &CycleMetrics, behind: f64| 7.0 * (stroke.highest - 10.0 - behind);
    assert!(
        a.stop_force_above_preload >= stop(&a, 0.0) && b.stop_force_above_preload >= stop(&b, 0.9)
    );
    assert_eq!(a.stop_force - a.stop_force_above_preload, 70.0);
    assert_eq!(
        (a.losses.strip, a.losses.impacts, a.losses.stop),
        (0.0, 0.0, 0.0)
    );
    // Phase I takes 44/2 sigma^2 on the way in and 2/2 sigma^2 on the way back, phase II 1.76 nu and 0.88 nu.
    assert_near(b.losses.strip, 23.0 * 0.16 + 2.64 * 0.5, 1e-10);
    // 44 sigma, and the damper of contact.
    assert!(b.strip_force > 17.6 && b.strip_force < 17.6 + 0.14 * b.impact_velocity);
    assert_eq!((a.before_wall, a.impulse), (None, 0.0));
}

/// With a rigid stop behind it, and hit by it.
#[test]
fn a_rigid_stop_behind() {
    let far = |travel| Ratios {
        rigid: Some(rigid_stop(travel, 0.5)),
        ..Ratios::loaded()
    };
    let of = |travel| {
        let scene = far(travel).scene().expect("valid");
        CycleMetrics::of(&orbit::find(&scene).expect("z = 1")).expect("computed")
    };
    assert_near(
        of(5.0).before_wall.expect("a wall"),
        15.9 - 11.155_995,
        1e-6,
    );
    let hit = of(0.1);
    assert_eq!(hit.before_wall, Some(0.0));
    assert!(hit.impulse > 1.0 && hit.losses.impacts > 0.0);
}
