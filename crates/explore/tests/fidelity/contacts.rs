//! Formulas that match one contact to another, against exact contacts.

use super::*;
use softstop_testing::tolerance::{GROWN, MOTION, ROUNDING, SOLVED};
use softstop_testing::{assert_relative, hertz};

#[test]
fn a_spring_beside_a_damper_behaves_as_the_formulas_say() -> Outcome {
    let (stiffness, speed) = (350.0f64, 3.7);
    let second = (2.0 / stiffness).sqrt();
    for release in [Release::Clearance, Release::ZeroForce] {
        for zeta in [0.0, 1e-6, 0.01, 0.3, 0.7, 0.95] {
            let contact = Contact::of(&kelvin_voigt(stiffness, zeta, release), speed)?;
            assert_relative(
                contact.restitution,
                matching::restitution(release, zeta),
                MOTION,
            );
            assert_relative(
                contact.penetration,
                speed * second * matching::penetration(zeta),
                MOTION,
            );
            assert_relative(
                contact.duration,
                second * matching::duration(release, zeta),
                MOTION,
            );
        }
    }
    for zeta in [1.0, 1.2, 4.0] {
        let contact = Contact::of(&kelvin_voigt(stiffness, zeta, Release::ZeroForce), speed)?;
        assert_relative(
            contact.restitution,
            matching::restitution(Release::ZeroForce, zeta),
            10.0 * MOTION,
        );
        assert_relative(
            contact.duration,
            second * matching::duration(Release::ZeroForce, zeta),
            10.0 * MOTION,
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
        assert_relative(found, schwager_poeschel(zeta), MOTION);
    }
    assert_relative(
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
            assert_relative(matching::restitution(release, zeta), restitution, MOTION);
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

fn sphere(stiffness: f64, dissipation: f64) -> Scene {
    machine(hertz(stiffness, 1.5, dissipation), 0.0)
}

#[test]
fn a_hunt_crossley_contact_has_the_restitution_that_it_is_made_for() -> Outcome {
    let (stiffness, speed) = (900.0, 2.5);
    for restitution in [1e-3, 0.1, 0.5, 0.9, 0.999, 1.0 - 1e-7] {
        let a = matching::hunt_crossley(restitution).ok_or("in range")?;
        let contact = Contact::of(&sphere(stiffness, a / speed), speed)?;
        assert_relative(contact.restitution, restitution, 10.0 * SOLVED);
        let stored = stiffness * contact.penetration.powf(2.5) / 2.5;
        let energy = 2.0 * speed * speed * matching::hunt_crossley_energy(a);
        assert_relative(stored, energy, 10.0 * SOLVED);
    }
    let a = matching::hunt_crossley(0.6).ok_or("in range")?;
    let integrated = by_runge_kutta(stiffness, a / speed, speed);
    assert_relative(integrated / speed, 0.6, 10.0 * GROWN);
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
        assert_relative(1.5 * loss, exact, 3.0 * loss);
        assert_relative(0.75 * (1.0 - r * r), exact, 3.0 * loss);
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
    assert_relative(contact.restitution, 1.0, 10.0 * ROUNDING);
    assert_relative(preload * d + 0.5 * stiffness * d * d, speed * speed, MOTION);
    let ladder = ModelHierarchy {
        truth: scene,
        likeness: MatchedProperty::Penetration,
    };
    let Stop::KelvinVoigt { stiffness: k, .. } = ladder.model(ContactLaw::KelvinVoigt, speed)?.stop
    else {
        return Err("no spring".into());
    };
    assert_relative(0.5 * k * d * d, speed * speed, MOTION);
    Ok(())
}
