//! `softstop study` as users and scripts meet it.
#![cfg(unix)]

#[path = "study/columns.rs"]
mod columns;
#[path = "study/settled.rs"]
mod settled;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use approx::assert_abs_diff_eq;
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{RngCore, SeedableRng};
use softstop_testing::{Program, number_in, words};

use crate::{Outcome, SOFTSTOP};

const STUDY: Program = Program {
    first: &["study"],
    ..SOFTSTOP
};

/// The paper's machine over two grids, from the start of point A.
const MAP: &str = "machine = \"unloaded\"\noutputs = [\"z\", \"velocity\", \"max_position\"]\n\
    [[axis]]\nparameter = \"eta\"\nfrom = 1.05\nto = 1.4\ncount = 71\n\
    [[axis]]\nparameter = \"rho\"\nfrom = 4\nto = 14\ncount = 51\n";

fn written(folder: &Path, text: &str) -> Result<String, std::io::Error> {
    let path = folder.join("study.toml");
    fs::write(&path, text)?;
    Ok(path.display().to_string())
}

/// A table of results: names, and rows of cells.
fn table(folder: &Path) -> Result<(Vec<String>, Vec<Vec<String>>), std::io::Error> {
    let text = fs::read_to_string(folder.join("study.csv"))?;
    let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
    let mut lines = text.lines().map(cells);
    Ok((lines.next().unwrap_or_default(), lines.collect()))
}

fn bytes(folder: &Path) -> Result<[Vec<u8>; 2], std::io::Error> {
    let read = |name| fs::read(folder.join(name));
    Ok([read("study.parquet")?, read("study.csv")?])
}

#[test]
fn a_map_has_what_other_commands_find() -> Outcome {
    let folder = tempfile::tempdir()?;
    let study = written(folder.path(), MAP)?;
    let out = folder.path().join("out");
    let report = STUDY.json_into(&out, &[&study, "--csv"]);
    assert_eq!(report["points"], 71 * 51);
    assert_eq!(report["columns"][1]["values"], 71 * 51);
    let (names, rows) = table(&out)?;
    assert_eq!(
        names.join(","),
        "excitation.frequency,clearance,z,velocity,max_position"
    );
    // The last axis changes fastest: point A is the 21st frequency, the 31st clearance.
    let a = &rows[20 * 51 + 30];
    let numbers: Vec<f64> = a.iter().filter_map(|cell| cell.parse().ok()).collect();
    assert_abs_diff_eq!(numbers[0], 1.15, epsilon = 1e-12);
    assert_eq!((numbers[1], a[2].as_str()), (10.0, "1"));
    assert_abs_diff_eq!(numbers[3], 6.494_627, epsilon = 2e-5);
    assert_abs_diff_eq!(numbers[4], 10.260_59, epsilon = 2e-5);
    let plot = format!("plot {}", out.display());
    let drawn = STUDY.text(&words(&plot));
    assert!(
        drawn.contains("z over excitation.frequency and clearance: 3621 points"),
        "{drawn}"
    );
    assert!(fs::read(out.join("z.png"))?.starts_with(b"\x89PNG"));
    let line = format!("{plot} --of velocity --over");
    let told = ["--over eta", "excitation.frequency, clearance"];
    STUDY.refuses(&words(&format!("{line} eta")), &told);
    // Along one axis the first output that is no word is drawn.
    let slice = format!("{plot} --over excitation.frequency --at clearance=10.02");
    assert!(STUDY.text(&words(&slice)).contains("71 points"));
    assert!(fs::read_to_string(out.join("velocity.svg"))?.contains("clearance = 10"));
    Ok(())
}

