//! Models of a machine: matching formulas against exact contacts, and ladders with known answers.

use softstop::scene::{Release, Slope};
use softstop::{Excitation, Ratios, Scene, Start, Stop};
use softstop_dynamics::models::{
    Answers, Contact, FidelityError, Ladder, Likeness, Observation, Quantity, Rung, bounds,
    cheapest, from_model, from_truth, matching,
};
use softstop_dynamics::orbit::Regime;

type Outcome = Result<(), Box<dyn std::error::Error>>;

const FLUNG: Start = Start {
    position: 0.0,
    velocity: 14.0,
};

/// A machine of 2 kg, so that no formula gets by without the mass.
fn machine(stop: Stop, contact_damping: f64) -> Scene {
    Scene {
        mass: 2.0,
        stiffness: 2.0,
        damping: 0.08,
        excitation: Excitation {
            amplitude: 2.0,
            frequency: 1.15,
            phase: 0.0,
        },
        clearance: 10.0,
        contact_damping,
        stop,
        piercing: None,
        rigid: None,
    }
}

fn kelvin_voigt(stiffness: f64, zeta: f64, release: Release) -> Scene {
    let damping = 2.0 * zeta * (2.0 * stiffness).sqrt();
    machine(Stop::KelvinVoigt { stiffness, release }, damping)
}

fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance * b.abs(), "{a} is not {b}");
}

#[test]
fn a_spring_beside_a_damper_behaves_as_the_formulas_say() -> Outcome {
    let (stiffness, speed) = (350.0f64, 3.7);
    let second = (2.0 / stiffness).sqrt();
    for release in [Release::Clearance, Release::ZeroForce] {
        for zeta in [0.0, 1e-6, 0.01, 0.3, 0.7, 0.95] {
            let contact = Contact::of(&kelvin_voigt(stiffness, zeta, release), speed)?;
            close(
                contact.restitution,
                matching::restitution(release, zeta),
                1e-12,
            );
            close(
                contact.penetration,
                speed * second * matching::penetration(zeta),
                1e-12,
            );
            close(
                contact.duration,
                second * matching::duration(release, zeta),
                1e-12,
            );
        }
    }
    for zeta in [1.0, 1.2, 4.0] {
        let contact = Contact::of(&kelvin_voigt(stiffness, zeta, Release::ZeroForce), speed)?;
        close(
            contact.restitution,
            matching::restitution(Release::ZeroForce, zeta),
            1e-11,
        );
        close(
            contact.duration,
            second * matching::duration(Release::ZeroForce, zeta),
            1e-11,
        );
    }
    let stays = Contact::of(&kelvin_voigt(stiffness, 1.1, Release::Clearance), speed)?;
    assert_eq!(stays.restitution, 0.0);
    assert_eq!(matching::restitution(Release::Clearance, 1.1), 0.0);
    assert_eq!(stays.duration, f64::INFINITY);
    Ok(())
}

/// The three cases of Schwager and Poeschel 2007, eq. (20), as they print them.
fn schwager_poeschel(zeta: f64) -> f64 {
    let beta = zeta;
    let square: f64 = 1.0 - beta * beta;
    if square < 0.0 {
        let w = (-square).sqrt();
        return (-beta / w * ((beta + w) / (beta - w)).ln()).exp();
    }
    let w = square.sqrt();
    let angle = (2.0 * beta * w / (w * w - beta * beta)).atan();
    let angle = if beta < std::f64::consts::FRAC_1_SQRT_2 {
        std::f64::consts::PI - angle
    } else {
        -angle
    };
    (-beta / w * angle).exp()
}

#[test]
fn one_formula_is_the_three_of_the_literature() {
    for zeta in [0.01, 0.2, 0.6, 0.8, 0.99, 1.01, 2.0, 10.0] {
        let found = matching::restitution(Release::ZeroForce, zeta);
        close(found, schwager_poeschel(zeta), 1e-12);
    }
    close(
        matching::restitution(Release::ZeroForce, 1.0),
        (-2.0f64).exp(),
        1e-15,
    );
}

#[test]
fn the_damping_ratio_is_the_inverse_of_the_restitution() {
    for release in [Release::Clearance, Release::ZeroForce] {
        assert_eq!(matching::damping_ratio(release, 1.0), Some(0.0));
        for restitution in [1e-6, 0.05, 0.5, 0.9, 1.0 - 1e-9] {
            let zeta = matching::damping_ratio(release, restitution).expect("in range");
            close(matching::restitution(release, zeta), restitution, 1e-12);
        }
        for impossible in [0.0, -0.1, 1.1, f64::NAN] {
            assert_eq!(matching::damping_ratio(release, impossible), None);
        }
    }
}

