//! Machine files and changes that are refused, with line, key, value and range.

use serde::Deserialize;
use softstop::Machine;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// What is said of a file.
fn complaint(text: &str) -> String {
    match Machine::from_toml(text) {
        Ok(_) => String::new(),
        Err(error) => error.to_string(),
    }
}

#[derive(Deserialize)]
struct Refusals {
    good: String,
    file: Vec<File>,
    change: Vec<Change>,
}

#[derive(Deserialize)]
struct File {
    from: String,
    to: String,
    says: Vec<String>,
}

#[derive(Deserialize)]
struct Change {
    keys: Vec<(String, String)>,
    says: Vec<String>,
}

fn refusals() -> Refusals {
    toml::from_str(include_str!("machine_refusals.toml")).expect("a list")
}

#[test]
fn wrong_files_are_told_with_line_key_value_and_range() {
    let Refusals { good, file, .. } = refusals();
    assert_eq!(complaint(&good), "");
    let beside = "damping = 0.02\n[ratios]\ndamping = 0.02\n";
    assert!(complaint(beside).contains("damping: must stand in [ratios]"));
    for File { from, to, says } in file {
        let said = complaint(&good.replacen(&from, &to, 1));
        for word in says {
            assert!(said.contains(&word), "{to}: {word:?} is not in {said:?}");
        }
    }
}

#[test]
fn changes_that_fit_no_machine_are_refused() -> Outcome {
    let mut unloaded = Machine::named("unloaded").ok_or("none")?;
    for Change { keys, says } in refusals().change {
        let pairs = keys
            .iter()
            .map(|(key, value)| (key.as_str(), value.as_str()));
        let error = unloaded.clone().apply(pairs).err().ok_or("accepted")?;
        let said = error.to_string();
        for word in says {
            assert!(
                said.contains(&word),
                "{keys:?}: {word:?} is not in {said:?}"
            );
        }
    }
    unloaded.apply([("initial.position", "2"), ("initial.velocity", "-1")])?;
    let start = unloaded.start;
    assert_eq!((start.position, start.velocity), (2.0, -1.0));
    Ok(())
}

/// Time scales that lie too far apart are told by what was changed, whose limit holds.
#[test]
fn what_was_changed_is_named_with_its_limit() -> Outcome {
    let good = Machine::from_toml(&refusals().good)?;
    for (key, value) in [
        ("mass", 1e-308),
        ("stiffness", 1e24),
        ("excitation.frequency", 1e-9),
    ] {
        let error = |value: f64| {
            let error = good.clone().apply([(key, &*value.to_string())]).err();
            error.map(|error| error.to_string())
        };
        let told = error(value).ok_or("accepted")?;
        let words: Vec<&str> = told.split_whitespace().collect();
        let at = words
            .iter()
            .position(|word| ["least", "most"].contains(word));
        let limit: f64 = words[at.ok_or("no limit")? + 1].parse()?;
        assert!(told.starts_with(&format!("{key} = ")), "{told}");
        let beyond = 1e-9 * (value - limit).signum();
        assert_eq!(error(limit * (1.0 - beyond)), None, "{told}");
        assert!(error(limit * (1.0 + beyond)).is_some(), "{told}");
    }
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