#[test]
fn samples_stay_in_their_range_and_figures_agree() {
    let text = "outputs = [\"kind\", \"trace\", \"determinant\", \"largest_multiplier\", \"exponent\", \
        \"frequency_g0\", \"frequency_sn\", \"margin\", \"margin_sn\", \"certainty\", \"stop_force\"]\n\
        samples = 12\nseed = 3\n[certainty]\nstarts = 16\n\
        [[axis]]\nparameter = \"eta\"\nvalues = [1.15]\n\
        [[axis]]\nparameter = \"rho\"\nfrom = 9\nto = 11\nsample = \"sobol\"\n\
        [[axis]]\nparameter = \"k4\"\nfrom = 5\nto = 50\nscale = \"log\"\nsample = \"random\"\n";
    let report = STUDY.report_of("study.toml", text, "FILE --csv");
    let rows = report.table("study.csv");
    assert_eq!(rows.len(), 12);
    for row in rows {
        let number = |name| number_in(&row, name);
        assert!((9.0..=11.0).contains(&number("clearance")));
        assert!((5.0..=50.0).contains(&number("stop.stiffness")));
        let (sn, g0) = (number("frequency_sn"), number("frequency_g0"));
        let share = (1.15 - g0) / (sn - g0);
        assert_abs_diff_eq!(number("margin"), share.min(1.0 - share), epsilon = 1e-12);
        assert_abs_diff_eq!(number("margin_sn"), sn - 1.15, epsilon = 1e-12);
        assert!((0.0..=1.0).contains(&number("certainty")));
        assert_eq!(row["kind"], "periodic");
        let modulus = number("largest_multiplier");
        assert_abs_diff_eq!(number("exponent"), modulus.ln(), epsilon = 1e-9);
        assert!(modulus * modulus >= number("determinant") - 1e-9);
    }
}

#[test]
fn few_periods_are_watched_all() -> Outcome {
    let folder = tempfile::tempdir()?;
    let axis = "[[axis]]\nparameter = \"eta\"\nfrom = 1.1\nto = 1.2\ncount = 3\n";
    let of = |motion: &str, out: &str| -> Result<_, std::io::Error> {
        let study = format!(
            "machine = \"unloaded\"\noutputs = [\"z\", \"velocity\"]\n{axis}[motion]\n{motion}"
        );
        let out = folder.path().join(out);
        STUDY.json_into(&out, &[&written(folder.path(), &study)?, "--csv"]);
        table(&out)
    };
    assert_eq!(
        of("periods = 50", "a")?,
        of("periods = 50\nwatched = 50", "b")?
    );
    Ok(())
}

#[test]
fn shards_in_any_order_are_the_whole() -> Outcome {
    let folder = tempfile::tempdir()?;
    let study = written(folder.path(), MAP)?;
    let whole = folder.path().join("whole");
    STUDY.json_into(&whole, &[&study, "--csv"]);
    for shards in [2, 7] {
        let parts = folder.path().join(format!("parts-{shards}"));
        let mut files: Vec<PathBuf> = Vec::new();
        for number in (1..=shards).rev() {
            let shard = format!("{number}/{shards}");
            let report = STUDY.json_into(&parts, &[&study, "--shard", &shard]);
            files.push(report["file"].as_str().ok_or("no file")?.into());
            if number == 2 {
                let line = format!("merge {study} --output {}", parts.display());
                let of = format!("of the shards 1/{shards};");
                STUDY.ends_with(&words(&line), 1, &["missing", &of, "points 0 to 1023"]);
                assert!(!parts.join("study.parquet").exists());
            }
        }
        let merged = folder.path().join(format!("merged-{shards}"));
        let files: Vec<&str> = files.iter().filter_map(|file| file.to_str()).collect();
        let into = merged.display().to_string();
        STUDY.json(&[&["merge", &study, "--csv", "--output", &into], &files[..]].concat());
        assert_eq!(bytes(&merged)?, bytes(&whole)?);
    }
    Ok(())
}