/// After-impact speed of a Hunt-Crossley contact by the classical Runge-Kutta method.
fn by_runge_kutta(stiffness: f64, dissipation: f64, speed: f64) -> f64 {
    let law = |d: f64, v: f64| -stiffness / 2.0 * d.max(0.0).powf(1.5) * (1.0 + dissipation * v);
    let (mut d, mut v, h) = (0.0, speed, 2e-6);
    loop {
        let (a, b) = (v, law(d, v));
        let (c, e) = (v + 0.5 * h * b, law(d + 0.5 * h * a, v + 0.5 * h * b));
        let (f, g) = (v + 0.5 * h * e, law(d + 0.5 * h * c, v + 0.5 * h * e));
        let (p, q) = (v + h * g, law(d + h * f, v + h * g));
        d += h / 6.0 * (a + 2.0 * c + 2.0 * f + p);
        v += h / 6.0 * (b + 2.0 * e + 2.0 * g + q);
        if d <= 0.0 {
            return -v;
        }
    }
}

fn hertz(stiffness: f64, dissipation: f64) -> Scene {
    let exponent = 1.5;
    let stop = Stop::Hertz {
        stiffness,
        exponent,
        dissipation,
    };
    machine(stop, 0.0)
}

#[test]
fn a_hunt_crossley_contact_has_the_restitution_that_it_is_made_for() -> Outcome {
    let (stiffness, speed) = (900.0, 2.5);
    for restitution in [1e-3, 0.1, 0.5, 0.9, 0.999, 1.0 - 1e-7] {
        let a = matching::hunt_crossley(restitution).ok_or("in range")?;
        let contact = Contact::of(&hertz(stiffness, a / speed), speed)?;
        close(contact.restitution, restitution, 1e-9);
        let stored = stiffness * contact.penetration.powf(2.5) / 2.5;
        let energy = 2.0 * speed * speed * matching::hunt_crossley_energy(a);
        close(stored, energy, 1e-9);
    }
    let a = matching::hunt_crossley(0.6).ok_or("in range")?;
    let integrated = by_runge_kutta(stiffness, a / speed, speed);
    close(integrated / speed, 0.6, 1e-7);
    assert_eq!(matching::hunt_crossley(0.0), None);
    assert_eq!(matching::hunt_crossley(1.0), Some(0.0));
    Ok(())
}

#[test]
fn without_much_loss_the_approximations_of_the_literature_hold() -> Outcome {
    for loss in [1e-3, 1e-5] {
        let r = 1.0 - loss;
        let exact = matching::hunt_crossley(r).ok_or("in range")?;
        // Hunt and Crossley 1975; Lankarani and Nikravesh 1990: both to first order in the loss.
        close(1.5 * loss, exact, 3.0 * loss);
        close(0.75 * (1.0 - r * r), exact, 3.0 * loss);
    }
    let exact = matching::hunt_crossley(0.5).ok_or("in range")?;
    assert!(0.75 * (1.0 - 0.25) < 0.6 * exact, "not at R = 1/2");
    Ok(())
}

#[test]
fn without_damping_a_preloaded_contact_obeys_the_energy_equivalence() -> Outcome {
    let (stiffness, preload, speed) = (7.0, 70.0, 6.5);
    let scene = machine(Stop::Preloaded { stiffness, preload }, 0.0);
    let contact = Contact::of(&scene, speed)?;
    let d = contact.penetration;
    close(contact.restitution, 1.0, 1e-13);
    close(preload * d + 0.5 * stiffness * d * d, speed * speed, 1e-12);
    let ladder = Ladder {
        truth: scene,
        likeness: Likeness::Penetration,
    };
    let Stop::KelvinVoigt { stiffness: k, .. } = ladder.model(Rung::KelvinVoigt, speed)?.scene.stop
    else {
        return Err("no spring".into());
    };
    close(0.5 * k * d * d, speed * speed, 1e-12);
    Ok(())
}

/// A chain of one slope is a Kelvin-Voigt stop, but stands on no rung.
fn spring_in_disguise(stiffness: f64, zeta: f64) -> Scene {
    let damping = 2.0 * zeta * (2.0 * stiffness).sqrt();
    let slope = Slope {
        from: 0.0,
        stiffness,
    };
    let stop = Stop::PiecewiseLinear {
        loading: vec![slope],
        unloading: Vec::new(),
    };
    machine(stop, damping)
}

