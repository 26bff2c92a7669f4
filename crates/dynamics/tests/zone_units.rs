//! A machine in SI has the zone of the same machine in ratios, whatever its stop, and the same motions.

use proptest::prelude::*;
use softstop::{Machine, Ratios, Scene, Start, Stop, Strip, UnitSystem};
use softstop_dynamics::MotionKind;
use softstop_dynamics::continuation::{Direction, TestFunction};
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::settled::Settling;
use softstop_dynamics::zone::{StableBranchEnd, ZoneError, hysteresis, loss_of_stability};
use softstop_testing::{hertz, kelvin_voigt, preloaded, random, units};

/// A machine by its clearance, its damping and which stop it has.
fn machine(clearance: f64, damping: f64, which: usize) -> Scene {
    let ratios = Ratios {
        clearance,
        damping,
        piercing: (which == 5).then_some(Strip::PAPER),
        ..Ratios::unloaded()
    };
    let mut scene = ratios.scene().expect("valid");
    match which {
        1 => scene.stop = Stop::Rigid { restitution: 0.6 },
        2 => scene.stop = kelvin_voigt(40.0, Default::default()),
        3 => scene.stop = hertz(30.0, 1.5, 0.02),
        4 => scene.stop = preloaded(3.0, 5.0),
        _ => {}
    }
    scene
}

/// The bounds of z = 1: g0, s_SN, the velocity there, s_PD.
fn bounds(scene: &Scene) -> Result<[f64; 4], String> {
    let zone = hysteresis(scene).map_err(|error| format!("{error:?}"))?;
    let orbit = zone.orbit_at(0.5).map_err(|error| format!("{error:?}"))?;
    let flip = loss_of_stability(&orbit, Direction::Down, TestFunction::Flip).expect("a branch");
    let flip = flip.map_or(f64::NAN, |point| point.parameter);
    Ok([
        zone.frequency_g0,
        zone.high.frequency,
        zone.high.point.before_impact_velocity(),
        flip,
    ])
}

proptest! {
    #![proptest_config(random::cases(24))]

    #[test]
    fn zones_do_not_depend_on_units(
        clearance in 2.0..16.0f64,
        damping in 0.01..0.04f64,
        which in 0..6usize,
        powers in (-4.0..4.0f64, -3.0..8.0f64, -3.0..5.0f64),
    ) {
        let units = units(10f64.powf(powers.0), 10f64.powf(powers.1), 10f64.powf(powers.2));
        let plain = machine(clearance, damping, which);
        let other = plain.in_units(units).expect("valid");
        let (w, speed) = (units.frequency(), units.frequency() * units.length());
        match (bounds(&plain), bounds(&other)) {
            (Ok(plain), Ok(other)) => {
                for ((plain, other), unit) in plain.iter().zip(other).zip([w, w, speed, w]) {
                    let same = (other / unit / plain - 1.0).abs() < 1e-9;
                    prop_assert!(same || (plain.is_nan() && other.is_nan()), "{plain} {other}");
                }
            }
            (plain, other) => prop_assert!(plain.is_err() && other.is_err(), "{plain:?} {other:?}"),
        }
    }
}

/// A free motion that dies away slowly: its tangent never grows, but in fast units of time one of its entries is large.
#[test]
fn what_has_not_settled_is_no_chaos_in_any_units() {
    let plain = machine(10.0, 0.001, 0).at_frequency(1.5);
    let units = |mass, stiffness| units(mass, stiffness, 1.0);
    let settling = Settling {
        periods: 80,
        longest: 80,
        ..Settling::default()
    };
    for units in [units(1.0, 1.0), units(1e-6, 1e6)] {
        let scene = plain.in_units(units).expect("valid");
        let start = Start::new(0.5 * units.length(), 0.0);
        let seen = settling.follow_motions(&[(&scene, start)], &unmonitored);
        let seen = seen.expect("followed").remove(0).expect("a motion");
        let map = seen.watched_map(&scene.check().expect("valid"));
        let (motion, growth) = seen.motion_kind(&map).expect("a motion");
        assert_eq!(motion, MotionKind::Unsettled, "{growth:?}");
    }
}

#[test]
fn a_zone_that_is_not_there_is_told_in_the_units_of_the_machine() {
    let mut machine = Machine::from(machine(10.0, 0.02, 0));
    let error = ZoneError::NoFold {
        from: (0.5 * std::f64::consts::PI).into(),
        to: std::f64::consts::PI.into(),
        end: StableBranchEnd::Regime,
    };
    let said = |machine: &Machine| error.clone().in_units_of(machine).to_string();
    assert!(said(&machine).contains("up to excitation.frequency = 3.14159"));
    machine.unit_system = UnitSystem::Hertz;
    assert_eq!(
        said(&machine),
        "no hysteresis: the hardest z = 1 motion at the grazing boundary, excitation.frequency_hz = 0.25, stays stable up \
         to excitation.frequency_hz = 0.5, where it ends otherwise than by a fold"
    );
}
