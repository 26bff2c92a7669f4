//! Machine files and changes that are refused, with line, key, value and range.

use softstop::Machine;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// What is said of a file.
fn complaint(text: &str) -> String {
    match Machine::from_toml(text) {
        Ok(_) => String::new(),
        Err(error) => error.to_string(),
    }
}

#[test]
fn wrong_files_are_told_with_line_key_value_and_range() {
    let good = "mass = 1\nstiffness = 1\ndamping = 0.04\nclearance = 10\ncontact.damping = 0.18\n\
                [excitation]\namplitude = 1\nfrequency = 1.15\n\
                [stop]\nmodel = \"preloaded\"\nstiffness = 7\npreload = 70\n[start]\nposition = 1\n";
    assert_eq!(complaint(good), "");
    let cases: [(&str, &str, &[&str]); 13] = [
        ("mass = 1", "mass = 0", &["line 1", "mass = 0", "> 0"]),
        (
            "stiffness = 7",
            "stiffness = -7",
            &["line 11", "stop.stiffness = -7", ">= 0"],
        ),
        (
            "contact.damping",
            "contact.dampign",
            &[
                "line 5",
                "did you mean contact.damping?",
                "initial.position",
            ],
        ),
        ("contact.damping = 0.18", "", &["contact.damping"]),
        (
            "contact.damping",
            "beta",
            &["did you mean contact.damping?"],
        ),
        (
            "preload = 70",
            "preload = 70\npreload_deflection = 10",
            &["stop.preload", "one of the two"],
        ),
        (
            "[start]\nposition",
            "[initial]\nposition = nan\nvelocity",
            &["line 14", "initial.position = NaN"],
        ),
        (
            "preload = 70",
            "preload = 1e300",
            &["line 12", "stop.preload = 1e300", "at most 1e24"],
        ),
        (
            "[start]",
            "[strat]",
            &["line 14", "did you mean initial.position?"],
        ),
        (
            "frequency = 1.15",
            "frequency = 1.15\nfrequency_hz = 50",
            &["one of the two"],
        ),
        (
            "preload = 70",
            "preload = \"much\"",
            &["line 12", "preload", "much"],
        ),
        (
            "[start]",
            "[ratios]\nclearance = 3\n[start]",
            &["line 1", "mass"],
        ),
        ("model = \"preloaded\"", "model = \"hertz\"", &["preload"]),
    ];
    let beside = "damping = 0.02\n[ratios]\ndamping = 0.02\n";
    assert!(complaint(beside).contains("damping: must stand in [ratios]"));
    for (from, to, words) in cases {
        let said = complaint(&good.replacen(from, to, 1));
        for word in words {
            assert!(said.contains(word), "{to}: {word:?} is not in {said:?}");
        }
    }
}

#[test]
fn changes_that_fit_no_machine_are_refused() -> Outcome {
    let mut unloaded = Machine::named("unloaded").ok_or("none")?;
    type Case<'a> = (&'a [(&'a str, &'a str)], &'a [&'a str]);
    let cases: [Case<'_>; 11] = [
        (
            &[("clearence", "3")],
            &["clearence", "did you mean clearance?"],
        ),
        (&[("stop.stifness", "3")], &["did you mean stop.stiffness?"]),
        (&[("mass", "3")], &["mass", "it has damping"]),
        (
            &[("piercing.thickness", "0.4")],
            &["piercing.thickness", "no such parameter"],
        ),
        (&[("clearance", "wide")], &["clearance = wide", "number"]),
        (&[("clearance", "nan")], &["clearance = NaN", "finite"]),
        (&[("damping", "-1")], &["damping = -1", ">= 0"]),
        (&[("clearance", "1e160")], &["clearance = 1e160", "1e24"]),
        (
            &[("foo", "1")],
            &[
                "foo",
                "stop.model",
                "stop.preload_deflection",
                "initial.position",
            ],
        ),
        (
            &[("stop.model", "rigid")],
            &["missing key `stop.restitution`"],
        ),
        (&[("rho", "3"), ("clearance", "4")], &["clearance", "twice"]),
    ];
    for (changes, words) in cases {
        let error = unloaded.clone().apply(changes.iter().copied());
        let said = error.err().ok_or("accepted")?.to_string();
        for word in words {
            assert!(
                said.contains(word),
                "{changes:?}: {word:?} is not in {said:?}"
            );
        }
    }
    unloaded.apply([("initial.position", "2"), ("initial.velocity", "-1")])?;
    assert_eq!(
        (unloaded.start.position, unloaded.start.velocity),
        (2.0, -1.0)
    );
    Ok(())
}

/// The line of a key far down in a long file; other keys are as long as they like.
#[test]
fn the_line_of_an_unknown_key_is_told_in_a_long_file() {
    let keys: String = (0..60_000).map(|key| format!("k{key} = 1\n")).collect();
    let long = format!("{} = 1\n", "k".repeat(500_000));
    for keys in [keys, long] {
        let told = complaint(&format!("mass = 1\n[start]\n{keys}"));
        assert!(told.starts_with("line 3: initial.k"), "{}", &told[..80]);
        assert!(told.contains("unknown key; known are"));
    }
}

#[test]
fn names_have_no_control_characters() -> Outcome {
    let good = "mass = 1\nstiffness = 1\ndamping = 0.04\nclearance = 10\ncontact.damping = 0.18\n\
                excitation = { amplitude = 1, frequency = 1.15 }\nstop = { model = \"none\" }\n";
    for text in ["\\u001b[31m", "\\u0000", "a\\nb", "\\u009b", "\\u007f"] {
        let told = complaint(&format!("name = \"{text}\"\n{good}"));
        assert!(
            told.contains("name = ") && told.contains("control characters"),
            "{text}: {told}"
        );
        assert!(!told.contains(char::is_control), "{text}: {told:?}");
    }
    assert_eq!(
        complaint(&format!("description = \"a\\n\\tb\"\n{good}")),
        ""
    );
    assert!(complaint(&format!("description = \"\\u001b\"\n{good}")).contains("description = "));
    let mut machine = Machine::from_toml(good)?;
    assert!(machine.apply([("name", "a\u{7}")]).is_err());
    Ok(())
}