#[test]
fn a_spring_in_disguise_is_found_out() -> Outcome {
    let truth = spring_in_disguise(150.0, 0.1);
    let observed = Observation::settled(&truth, None, FLUNG)?;
    let velocity = from_truth(&observed)?;
    for likeness in [Likeness::Penetration, Likeness::Duration] {
        let ladder = Ladder {
            truth: truth.clone(),
            likeness,
        };
        let model = ladder.model(Rung::KelvinVoigt, velocity)?;
        let Stop::KelvinVoigt { stiffness, .. } = model.scene.stop else {
            return Err("no spring".into());
        };
        close(stiffness, 150.0, 1e-11);
        close(model.scene.contact_damping, truth.contact_damping, 1e-11);
        let modelled = Observation::settled(&model.scene, None, FLUNG)?;
        close(modelled.max_position, observed.max_position, 1e-11);
        close(from_truth(&modelled)?, velocity, 1e-11);
    }
    Ok(())
}

#[test]
fn a_scene_on_a_rung_is_its_own_model() -> Outcome {
    let truth = kelvin_voigt(100.0, 0.15, Release::ZeroForce);
    let ladder = Ladder {
        truth: truth.clone(),
        likeness: Likeness::Penetration,
    };
    assert_eq!(
        ladder.rungs(),
        [Rung::Linear, Rung::Rigid, Rung::KelvinVoigt, Rung::Hertz]
    );
    assert_eq!(ladder.model(Rung::KelvinVoigt, 5.0)?.scene, truth);
    let loaded = Ladder {
        truth: Ratios::loaded().scene()?,
        likeness: Likeness::Penetration,
    };
    assert_eq!(loaded.rungs(), Rung::ALL);
    assert_eq!(loaded.model(Rung::Full, 8.0)?.scene, loaded.truth);
    let free = Ladder {
        truth: machine(Stop::None, 0.08),
        likeness: Likeness::Penetration,
    };
    assert_eq!(free.rungs(), [Rung::Linear]);
    Ok(())
}

#[test]
fn the_rigid_model_comes_nearer_with_the_root_of_the_stiffness() -> Outcome {
    let error = |stiffness: f64| -> Result<f64, Box<dyn std::error::Error>> {
        let truth = kelvin_voigt(stiffness, 0.1, Release::Clearance);
        let observed = Observation::settled(&truth, None, FLUNG)?;
        let velocity = from_truth(&observed)?;
        let ladder = Ladder {
            truth,
            likeness: Likeness::Penetration,
        };
        let rigid = ladder.model(Rung::Rigid, velocity)?;
        let modelled = Observation::settled(&rigid.scene, Some(observed.start), FLUNG)?;
        Ok((from_truth(&modelled)? - velocity).abs() / velocity)
    };
    let mut last = error(1e6)?;
    for stiffness in [4e6, 1.6e7, 6.4e7] {
        let next = error(stiffness)?;
        let order = (last / next).log2();
        assert!((order - 1.0).abs() < 0.02, "order {order} in 1/sqrt(k)");
        last = next;
    }
    Ok(())
}

#[test]
fn a_preloaded_stop_stands_in_for_a_strip() -> Outcome {
    let truth = Ratios::loaded().scene()?;
    let contact = Contact::of(&truth, 8.4)?;
    for likeness in [Likeness::Penetration, Likeness::Duration] {
        let ladder = Ladder {
            truth: truth.clone(),
            likeness,
        };
        for rung in [Rung::Preloaded, Rung::Hertz, Rung::KelvinVoigt, Rung::Rigid] {
            let like = Contact::of(&ladder.model(rung, 8.4)?.scene, 8.4)?;
            close(like.restitution, contact.restitution, 1e-9);
            match likeness {
                _ if rung == Rung::Rigid => assert_eq!(like.penetration, 0.0),
                Likeness::Penetration => close(like.penetration, contact.penetration, 1e-9),
                Likeness::Duration => close(like.duration, contact.duration, 1e-9),
            }
        }
    }
    Ok(())
}

#[test]
fn a_rigid_stop_has_no_soft_model() -> Outcome {
    let restitution = 0.6;
    let ladder = Ladder {
        truth: machine(Stop::Rigid { restitution }, 0.08),
        likeness: Likeness::Penetration,
    };
    let contact = Contact::of(&ladder.truth, 5.0)?;
    assert_eq!((contact.restitution, contact.penetration), (0.6, 0.0));
    for rung in [Rung::KelvinVoigt, Rung::Hertz] {
        let error = ladder.model(rung, 5.0).expect_err("no finite stiffness");
        assert!(matches!(error, FidelityError::Unmatched { .. }), "{error}");
    }
    assert!(ladder.model(Rung::KelvinVoigt, -1.0).is_err());
    Ok(())
}