/// Of a machine with long transients, by two threads and by one, all together, shuffled, in blocks and alone.
#[test]
fn a_row_does_not_depend_on_the_others() -> Outcome {
    let folder = tempfile::tempdir()?;
    let machine = "damping = 0.0010035920352690947\nclearance = 0.43389208459215656\nmass = 1\nstiffness = 1\n\
        excitation = { amplitude = 1, frequency = 1.3867421587045143 }\ncontact = { damping = 0.055312340888448 }\n\
        stop = { model = \"piecewiseLinear\", loading = [{ from = 0, stiffness = 7.724967006421391 }, \
        { from = 2.3699476894007003, stiffness = 40439.83555026721 }] }\n";
    fs::write(folder.path().join("machine.toml"), machine)?;
    let rows = |frequencies: &[f64], velocities: &[f64], threads: &str| {
        let text = format!(
            "machine = \"machine.toml\"\noutputs = [\"kind\", \"z\", \"velocity\", \"settled_within\", \"max_position\"]\n\
             [[axis]]\nparameter = \"excitation.frequency\"\nvalues = {frequencies:?}\n\
             [[axis]]\nparameter = \"initial.velocity\"\nvalues = {velocities:?}\n[motion]\nlongest = 2000\n"
        );
        let study = written(folder.path(), &text)?;
        let out = folder.path().join("out");
        let mut command = STUDY.command(&[&study, "--csv", "--output", &out.to_string_lossy()]);
        let status = command.env("RAYON_NUM_THREADS", threads).output()?.status;
        assert!(status.success());
        let mut rows: Vec<_> = table(&out)?.1;
        rows.sort();
        Ok::<_, std::io::Error>(rows)
    };
    let mut chance = SplitMix64::seed_from_u64(37);
    let mut between = |low: f64, high: f64| {
        let share = (chance.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        low + share * (high - low)
    };
    let mut frequencies: Vec<f64> = (0..30).map(|_| between(1.386, 1.388)).collect();
    let mut velocities: Vec<f64> = (0..30).map(|_| between(-3.0, 3.0)).collect();
    frequencies[7] = 1.3871499999999999;
    let all = rows(&frequencies, &velocities, "2")?;
    assert_eq!(all.len(), 900);
    for kind in ["periodic", "chaos", "unsettled"] {
        assert!(all.iter().any(|row| row[2] == kind), "{kind}");
    }
    frequencies.rotate_left(11);
    velocities.reverse();
    assert!(rows(&frequencies, &velocities, "1")? == all);
    let mut parts = Vec::new();
    for part in frequencies.chunks(7) {
        parts.extend(rows(part, &velocities, "2")?);
    }
    parts.sort();
    assert!(parts == all);
    for (frequency, velocity) in frequencies.iter().zip(&velocities) {
        assert!(all.contains(&rows(&[*frequency], &[*velocity], "1")?[0]));
    }
    Ok(())
}

#[test]
fn what_cannot_be_is_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let axis = "[[axis]]\nparameter = \"rho\"\nfrom = 4\nto = 14\n";
    let cases: [(String, &[&str]); 10] = [
        (
            format!("output = []\n{axis}"),
            &["unknown field `output`", "outputs", "study.toml"],
        ),
        (
            MAP.replace("\"rho\"", "\"weight\""),
            &["axis weight", "unknown key", "clearance", "study.toml"],
        ),
        (
            MAP.replace("\"rho\"", "\"sigma\""),
            &["axis sigma", "has no", "clearance"],
        ),
        (
            MAP.replace("from = 4", "from = nan"),
            &["axis rho", "finite"],
        ),
        (
            MAP.replace("count = 71", "count = 1000000")
                .replace("count = 51", "count = 1000000"),
            &["1e12 points", "at most 4000000000"],
        ),
        (
            MAP.replace("\"z\",", "\"zed\","),
            &["\"zed\" is not known", "impacts_per_period"],
        ),
        (
            format!("outputs = [\"z\"]\n{axis}sample = \"sobol\"\n"),
            &["samples: must say"],
        ),
        (
            format!("outputs = [\"z\"]\n{axis}"),
            &["axis rho", "from, to and count"],
        ),
        (
            MAP.replace("\"eta\"", "\"damping\"")
                .replace("from = 1.05", "from = -0.05"),
            &["axis damping", "-0.05", ">= 0"],
        ),
        (
            format!("{MAP}[motion]\nwatched = 1001\n"),
            &["motion.watched = 1001", "1000"],
        ),
    ];
    for (text, told) in cases {
        let study = written(folder.path(), &text)?;
        STUDY.refuses_and_writes_nothing(&[&study], told);
    }
    let study = written(folder.path(), MAP)?;
    STUDY.refuses(&[&study, "--shard", "8/7"], &["8/7", "from 1 to N"]);
    STUDY.refuses(&[], &["STUDY.toml"]);
    Ok(())
}

