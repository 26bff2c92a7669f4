//! Motions proven.

use std::ops::ControlFlow;

use softstop::{Parameter, Ratios, Scene};
use softstop_dynamics::continuation::{SpecialKind, Test};
use softstop_dynamics::{Continuation, Limits, ParameterFamily, orbit};
use softstop_prove::{Certificate, Claim, Touch};

fn write(name: &str, proof: &Certificate) {
    let text = serde_json::to_string_pretty(proof).expect("JSON");
    std::fs::write(format!("target/{name}.json"), text).expect("written");
}

#[test]
fn points_a_and_b() {
    for (name, ratios) in [("a", Ratios::unloaded()), ("b", Ratios::loaded())] {
        let scene = ratios.scene().expect("a scene");
        let orbit = orbit::find(&scene).expect("an orbit");
        let proof = Certificate::new(&scene, orbit.state(), 1, Claim::Orbit).expect("a proof");
        write(name, &proof);
    }
}

fn specials(name: &str, scene: &Scene) {
    let orbit = orbit::find(scene).expect("an orbit");
    let family = ParameterFamily::new(scene.clone(), [Parameter::Frequency]).expect("a family");
    let limits = Limits {
        range: (0.9, 1.7),
        points: 2000,
    };
    let branch = Continuation::new(&family, 1)
        .branch(scene.excitation.frequency, orbit.state(), &limits, |_| {
            ControlFlow::Continue(())
        })
        .expect("a branch");
    for (index, special) in branch.specials.iter().enumerate() {
        let claim = match special.kind {
            SpecialKind::Critical(Test::Fold) => Claim::Fold,
            SpecialKind::Critical(Test::Flip) => Claim::Flip,
            SpecialKind::Grazing(graze) => Claim::Grazing(Touch {
                angle: graze.angle,
                position: graze.face.position(scene).expect("a face"),
            }),
            _ => continue,
        };
        let scene = scene.at_frequency(special.point.parameter);
        match Certificate::new(&scene, special.point.state(), 1, claim) {
            Ok(proof) => {
                println!("{name} {index} {:?} {:?}", special.kind, proof.frequency);
                write(&format!("{name}{index}"), &proof);
            }
            Err(error) => println!(
                "{name} {index} {:?} {}: {error}",
                special.kind, special.point.parameter
            ),
        }
    }
}

#[test]
fn bifurcations() {
    specials("sa", &Ratios::unloaded().scene().expect("a scene"));
    specials("sb", &Ratios::loaded().scene().expect("a scene"));
}
