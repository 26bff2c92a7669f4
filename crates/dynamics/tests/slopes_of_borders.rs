//! Normals of the borders of z = 1, against the borders of machines beside.

use crate::branches;
use softstop::{Parameter, Ratios, Scene};
use softstop_dynamics::continuation::{SpecialKind, SwitchingSurface, TestFunction};
use softstop_dynamics::derivatives::{Border, BorderKind};
use softstop_dynamics::{ParameterFamily, orbit, zone};
use softstop_testing::tangent::differences_of;
use softstop_testing::tolerance::DIFFERENCED;
use softstop_testing::{assert_near, rigid_stop};

/// The paper's machines.
fn zones() -> Vec<Scene> {
    [Ratios::unloaded(), Ratios::loaded()]
        .map(|ratios| ratios.scene().expect("valid"))
        .to_vec()
}

#[test]
fn normals_are_those_of_zones_computed_anew() {
    for scene in zones() {
        let parameters: Vec<Parameter> = Parameter::ALL
            .into_iter()
            .filter(|parameter| parameter.get(&scene).is_some())
            .collect();
        let of = |scene: &Scene| zone::hysteresis(scene).expect("a zone");
        let zone = of(&scene);
        let fold = Border::at_special(
            &scene,
            1,
            (TestFunction::Fold, &zone.high.point),
            &parameters,
        )
        .expect("smooth");
        let free = Border::at_g0(&scene, true, &parameters).expect("grazes");
        for (index, parameter) in parameters.into_iter().enumerate() {
            if matches!(parameter, Parameter::Frequency | Parameter::Phase) {
                continue;
            }
            let value = parameter.get(&scene).expect("it has");
            let width = 1e-4 * value.abs().max(0.05);
            let frequencies = |shift: f64| {
                let mut scene = scene.clone();
                parameter.set(&mut scene, value + shift);
                let zone = of(&scene);
                Some(vec![zone.high.frequency, zone.frequency_g0])
            };
            let found = differences_of(frequencies, width).expect("zones");
            for ((found, _), border) in found.into_iter().zip([&fold, &free]) {
                assert!(
                    (found + border.normal[index]).abs() < DIFFERENCED * (1.0 + found.abs()),
                    "{parameter:?} of {:?}: {found} {}",
                    border.kind,
                    border.normal[index]
                );
            }
        }
    }
}

/// The special points of z = 1 over the frequency, of the paper's machines and one with a rigid stop behind.
fn borders(scene: &Scene) -> Vec<Border> {
    let parameters: Vec<Parameter> = Parameter::ALL
        .into_iter()
        .filter(|parameter| parameter.get(scene).is_some())
        .collect();
    let family = ParameterFamily::new(scene.clone(), [Parameter::Frequency]).expect("valid");
    let state = orbit::find(scene).expect("an orbit").state();
    let from = (scene.excitation.frequency, state);
    let branch = branches::follow(&family, 1, from, (0.8, 1.6), 2000).expect("a branch");
    let specials = branch.specials.iter();
    specials
        .map(|it| Border::at_special(scene, 1, (it.kind, &it.point), &parameters).expect("smooth"))
        .collect()
}

#[test]
fn normals_are_those_of_borders_found_again() {
    let [unloaded, loaded] = [Ratios::unloaded(), Ratios::loaded()];
    let scenes = [unloaded, loaded].map(|ratios| ratios.scene().expect("valid"));
    let walled = scenes[0].clone();
    let walled = Scene {
        rigid: Some(rigid_stop(1.0, 0.6)),
        ..walled
    };
    let mut kinds = Vec::new();
    for border in scenes.iter().chain([&walled]).flat_map(borders) {
        kinds.push(border.kind);
        for (parameter, normal) in border.parameters.iter().zip(&border.normal) {
            if *parameter == Parameter::Frequency {
                assert_eq!(*normal, 1.0);
                continue;
            }
            let value = parameter.get(&border.scene).expect("it has");
            let width = 1e-4 * value.abs().max(0.05);
            let frequency = |shift: f64| {
                let mut scene = border.scene.clone();
                parameter.set(&mut scene, value + shift);
                Some(vec![
                    border.find_again(&scene).expect("is there").frequency(),
                ])
            };
            let found = differences_of(frequency, width).expect("is there")[0].0;
            let size = 1.0 + found.abs();
            assert_near(-found, *normal, 0.01 * DIFFERENCED * size);
        }
    }
    let has = |is: fn(&SpecialKind) -> bool| {
        let mut kinds = kinds.iter();
        kinds.any(|kind| matches!(kind, BorderKind::Motion(kind) if is(kind)))
    };
    let touches = |surface: SwitchingSurface| {
        let on = |kind: &BorderKind| matches!(kind, BorderKind::Motion(SpecialKind::Grazing(graze)) if graze.surface == surface);
        kinds.iter().any(on)
    };
    assert!(has(
        |kind| *kind == SpecialKind::Critical(TestFunction::Fold)
    ));
    assert!(has(
        |kind| *kind == SpecialKind::Critical(TestFunction::Flip)
    ));
    assert!(
        [
            SwitchingSurface::Clearance,
            SwitchingSurface::Stop,
            SwitchingSurface::Wall
        ]
        .into_iter()
        .all(touches)
    );
}