#[test]
fn a_predicted_model_is_matched_at_its_own_velocity() -> Outcome {
    let ladder = Ladder {
        truth: Ratios::loaded().scene()?,
        likeness: Likeness::Duration,
    };
    for rung in [Rung::Rigid, Rung::KelvinVoigt] {
        let (model, observed) = from_model(&ladder, rung, FLUNG)?;
        let velocity = from_truth(&observed)?;
        let again = Contact::of(&model.scene, velocity)?;
        let own = Contact::of(&ladder.truth, velocity)?;
        close(again.restitution, own.restitution, 1e-7);
    }
    Ok(())
}

#[test]
fn what_is_observed_balances() -> Outcome {
    let truth = Ratios::loaded().scene()?;
    let observed = Observation::settled(&truth, None, FLUNG)?;
    let period = truth.period();
    let trajectory = truth.trajectory(observed.start, 1)?;
    close(
        observed.mean_power * period,
        trajectory.work.dissipated,
        1e-10,
    );
    let contact = observed.energy_per_impact.ok_or("it strikes")?;
    assert!(contact < trajectory.work.dissipated);
    let rigid = machine(Stop::Rigid { restitution: 0.6 }, 0.08);
    let observed = Observation::settled(&rigid, None, FLUNG)?;
    let velocity = from_truth(&observed)?;
    let lost = 0.5 * 2.0 * velocity * velocity * (1.0 - 0.36);
    close(observed.energy_per_impact.ok_or("it strikes")?, lost, 1e-12);
    assert_eq!(observed.peak_force, None);
    assert_eq!(observed.contact_time, Some(0.0));
    Ok(())
}

#[test]
fn the_largest_force_is_that_of_the_samples_and_no_less() -> Outcome {
    let truth = Ratios::unloaded().scene()?;
    let observed = Observation::settled(&truth, None, FLUNG)?;
    let peak = observed.peak_force.ok_or("it strikes")?;
    let mut simulation = softstop::Simulation::new(&truth, observed.start)?;
    let mut seen = 0.0f64;
    for step in 1..=200_000 {
        simulation.advance(truth.period() * f64::from(step) / 2e5)?;
        seen = seen.max(simulation.sample().contact_force);
    }
    assert!(peak >= seen, "{peak} < {seen}");
    close(peak, seen, 1e-6);
    Ok(())
}

#[test]
fn bounds_are_those_of_the_paper() -> Outcome {
    let truth = Ratios::unloaded().scene()?;
    let observed = Observation::settled(&truth, None, FLUNG)?;
    let found = bounds(&truth, &observed)?;
    close(found.grazing.ok_or("g0")?, 1.044_440_04, 1e-8);
    close(found.flip.ok_or("s_PD")?, 0.988_907, 1e-6);
    close(found.fold.ok_or("s_SN")?, 1.369_036, 1e-6);
    let still = machine(Stop::None, 0.08);
    let observed = Observation::settled(&still, None, FLUNG)?;
    let found = bounds(&still, &observed)?;
    close(found.grazing.ok_or("g0")?, 1.044_440_04, 1e-8);
    assert_eq!((found.flip, found.fold), (None, None));
    Ok(())
}

fn regime_at(frequency: f64, start: Start) -> Result<Option<Regime>, Box<dyn std::error::Error>> {
    let scene = Ratios {
        frequency,
        ..Ratios::unloaded()
    }
    .scene()?;
    Ok(Regime::after(&scene, start, 400)?.0)
}

#[test]
fn regimes_are_those_of_the_paper() -> Outcome {
    let z = |impacts, periods| Some(Regime { impacts, periods });
    let rest = Start {
        position: 0.0,
        velocity: 0.0,
    };
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
    let observed = Observation::settled(&truth, None, FLUNG)?;
    let answers = |impact_phase, velocity| Answers {
        observed: Observation {
            impact_phase: Some(impact_phase),
            before_impact_velocity: Some(velocity),
            ..observed
        },
        bounds: None,
    };
    let (a, b) = (answers(0.1, 8.0), answers(6.2, 10.0));
    let velocity = Quantity::BeforeImpactVelocity.error(&a, &b).ok_or("both")?;
    close(velocity, 0.25, 1e-15);
    let phase = Quantity::ImpactPhase.error(&a, &b).ok_or("both")?;
    close(
        phase,
        (0.1 + std::f64::consts::TAU - 6.2) / std::f64::consts::TAU,
        1e-12,
    );
    assert_eq!(Quantity::FoldFrequency.error(&a, &b), None);
    for quantity in Quantity::ALL {
        assert!([None, Some(0.0)].contains(&quantity.error(&a, &a)));
    }
    Ok(())
}
