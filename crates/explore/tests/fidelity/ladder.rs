//! Models of a machine from the simplest to itself.

use super::*;
use softstop_testing::tolerance::{GROWN, MOTION, SOLVED};
use softstop_testing::{assert_relative, is_near, slope};

/// A chain of one slope is a Kelvin-Voigt stop, but stands on no rung.
fn spring_in_disguise(stiffness: f64, zeta: f64) -> Scene {
    let damping = 2.0 * zeta * (2.0 * stiffness).sqrt();
    let slope = slope(0.0, stiffness);
    let stop = Stop::PiecewiseLinear {
        loading: vec![slope],
        unloading: Vec::new(),
    };
    machine(stop, damping)
}

#[test]
fn a_spring_in_disguise_is_found_out() -> Outcome {
    let truth = spring_in_disguise(150.0, 0.1);
    let observed = ObservedFigures::settled(&truth, None, FLUNG)?;
    let velocity = from_truth(&observed)?;
    for likeness in [MatchedProperty::Penetration, MatchedProperty::Duration] {
        let ladder = ModelHierarchy {
            truth: truth.clone(),
            likeness,
        };
        let model = ladder.model(ContactLaw::KelvinVoigt, velocity)?;
        let Stop::KelvinVoigt { stiffness, .. } = model.stop else {
            return Err("no spring".into());
        };
        assert_relative(stiffness, 150.0, 10.0 * MOTION);
        assert_relative(model.contact_damping, truth.contact_damping, 10.0 * MOTION);
        let modelled = ObservedFigures::settled(&model, None, FLUNG)?;
        let highest = |of: &ObservedFigures| of.value(Quantity::MaxPosition).ok_or("a motion");
        assert_relative(highest(&modelled)?, highest(&observed)?, 10.0 * MOTION);
        assert_relative(from_truth(&modelled)?, velocity, 10.0 * MOTION);
    }
    Ok(())
}

#[test]
fn a_scene_on_a_rung_is_its_own_model() -> Outcome {
    let truth = kelvin_voigt(100.0, 0.15, Release::ZeroForce);
    let ladder = ModelHierarchy {
        truth: truth.clone(),
        likeness: MatchedProperty::Penetration,
    };
    assert_eq!(
        ladder.rungs(),
        [
            ContactLaw::Linear,
            ContactLaw::Rigid,
            ContactLaw::KelvinVoigt,
            ContactLaw::Hertz
        ]
    );
    assert_eq!(ladder.model(ContactLaw::KelvinVoigt, 5.0)?, truth);
    let loaded = ModelHierarchy {
        truth: Ratios::loaded().scene()?,
        likeness: MatchedProperty::Penetration,
    };
    assert_eq!(loaded.rungs(), ContactLaw::ALL);
    assert_eq!(loaded.model(ContactLaw::Full, 8.0)?, loaded.truth);
    let free = ModelHierarchy {
        truth: machine(Stop::None, 0.08),
        likeness: MatchedProperty::Penetration,
    };
    assert_eq!(free.rungs(), [ContactLaw::Linear]);
    Ok(())
}

#[test]
fn the_rigid_model_comes_nearer_with_the_root_of_the_stiffness() -> Outcome {
    let error = |stiffness: f64| -> Result<f64, Box<dyn std::error::Error>> {
        let truth = kelvin_voigt(stiffness, 0.1, Release::Clearance);
        let observed = ObservedFigures::settled(&truth, None, FLUNG)?;
        let velocity = from_truth(&observed)?;
        let ladder = ModelHierarchy {
            truth,
            likeness: MatchedProperty::Penetration,
        };
        let rigid = ladder.model(ContactLaw::Rigid, velocity)?;
        let modelled = ObservedFigures::settled(&rigid, Some(observed.start), FLUNG)?;
        Ok((from_truth(&modelled)? - velocity).abs() / velocity)
    };
    let mut last = error(1e6)?;
    for stiffness in [4e6, 1.6e7, 6.4e7] {
        let next = error(stiffness)?;
        let order = (last / next).log2();
        assert!(is_near(order, 1.0, 0.02), "order {order} in 1/sqrt(k)");
        last = next;
    }
    Ok(())
}

#[test]
fn a_preloaded_stop_stands_in_for_a_strip() -> Outcome {
    let truth = Ratios::loaded().scene()?;
    let contact = Contact::of(&truth, 8.4)?;
    for likeness in [MatchedProperty::Penetration, MatchedProperty::Duration] {
        let ladder = ModelHierarchy {
            truth: truth.clone(),
            likeness,
        };
        for rung in [
            ContactLaw::Preloaded,
            ContactLaw::Hertz,
            ContactLaw::KelvinVoigt,
            ContactLaw::Rigid,
        ] {
            let like = Contact::of(&ladder.model(rung, 8.4)?, 8.4)?;
            assert_relative(like.restitution, contact.restitution, 10.0 * SOLVED);
            match likeness {
                _ if rung == ContactLaw::Rigid => assert_eq!(like.penetration, 0.0),
                MatchedProperty::Penetration => {
                    assert_relative(like.penetration, contact.penetration, 10.0 * SOLVED)
                }
                MatchedProperty::Duration => {
                    assert_relative(like.duration, contact.duration, 10.0 * SOLVED)
                }
            }
        }
    }
    Ok(())
}

#[test]
fn a_rigid_stop_has_no_soft_model() -> Outcome {
    let restitution = 0.6;
    let ladder = ModelHierarchy {
        truth: machine(Stop::Rigid { restitution }, 0.08),
        likeness: MatchedProperty::Penetration,
    };
    let contact = Contact::of(&ladder.truth, 5.0)?;
    assert_eq!((contact.restitution, contact.penetration), (0.6, 0.0));
    for rung in [ContactLaw::KelvinVoigt, ContactLaw::Hertz] {
        let error = ladder.model(rung, 5.0).expect_err("no finite stiffness");
        assert!(matches!(error, FidelityError::Unmatched { .. }), "{error}");
    }
    assert!(ladder.model(ContactLaw::KelvinVoigt, -1.0).is_err());
    Ok(())
}

#[test]
fn a_predicted_model_is_matched_at_its_own_velocity() -> Outcome {
    let ladder = ModelHierarchy {
        truth: Ratios::loaded().scene()?,
        likeness: MatchedProperty::Duration,
    };
    for rung in [ContactLaw::Rigid, ContactLaw::KelvinVoigt] {
        let (model, observed) = from_model(&ladder, rung, FLUNG)?;
        let velocity = from_truth(&observed)?;
        let again = Contact::of(&model, velocity)?;
        let own = Contact::of(&ladder.truth, velocity)?;
        assert_relative(again.restitution, own.restitution, 10.0 * GROWN);
    }
    Ok(())
}
