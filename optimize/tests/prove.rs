//! `softstop prove` as users and scripts meet it. `tests/fmpy/test_certificates.py` has its certificates checked.

use softstop_testing::report::at;
use softstop_testing::words;

use crate::{Outcome, SOFTSTOP};

#[test]
fn a_proof_is_printed_and_written() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("a.json").display().to_string();
    let text = SOFTSTOP.text(&["prove", "A", "--output", &file]);
    for words in [
        "Proven: a motion z = 1\n",
        "stable\n",
        "free   stop",
        "[6.4946274293",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let written: serde_json::Value = serde_json::from_slice(&std::fs::read(&file)?)?;
    assert_eq!(written["claim"], "orbit");
    assert_eq!(at(&written, "machine/name"), "unloaded");
    assert_eq!(written["events"].as_array().map(Vec::len), Some(2));
    let line = ["prove", "A", "--format", "json", "--output", &file];
    let printed: serde_json::Value = serde_json::from_str(&SOFTSTOP.text(&line))?;
    assert_eq!(printed, written);
    Ok(())
}

#[test]
fn what_cannot_be_proven_is_told_and_nothing_written() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("proof.json");
    let output = format!("--output {}", file.display());
    let scenes = softstop_testing::docs("scenes");
    let cases = [
        (format!("{}/hertz.toml", scenes.display()), 2, "hertz"),
        (format!("{}/none.toml", scenes.display()), 2, "no stop"),
        (
            "A --set eta=0.9526475".to_owned(),
            1,
            "no stable z = 1/1 motion",
        ),
        (
            "loaded --at grazing".to_owned(),
            1,
            "turns on the very surface",
        ),
    ];
    for (line, code, told) in cases {
        SOFTSTOP.ends_with(&words(&format!("prove {line} {output}")), code, &[told]);
        assert!(!file.exists(), "{line}");
    }
    Ok(())
}

#[test]
fn a_design_comes_with_its_proof() -> Outcome {
    let folder = tempfile::tempdir()?;
    let output = folder.path().display().to_string();
    let line = "optimize --evaluations 100 --no-report --samples 10 --prove --output";
    let text = SOFTSTOP.text(&[&words(line)[..], &[&output]].concat());
    assert!(text.contains("Proven by interval arithmetic\n"), "{text}");
    let read = |name: &str| -> Outcome<serde_json::Value> {
        Ok(serde_json::from_slice(&std::fs::read(
            folder.path().join(name),
        )?)?)
    };
    let (design, proof) = (read("design.json")?, read("proof.json")?);
    assert_eq!(at(&design, "proof/stability"), "stable");
    assert_eq!(
        at(&design, "files/proof_json")
            .as_str()
            .map(|it| it.ends_with("proof.json")),
        Some(true)
    );
    let velocity = at(&design, "design/before_impact_velocity").as_f64();
    let bounds = [0, 1].map(|it| at(&proof, &format!("enclosure/2/{it}")).as_f64());
    assert!(
        bounds[0] <= velocity && velocity <= bounds[1],
        "{velocity:?} {bounds:?}"
    );
    Ok(())
}
