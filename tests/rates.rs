//! Rates of the outputs against differences in time.

use proptest::prelude::*;
use softstop::Simulation;
use softstop_testing::{cases, is_near, machines, start_below};

/// Jerk, contact force and the three energies.
fn outputs(machine: &Simulation) -> [f64; 5] {
    let (sample, energy) = (machine.sample(), machine.energy());
    [
        sample.jerk,
        sample.contact_force,
        energy.mechanical,
        energy.supplied,
        energy.dissipated,
    ]
}

proptest! {
    #![proptest_config(cases(600))]

    #[test]
    fn rates_are_derivatives_in_time(
        scene in machines(),
        depth in -0.5..4.0f64,
        velocity in -6.0..6.0f64,
        force in -0.5..0.5f64,
        rate in -0.3..0.3f64,
        span in 0.0..3.0f64,
    ) {
        let Ok(mut machine) = Simulation::new(&scene, start_below(&scene, depth, velocity)) else {
            return Ok(());
        };
        machine.set_force(&[force, rate]).expect("finite");
        machine.advance(span * scene.period()).expect("bounded");
        let here = machine.rates();
        let kind = machine.sample().phase;
        let width = 1e-4;
        let mut at = [[0.0; 5]; 5];
        at[0] = outputs(&machine);
        let begin = machine.time();
        for (n, place) in at.iter_mut().enumerate().skip(1) {
            machine.advance(begin + n as f64 * width).expect("bounded");
            *place = outputs(&machine);
            prop_assume!(machine.sample().phase == kind);
        }
        let rates = [here.contact_force, here.mechanical, here.supplied, here.dissipated];
        let first: Vec<_> = std::iter::once(here.snap).chain(rates.iter().map(|r| r.0)).collect();
        for n in 0..5 {
            let f = |k: usize| at[k][n];
            // Forward differences of order 4 and 3.
            let found = (-25.0 * f(0) + 48.0 * f(1) - 36.0 * f(2) + 16.0 * f(3) - 3.0 * f(4)) / (12.0 * width);
            let rough = (-3.0 * f(0) + 4.0 * f(1) - f(2)) / (2.0 * width);
            let size = 1.0 + first[n].abs() + f(0).abs();
            // Steep laws near their face are not resolved by the differences.
            prop_assume!((found - rough).abs() < 1e-3 * size);
            let allowed = 1e-6 * size + (found - rough).abs();
            assert!(is_near(found, first[n], allowed), "{n}: {found} {}", first[n]);
            if n > 0 {
                let found = (35.0 * f(0) - 104.0 * f(1) + 114.0 * f(2) - 56.0 * f(3) + 11.0 * f(4))
                    / (12.0 * width * width);
                let rough = (f(0) - 2.0 * f(1) + f(2)) / (width * width);
                let exact = rates[n - 1].1;
                let allowed = 1e-3 * (size + exact.abs()) + (found - rough).abs();
                assert!(is_near(found, exact, allowed), "{n}: {found} {exact}");
            }
        }
    }
}
