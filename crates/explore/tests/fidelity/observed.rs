//! What is observed of a machine, and how models are compared by it.

use super::*;
use softstop::Start;
use softstop_testing::assert_relative;
use softstop_testing::tolerance::{DIFFERENCED, MOTION, SOLVED, printed};

#[test]
fn what_is_observed_balances() -> Outcome {
    let truth = Ratios::loaded().scene()?;
    let observed = ObservedFigures::settled(&truth, None, FLUNG)?;
    let period = truth.period();
    let trajectory = truth.trajectory(observed.start, 1)?;
    let power = observed.value(Quantity::MeanPower).ok_or("a motion")?;
    assert_relative(power * period, trajectory.work().dissipated, SOLVED);
    let lost = observed.value(Quantity::EnergyPerImpact);
    let contact = lost.ok_or("it strikes")?;
    assert!(contact < trajectory.work().dissipated);
    let rigid = machine(Stop::Rigid { restitution: 0.6 }, 0.08);
    let observed = ObservedFigures::settled(&rigid, None, FLUNG)?;
    let velocity = from_truth(&observed)?;
    let lost = 0.5 * 2.0 * velocity * velocity * (1.0 - 0.36);
    let energy = observed.value(Quantity::EnergyPerImpact);
    assert_relative(energy.ok_or("it strikes")?, lost, MOTION);
    assert_eq!(observed.value(Quantity::PeakForce), None);
    assert_eq!(observed.value(Quantity::ContactTime), Some(0.0));
    Ok(())
}

#[test]
fn the_largest_force_is_that_of_the_samples_and_no_less() -> Outcome {
    let truth = Ratios::unloaded().scene()?;
    let observed = ObservedFigures::settled(&truth, None, FLUNG)?;
    let peak = observed.value(Quantity::PeakForce).ok_or("it strikes")?;
    let mut simulation = softstop::Simulation::new(&truth, observed.start)?;
    let mut seen = 0.0f64;
    for step in 1..=200_000 {
        simulation.advance(truth.period() * f64::from(step) / 2e5)?;
        seen = seen.max(simulation.sample().contact_force);
    }
    assert!(peak >= seen, "{peak} < {seen}");
    assert_relative(peak, seen, DIFFERENCED);
    Ok(())
}

#[test]
fn bounds_are_those_of_the_paper() -> Outcome {
    let truth = Ratios::unloaded().scene()?;
    let observed = ObservedFigures::settled(&truth, None, FLUNG)?;
    let found = observed.with_bounds(&truth)?;
    let bound = |quantity: Quantity| found.value(quantity).ok_or(quantity.name());
    let grazing = bound(Quantity::GrazingFrequency)?;
    assert_relative(grazing, 1.044_440_04, 2.0 * printed(8));
    assert_relative(bound(Quantity::FlipFrequency)?, 0.988_907, printed(6));
    assert_relative(bound(Quantity::FoldFrequency)?, 1.369_036, printed(6));
    let still = machine(Stop::None, 0.08);
    let observed = ObservedFigures::settled(&still, None, FLUNG)?;
    let found = observed.with_bounds(&still)?;
    let grazing = found.value(Quantity::GrazingFrequency).ok_or("g0")?;
    assert_relative(grazing, 1.044_440_04, 2.0 * printed(8));
    assert_eq!(found.value(Quantity::FlipFrequency), None);
    assert_eq!(found.value(Quantity::FoldFrequency), None);
    Ok(())
}

fn regime_at(frequency: f64, start: Start) -> Result<Option<Regime>, Box<dyn std::error::Error>> {
    let scene = Ratios {
        frequency,
        ..Ratios::unloaded()
    }
    .scene()?;
    Ok(Regime::after_transient(&scene, start, 400)?.0)
}

#[test]
fn regimes_are_those_of_the_paper() -> Outcome {
    let z = |impacts, periods| Some(Regime { impacts, periods });
    let rest = Start::new(0.0, 0.0);
    assert_eq!(regime_at(1.15, FLUNG)?, z(1, 1));
    assert_eq!(regime_at(1.15, rest)?, z(0, 1));
    assert_eq!(regime_at(0.9875, FLUNG)?, None, "chaos");
    assert_eq!(regime_at(1.0, FLUNG)?, z(1, 1));
    assert_eq!(
        Regime {
            impacts: 2,
            periods: 3
        }
        .to_string(),
        "2/3"
    );
    Ok(())
}

#[test]
fn the_cheapest_within_the_tolerance_is_named() -> Outcome {
    let models = [
        (None, 1.0),
        (Some(0.1), 2.0),
        (Some(0.004), 3.0),
        (Some(0.0), 4.0),
    ];
    assert_eq!(cheapest(&models, 0.5), Some(1));
    assert_eq!(cheapest(&models, 0.01), Some(2));
    assert_eq!(cheapest(&models, 1e-9), Some(3));
    assert_eq!(cheapest(&models[..3], 1e-9), None);
    let same = [(Some(0.0), 2.0), (Some(0.0), 2.0)];
    assert_eq!(cheapest(&same, 0.0), Some(0), "the simpler of two equals");
    Ok(())
}

#[test]
fn errors_are_relative_and_angles_wrap() -> Outcome {
    let truth = Ratios::unloaded().scene()?;
    let observed = ObservedFigures::settled(&truth, None, FLUNG)?;
    let answers = |impact_phase, velocity| {
        let mut observed = observed;
        observed.values[Quantity::ImpactPhase as usize] = Some(impact_phase);
        observed.values[Quantity::BeforeImpactVelocity as usize] = Some(velocity);
        observed
    };
    let (a, b) = (answers(0.1, 8.0), answers(6.2, 10.0));
    let velocity = a.error(&b, Quantity::BeforeImpactVelocity).ok_or("both")?;
    assert_relative(velocity, 0.25, 1e-15);
    let phase = a.error(&b, Quantity::ImpactPhase).ok_or("both")?;
    assert_relative(
        phase,
        (0.1 + std::f64::consts::TAU - 6.2) / std::f64::consts::TAU,
        MOTION,
    );
    assert_eq!(a.error(&b, Quantity::FoldFrequency), None);
    for quantity in Quantity::ALL {
        assert!([None, Some(0.0)].contains(&a.error(&a, quantity)));
    }
    Ok(())
}
