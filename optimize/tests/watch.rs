//! `softstop watch`: the page holds the run of `softstop simulate`.

use std::fs;
use std::path::Path;

use serde_json::Value;
use softstop_testing::report::Row;
use softstop_testing::{docs, number_in, words};

use crate::{Outcome, SOFTSTOP};

fn numbers(value: &Value) -> Vec<f64> {
    let values = value.as_array().expect("a list").iter();
    values.map(|it| it.as_f64().expect("a number")).collect()
}

/// The page of a run, and the motion in it.
fn page(folder: &Path, arguments: &[&str]) -> Outcome<(String, Value)> {
    let file = folder.join("page.html");
    let output = ["--output", file.to_str().ok_or("path")?];
    let summary = SOFTSTOP.json(&[&["watch"], arguments, &output].concat());
    assert_eq!(summary["files"]["html"], file.to_str().ok_or("path")?);
    let page = fs::read_to_string(file)?;
    let (_, motion) = page
        .split_once("<script type=\"application/json\" id=\"motion\">")
        .ok_or("no motion")?;
    let (motion, _) = motion.split_once("</script>").ok_or("no end")?;
    let motion = serde_json::from_str(motion)?;
    Ok((page, motion))
}

/// The rows of crossings.csv of the same run that are impacts or rebounds, and the summary's `impacts`.
fn crossings(arguments: &[&str]) -> (Vec<Row>, Value) {
    let report = SOFTSTOP.report(&format!("simulate {}", arguments.join(" ")));
    let mut hits = report.table("crossings.csv");
    hits.retain(|row| row["impact"] == "1" || row["kind"] == "rebound");
    (hits, report.at("impacts").clone())
}

/// Every impact of the run is on the page to the bit, and its time is the time of samples, one of which has its state.
fn holds_every_impact(arguments: &[&str]) -> Outcome<Value> {
    let folder = tempfile::tempdir()?;
    let (_, motion) = page(folder.path(), arguments)?;
    let (rows, impacts) = crossings(arguments);
    let hits = motion["hits"].as_array().ok_or("hits")?;
    assert_eq!(hits.len(), rows.len(), "{arguments:?}");
    let time = numbers(&motion["samples"]["time"]);
    let position = numbers(&motion["samples"]["position"]);
    assert!(time.is_sorted(), "{arguments:?}");
    for (hit, row) in hits.iter().zip(&rows) {
        for name in ["time", "position", "velocity_before", "velocity_after"] {
            assert_eq!(hit[name].as_f64(), Some(number_in(row, name)), "{name}");
        }
        assert_eq!(hit["impact"].to_string(), row["impact"]);
        let at = hit["time"].as_f64().ok_or("time")?;
        let index = time.partition_point(|it| *it <= at) - 1;
        assert_eq!(time[index], at, "{arguments:?}: no sample at an impact");
        assert_eq!(Some(position[index]), hit["position"].as_f64());
    }
    let count = hits.iter().filter(|hit| hit["impact"] == 1).count();
    assert_eq!(impacts["count"], count as u64);
    assert_eq!(
        [time[0], time[time.len() - 1]],
        numbers(&motion["span"])[..]
    );
    Ok(motion)
}

#[test]
fn the_page_holds_every_impact_of_every_stop() -> Outcome {
    let mut count = 0;
    for entry in fs::read_dir(docs("scenes"))? {
        let path = entry?.path();
        let file = path.to_str().ok_or("path")?;
        let motion = holds_every_impact(&[file, "--periods", "9"])?;
        count += motion["hits"].as_array().ok_or("hits")?.len();
        assert_eq!(motion["machine"]["language"], "si");
        assert_eq!(motion["labels"]["position"], "position x (m)");
    }
    assert!(count > 300, "{count}");
    Ok(())
}

#[test]
fn ratios_speak_ratios_and_take_the_options_of_simulate() -> Outcome {
    let line = "--set eta=1.2 --set rho=9 --position 0.5 --velocity 12 --periods 15";
    let motion = holds_every_impact(&words(line))?;
    assert_eq!(motion["machine"]["language"], "ratios");
    assert_eq!(motion["labels"]["position"], "position x");
    assert_eq!(motion["samples"]["position"][0], 0.5);
    assert_eq!(motion["samples"]["velocity"][0], 12.0);
    assert_eq!(motion["places"]["stop"], 9.0);
    Ok(())
}

#[test]
fn strips_are_pierced_one_after_the_other_and_missing_where_asked() -> Outcome {
    let folder = tempfile::tempdir()?;
    let line = words("loaded --periods 12 --position 4.8 --velocity 11.9");
    let kinds = |motion: &Value, which: &str| {
        let strips = motion["strips"].as_array().expect("strips").iter();
        strips.filter(|it| it[1] == which).count()
    };
    let motion = holds_every_impact(&line)?;
    let pierced = |motion: &Value| kinds(motion, "pierced");
    assert_eq!((pierced(&motion), kinds(&motion, "missing")), (12, 0));
    let (_, motion) = page(
        folder.path(),
        &[&line[..], &["--missing-strips", "5:7"]].concat(),
    )?;
    assert_eq!((pierced(&motion), kinds(&motion, "missing")), (9, 3));
    let phases = motion["phases"].as_array().ok_or("phases")?;
    assert!(phases.iter().any(|it| it["kind"] == "gap"));
    Ok(())
}

#[test]
fn the_last_periods_alone_are_shown() -> Outcome {
    let folder = tempfile::tempdir()?;
    let line = words("loaded --periods 50 --last 3");
    let (_, motion) = page(folder.path(), &line)?;
    let period = motion["drive"]["period"].as_f64().ok_or("period")?;
    assert_eq!(numbers(&motion["span"])[0], 47.0 * period);
    let (mut last, _) = crossings(&line[..3]);
    last.retain(|row| number_in(row, "time") >= 47.0 * period);
    assert_eq!(motion["hits"].as_array().map(Vec::len), Some(last.len()));
    assert_eq!(motion["samples"]["time"][0], motion["span"][0]);
    Ok(())
}

#[test]
fn the_page_needs_nothing_from_elsewhere() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("odd.toml");
    let rigid = fs::read_to_string(docs("scenes/rigid.toml"))?;
    let name = "name = \"</script><b>odd</b>{{motion.js}}\"\n";
    fs::write(&file, name.to_owned() + &rigid)?;
    let (page, motion) = page(folder.path(), &[file.to_str().ok_or("path")?])?;
    assert_eq!(motion["title"], "</script><b>odd</b>{{motion.js}}");
    assert_eq!(page.matches("</script>").count(), 2);
    for word in ["http://", "https://", "src=", "@import", "url(", "fetch("] {
        let found = page.replace("url(#in-", "").find(word);
        assert_eq!(found, None, "{word}");
    }
    assert!(page.contains("default-src 'none'"));
    Ok(())
}