/// No room: what a limit of file sizes leaves stands for a full disk.
#[test]
fn a_full_disk_is_said_and_loses_nothing() -> Outcome {
    let folder = tempfile::tempdir()?;
    let study = written(folder.path(), MAP)?;
    let [whole, out] = ["whole", "out"].map(|name| folder.path().join(name));
    STUDY.json_into(&whole, &[&study, "--csv"]);
    let limited = format!(
        "trap '' XFSZ; ulimit -f 80; exec {} study {study} --csv --output {}",
        STUDY.file,
        out.display()
    );
    let ended = Command::new("sh").args(["-c", &limited]).output()?;
    let said = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(1), "{said}");
    assert!(
        said.contains("cannot write") && said.contains("--resume"),
        "{said}"
    );
    let left: Vec<_> = fs::read_dir(&out)?.collect::<Result<_, _>>()?;
    assert_eq!(left.len(), 1, "{left:?}");
    STUDY.json_into(&out, &[&study, "--csv", "--resume"]);
    assert_eq!(bytes(&out)?, bytes(&whole)?);
    Ok(())
}

/// Shards and merges killed at random moments, over and over into one folder: 20 times, or `SOFTSTOP_KILLS`.
#[test]
fn shards_and_merges_survive_kills() -> Outcome {
    let folder = tempfile::tempdir()?;
    let study = written(folder.path(), MAP)?;
    let [whole, parts] = ["whole", "parts"].map(|name| folder.path().join(name));
    let begin = Instant::now();
    STUDY.json_into(&whole, &[&study, "--csv"]);
    let (longest, mut chance) = (begin.elapsed(), SplitMix64::seed_from_u64(2003));
    let kills = std::env::var("SOFTSTOP_KILLS").ok();
    let kills: u32 = kills.and_then(|it| it.parse().ok()).unwrap_or(20);
    let mut killed = |arguments: &[&str]| -> Outcome {
        let share = chance.next_u64() as f64 / u64::MAX as f64;
        let mut command = STUDY.command(arguments);
        command.arg("--output").arg(&parts);
        command.stdout(Stdio::null()).stderr(Stdio::null());
        let mut run = command.spawn()?;
        std::thread::sleep(longest.mul_f64(share));
        run.kill()?;
        run.wait()?;
        Ok(())
    };
    for shard in ["1/3", "3/3", "2/3"] {
        let line = [&study, "--shard", shard, "--resume"];
        for _ in 0..kills.div_ceil(5) {
            killed(&line)?;
        }
        STUDY.json_into(&parts, &line);
    }
    let merge = ["merge", &study, "--csv"];
    for _ in 0..(2 * kills).div_ceil(5) {
        killed(&merge)?;
        if let Ok(left) = fs::read(parts.join("study.parquet")) {
            assert_eq!(left, bytes(&whole)?[0]);
            fs::remove_file(parts.join("study.parquet"))?;
        }
    }
    STUDY.json_into(&parts, &merge);
    assert_eq!(bytes(&parts)?, bytes(&whole)?);
    // Shards, tables and manifest, and nothing of what was killed.
    assert_eq!(fs::read_dir(&parts)?.count(), 6);
    Ok(())
}
