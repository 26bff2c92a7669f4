//! Machines with parameters that follow others, in the commands: their answers are those of machines that state each value
//! by hand.

use std::fs;

use softstop_testing::{assert_near, number, number_in};

use crate::{Outcome, SOFTSTOP};

/// An impact rig whose drive is an unbalance: F0 = 0.7 w^2.
const RIG: &str = "mass = 1.0\nstiffness = 1.0\ndamping = 0.04\nclearance = 3.0\ncontact.damping = 0.18\n\
    excitation = { amplitude = \"0.7 * excitation.frequency^2\", frequency = 1.15 }\n\
    stop = { model = \"preloaded\", stiffness = 29.0, preload = 5.0 }\ninitial.velocity = 5.0\n";

/// Each command along the frequency of an unbalance.
#[test]
fn an_unbalance_is_swept_studied_and_followed_over_its_frequency() -> Outcome {
    let folder = tempfile::tempdir()?;
    let rig = folder.path().join("rig.toml");
    fs::write(&rig, RIG)?;
    let rig = rig.display();
    let by_hand = |frequency: f64| {
        let amplitude = 0.7 * frequency * frequency;
        format!(
            "{rig} --set excitation.frequency={frequency} --set excitation.amplitude={amplitude}"
        )
    };
    let study = format!(
        "machine = \"{rig}\"\noutputs = [\"z\", \"velocity\"]\n[[axis]]\nparameter = \"excitation.frequency\"\n\
         values = [1.1, 1.2, 1.3]\n"
    );
    let report = SOFTSTOP.report_of("study.toml", &study, "study FILE --csv");
    for row in report.table("study.csv") {
        let frequency = number_in(&row, "excitation.frequency");
        let motions = SOFTSTOP.value(&format!("orbit {}", by_hand(frequency)));
        let velocity = number(&motions, "before_impact_velocity");
        assert_near(number_in(&row, "velocity"), velocity, 1e-9);
    }
    // Where the branch folds, that of the machine with the amplitude there folds as well.
    let fold_of = |machine: &str| {
        let line =
            format!("continue {machine} --parameter excitation.frequency --from 0.9 --to 2.5");
        let branch = SOFTSTOP.report(&line);
        let specials = branch.list("branches/0/specials").iter();
        let mut folds = specials.filter(|it| it["symbol"] == "SN");
        folds.next().map(|fold| number(fold, "value"))
    };
    let frequency = fold_of(&rig.to_string()).ok_or("no fold")?;
    let amplitude = 0.7 * frequency * frequency;
    let by_hand = fold_of(&format!("{rig} --set excitation.amplitude={amplitude}"));
    assert_near(by_hand.ok_or("no fold")?, frequency, 1e-9);
    // What follows is neither varied nor made within tolerances.
    let ways = folder.path().join("ways.toml");
    let opened = "[require]\nrun_up = { ways = [\"clearance_opened\"] }\n";
    let rigs = RIG.replace("preload = 5.0", "preload = \"2 + clearance\"");
    fs::write(&ways, rigs + opened)?;
    let task = folder.path().join("task.toml");
    fs::write(&task, format!("{RIG}[tolerance]\nclearance = \"1 %\"\n"))?;
    for (command, says) in [
        (
            format!("sweep {rig} --parameter excitation.amplitude --from 0.5 --to 1"),
            "follows others, as \"0.7 *",
        ),
        (
            format!("fidelity {rig} --structure"),
            "excitation.amplitude: follows the drive's frequency",
        ),
        (
            format!("sweep {rig} --set mass=excitation.frequency --parameter eta --from 1 --to 2"),
            "its unit sqrt(k1/m) follows",
        ),
        (
            "optimize unloaded --set eta=1.15*rho/10".to_owned(),
            "follows others",
        ),
        (
            "sweep loaded --set rho=10*eta --from 1 --to 1.2 --clearances 8,9".to_owned(),
            "follows others",
        ),
        (
            format!("prove {rig} --at fold"),
            "excitation.amplitude: follows the drive's frequency",
        ),
        (
            format!("optimize {}", ways.display()),
            "a small one: stop.preload follows clearance",
        ),
        (
            format!("optimize {}", task.display()),
            "tolerance.clearance: no machine with tolerances may have values that follow excitation.frequency",
        ),
        (
            format!("zone {rig} --set excitation.frequency=mass"),
            "excitation.frequency: follows others",
        ),
    ] {
        let words: Vec<&str> = softstop_testing::words(&command);
        SOFTSTOP.refuses(&words, &[says]);
    }
    Ok(())
}

