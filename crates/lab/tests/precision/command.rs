//! The command `softstop-lab chart precision`: its files, its page and its messages.

use super::*;

const PROGRAM: Program = Program {
    file: env!("CARGO_BIN_EXE_softstop-lab"),
    first: &["chart", "precision"],
};

/// Runs a scene as fast as may be and returns the JSON of its one chart.
fn chart(scene: &str, folder: &Path, more: &[&str]) -> Result<Value, Box<dyn std::error::Error>> {
    let folder = folder.to_str().ok_or("path")?;
    let basic = [scene, "--quick", "--output", folder];
    let mut report = PROGRAM.json(&[&basic[..], more].concat());
    Ok(report["charts"][0].take())
}

#[test]
fn json_and_csv_have_a_row_for_every_setting_of_every_method() -> Outcome {
    let folder = tempfile::tempdir()?;
    let report = chart(
        "chatter",
        folder.path(),
        &["--periods", "0.9", "--budget", "0.02"],
    )?;
    let rows = report["rows"].as_array().ok_or("rows")?;
    let families = family::all(&case("chatter", 0.9)?.machine.scene, true);
    let settings = families.iter().map(|family| family.settings.len());
    assert_eq!(rows.len(), settings.sum::<usize>());
    for family in &families {
        let own = rows.iter().filter(|row| row["method"] == *family.name);
        assert_eq!(own.count(), family.settings.len(), "{}", family.name);
    }
    for row in rows {
        let done = row["status"] == "done";
        assert_eq!(done, row["end_error"].is_number(), "{row}");
        assert_eq!(
            done,
            row["seconds"].as_f64().is_some_and(|s| s > 0.0),
            "{row}"
        );
        assert_eq!(done, row["reason"].is_null(), "{row}");
    }
    assert_eq!(rows[0]["method"], "exact");
    assert!(rows[0]["end_error"].as_f64().ok_or("error")? < 1e-14);
    assert!(report["reference"]["digits"].as_u64().ok_or("digits")? >= 40);
    assert!(!report["lead"]["at"].as_array().ok_or("lead")?.is_empty());
    for key in ["cpu", "cores", "os", "rustc"] {
        assert!(!report["machine"][key].is_null(), "{key}");
    }
    let table = fs::read_to_string(folder.path().join("chatter.csv"))?;
    assert_eq!(table.lines().count(), 1 + rows.len());
    let file: Value = serde_json::from_slice(&fs::read(folder.path().join("chatter.json"))?)?;
    assert_eq!(file["rows"], report["rows"]);
    let drawn = fs::read_to_string(folder.path().join("chatter.svg"))?;
    // A curve has the name of its method; those that ignore events share one.
    assert!(drawn.contains(">events ignored</text>"));
    let mut done = rows.iter().filter(|row| row["status"] == "done");
    let seeing = families.iter().filter(|family| !family.look.blind);
    let seeing: Vec<&str> = seeing.map(|family| &*family.name).collect();
    assert!(done.all(|row| {
        let name = row["method"].as_str().unwrap_or_default();
        let written = format!(">{}</text>", family::short_name(name));
        !seeing.contains(&name) || drawn.contains(&written)
    }));
    Ok(())
}

#[test]
fn any_scene_file_can_be_measured() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("my machine.toml");
    fs::copy(docs("scenes").join("kelvin-voigt.toml"), &file)?;
    let more = [
        "--periods",
        "2",
        "--method",
        "RK4",
        "--method",
        "tsit45",
        "--budget",
        "0.05",
    ];
    let report = chart(file.to_str().ok_or("path")?, folder.path(), &more)?;
    assert_eq!(report["scene"], "my machine");
    let mut names: Vec<&str> = report["rows"]
        .as_array()
        .ok_or("rows")?
        .iter()
        .filter_map(|row| row["method"].as_str())
        .collect();
    names.dedup();
    let expected = [
        "exact",
        "RK4, events located",
        "RK4, events ignored",
        "diffsol tsit45",
    ];
    assert_eq!(names, expected);
    assert!(folder.path().join("my machine.svg").is_file());
    Ok(())
}

#[test]
fn every_built_in_scene_is_on_the_page_with_its_chart() -> Outcome {
    let page = fs::read_to_string(docs("accuracy.md"))?;
    for built_in in BUILT_IN {
        let chart = format!("accuracy/{}.svg", built_in.name);
        assert!(page.contains(&format!("({chart})")), "{chart}");
        let drawn = fs::read_to_string(docs(&chart))?;
        assert!(drawn.contains(built_in.title), "{chart}");
        assert!(drawn.len() < 200_000, "{chart}");
        let cases = case::cases(built_in.name, None).map_err(|failure| failure.to_string())?;
        assert_eq!(cases.len(), 1);
    }
    Ok(())
}

#[test]
fn help_teaches_by_example() {
    let text = PROGRAM.text(&["--help"]);
    assert!(
        text.contains("Examples:\n  softstop-lab chart precision"),
        "{text}"
    );
    for built_in in BUILT_IN {
        assert!(text.contains(built_in.name), "{}", built_in.name);
    }
}