/// The zone, its outputs in a study and the best design of an unbalance, each beside machines with the amplitude there as a
/// number: a fold and a grazing are those of the machine with the amplitude that they have.
#[test]
fn zones_and_designs_follow_what_follows_the_frequency() -> Outcome {
    let folder = tempfile::tempdir()?;
    let rig = folder.path().join("rig.toml");
    fs::write(&rig, RIG)?;
    let rig = rig.display().to_string();
    let by_hand = |frequency: f64| {
        let amplitude = 0.7 * frequency * frequency;
        format!("{rig} --set excitation.amplitude={amplitude}")
    };
    let zone = SOFTSTOP.value(&format!("zone {rig}"));
    let ends = ["frequency_g0", "frequency_sn"].map(|end| number(&zone, end));
    for (end, frequency) in ["frequency_g0", "frequency_sn"].iter().zip(ends) {
        let own = SOFTSTOP.value(&format!("zone {}", by_hand(frequency)));
        assert_near(number(&own, end), frequency, 1e-9);
    }
    let study = format!(
        "machine = \"{rig}\"\noutputs = [\"frequency_sn\"]\n[[axis]]\nparameter = \"clearance\"\nvalues = [3.0, 4.0]\n"
    );
    let report = SOFTSTOP.report_of("study.toml", &study, "study FILE --csv");
    let rows = report.table("study.csv");
    assert_near(number_in(&rows[0], "frequency_sn"), ends[1], 1e-9);
    // Along a zone the hardest impact at its margin is found by going there.
    let line = format!(
        "optimize {rig} --vary clearance=3:3 --vary stop.stiffness=29:29 --margin 0.1 --no-report"
    );
    let design = SOFTSTOP.report(&line);
    let frequency = design.number("design/frequency");
    assert_near(frequency, ends[0] + 0.9 * (ends[1] - ends[0]), 1e-9);
    let machine = format!(
        "{} --set excitation.frequency={frequency}",
        by_hand(frequency)
    );
    let motion = SOFTSTOP.value(&format!("orbit {machine}"));
    let velocity = design.number("design/before_impact_velocity");
    assert_near(velocity, number(&motion, "before_impact_velocity"), 1e-9);
    Ok(())
}

/// A preload that is ten times the stiffness, as an expression, as a link and as a deflection of 10 m.
#[test]
fn a_design_with_an_expression_is_that_of_a_link() {
    let velocity = |preload: &str, vary: &str| {
        let text = format!(
            "mass = 1.0\nstiffness = 1.0\ndamping = 0.04\nclearance = 10.0\ncontact.damping = 0.18\n\
             excitation = {{ amplitude = 1.0, frequency = 1.15 }}\n\
             stop = {{ model = \"preloaded\", stiffness = 7.0, {preload} }}\n\
             [vary]\nstop.stiffness = [2.0, 30.0]\nclearance = [4.0, 20.0]\n{vary}\n[require]\nmargin = 0.1\n"
        );
        let report = SOFTSTOP.report_of("task.toml", &text, "optimize FILE --no-report");
        report.number("design/before_impact_velocity")
    };
    let tied = velocity("preload = \"10 * stop.stiffness\"", "");
    let link = "stop.preload = { follows = \"stop.stiffness\", factor = 10 }";
    assert_near(tied, velocity("preload = 70.0", link), 1e-9);
    assert_near(tied, velocity("preload_deflection = 10.0", ""), 1e-9);
}
