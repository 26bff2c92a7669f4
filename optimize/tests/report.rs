//! The page of a report: whole, alone, and of what there is.

use std::fs;
use std::path::Path;

use quick_xml::Reader;
use quick_xml::events::Event;
use softstop::{Machine, Parameter};
use softstop_console::record::Record;
use softstop_optimize::design::search::{Settings, Unwatched, search};
use softstop_optimize::design::space::{Axis, Interval};
use softstop_optimize::design::{Design, Problem};
use softstop_optimize::optimize::reference::Reference;
use softstop_optimize::page::data::{
    Basin, Computed, Curve, Erosion, ErosionPoint, Fact, Front, Histogram, Label, Map, Portrait,
    Report, Response, Role, RunUp, Sensitivity,
};
use softstop_optimize::page::{computed, csv, html};

type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;

/// A press with a strip of 2 mm, as its user states it.
const PRESS: &str = "
name = \"press\"
mass = 120.0
stiffness = 2.4e6
damping = 680.0
clearance = 0.02
contact.damping = 3050.0
excitation = { amplitude = 9e3, frequency_hz = 24.5 }
stop = { model = \"kelvinVoigt\", stiffness = 4e7 }
piercing = { stiffness = 5e7, friction = 5.5e7, thickness = 0.002, travel = 0.002 }
";

/// A design of it, found quickly.
fn design() -> Outcome<Design> {
    let axis = |parameter, low, high| Axis::new(parameter, Interval { low, high });
    let axes = vec![
        axis(Parameter::StopStiffness, 5e6, 8e7),
        axis(Parameter::Clearance, 0.005, 0.04),
    ];
    let problem = Problem {
        margin: 0.25,
        frequency: Interval {
            low: 10.0,
            high: 40.0,
        },
        ..Problem::of(Machine::from_toml(PRESS)?, axes)
    };
    let settings = Settings { evaluations: 300 };
    Ok(search(&problem, settings, &Unwatched, None)?.design)
}

/// A report with all that can be computed of a design alone, and one of everything else.
fn report(design: &Design) -> Outcome<Report> {
    let places = (0..=20).map(|k| f64::from(k) / 20.0);
    let erosion = places.map(|place| ErosionPoint {
        place,
        frequency: 20.0 + place,
        share: 0.6 * (1.0 - place),
        interval: [0.6 * (1.0 - place) - 0.02, 0.6 * (1.0 - place) + 0.02],
        integrity: Some(0.3 * (1.0 - place * place)),
    });
    let given = Reference {
        name: "given",
        machine: design.machine.clone(),
        orbit: design.orbit.clone(),
    };
    let pressed = Reference {
        machine: Machine::from_toml(PRESS)?,
        ..given.clone()
    };
    let velocity = Label::new("before-impact velocity", "", "m/s");
    let hardest = design.before_impact_velocity();
    let bell = |k: i32| (10_000.0 * (-f64::from((k - 25) * (k - 25)) / 60.0).exp()) as u64;
    let met = |met| match met {
        true => requirement(4.25, 1.25),
        false => requirement(2.0, -1.0),
    };
    Ok(Report {
        machine: "press <1> & co".to_owned(),
        task: "Hardest impact inside the hysteresis zone, at least a quarter of the zone away from g₀ and s_SN."
            .to_owned(),
        warnings: vec!["The best place jumps between two ridges when the clearance changes by 1 %.".to_owned()],
        highlights: vec![
            Fact { name: "before-impact velocity".to_owned(), value: format!("{hardest:.3} m/s") },
            Fact { name: "drive frequency".to_owned(), value: format!("{:.2} Hz", design.frequency()) },
            Fact { name: "machines lost of 1 000 000".to_owned(), value: "0".to_owned() },
        ],
        comparison: Some(computed::comparison(
            design,
            &[Parameter::StopStiffness, Parameter::Clearance, Parameter::Frequency],
            std::slice::from_ref(&given),
        )),
        limit: Some("The margin from s_SN: with 1 % more frequency it would not be kept.".to_owned()),
        requirements: vec![met(true), met(false)],
        maps: vec![
            computed::map(design, Parameter::Clearance, [0.005, 0.04]),
            computed::map(design, Parameter::StopStiffness, [5e6, 8e7]),
        ],
        response: Some(computed::response(design, &[pressed])),
        portrait: Some(computed::portrait(design)),
        basin: Some(computed::basin(design)?),
        erosion: Some(Erosion {
            points: erosion.collect(),
            design: Some(design.place),
            required: Some(0.3),
            starts: "positions and velocities of a box that holds all motions".to_owned(),
        }),
        fronts: vec![Front {
            name: "margin".to_owned(),
            note: String::new(),
            title: "Velocity against margin".to_owned(),
            x: Label::new("margin from the ends of the zone", "M", ""),
            y: velocity.clone(),
            points: (0..10).map(|k| [0.05 * f64::from(k), hardest * (1.1 - 0.03 * f64::from(k))]).collect(),
            design: Some([0.25, hardest]),
        }],
        histogram: Some(Histogram {
            x: velocity,
            range: [0.97 * hardest, 1.03 * hardest],
            counts: (0..50).map(bell).collect(),
            nominal: hardest,
            worst: Some(0.972 * hardest),
            samples: 1_000_000,
            lost: 0,
        }),
        sensitivities: vec![
            effect("clearance", "m", 0.02, 1e-4, -0.012),
            effect("stiffness of the stop", "N/m", 4e7, 2e6, 0.0031),
        ],
        run_up: vec![
            run_up("drive at full force from rest", false, "settles without impacts"),
            run_up("speed raised from below g₀", true, ""),
        ],
        computed: Some(Computed {
            zones: 300,
            ..Computed::default()
        }),
    })
}

fn requirement(value: f64, margin: f64) -> Record {
    Record::default()
        .with("name", "", "margin.s_SN")
        .with(
            "meaning",
            "",
            "distance to the fold s_SN, as a share of the frequency",
        )
        .with("unit", "", "%")
        .with("required", "", "at least 3")
        .with("value", "", value)
        .with("margin", "", margin)
        .with("met", "", margin >= 0.0)
        .with("note", "", "")
}

fn effect(name: &str, unit: &str, value: f64, tolerance: f64, effect: f64) -> Sensitivity {
    Sensitivity {
        label: Label::new(name, "", unit),
        value,
        tolerance,
        effect,
        effect_unit: "m/s".to_owned(),
        share: Some(0.4),
        total: Some(0.45),
        margin: Some(0.3),
    }
}

fn run_up(way: &str, succeeds: bool, note: &str) -> RunUp {
    RunUp {
        way: way.to_owned(),
        succeeds,
        note: note.to_owned(),
    }
}

/// Reads a page to its end; how often each element begins.
fn count(page: &str, name: &str) -> Outcome<usize> {
    let mut reader = Reader::from_str(page);
    let (mut found, mut depth) = (0, 0);
    loop {
        match reader.read_event()? {
            Event::Start(tag) => {
                found += usize::from(tag.name().as_ref() == name);
                depth += 1;
            }
            Event::Empty(tag) => found += usize::from(tag.name().as_ref() == name),
            Event::End(_) => depth -= 1,
            Event::Eof => break,
            _ => {}
        }
    }
    assert_eq!(depth, 0, "all is closed");
    Ok(found)
}

/// Nothing from elsewhere, nothing that is no number.
fn stands_alone(page: &str) {
    let without = page.replace("xmlns=\"http://www.w3.org/2000/svg\"", "");
    let without = without.replace("xmlns=\"http://www.w3.org/1999/xhtml\"", "");
    for foreign in [
        "http:", "https:", "src=", "href=", "@import", "url(", "<script", "NaN", "inf",
    ] {
        let place = without.find(foreign);
        let around = place.map(|at| without[..at].chars().rev().take(300).collect::<Vec<_>>());
        let around = around.map(|letters| letters.into_iter().rev().collect::<String>());
        assert_eq!(around, None, "{foreign}");
    }
}

#[test]
fn a_report_of_a_press_is_whole_and_stands_alone() -> Outcome {
    let design = design()?;
    let report = report(&design)?;
    let page = html(&report)?;
    // Kept to be looked at.
    fs::write(
        Path::new(env!("CARGO_TARGET_TMPDIR")).join("report.html"),
        &page,
    )?;
    stands_alone(&page);
    // The policy comes before what it allows: styles in the page, and nothing from elsewhere.
    let policy = page.find("content=\"default-src 'none'; style-src 'unsafe-inline'");
    assert!(
        policy.is_some() && policy < page.find("<style>"),
        "{policy:?}"
    );
    assert_eq!(
        page.matches("class=\"requirement\"").count(),
        report.requirements.len()
    );
    assert_eq!(count(&page, "section")?, 10);
    assert_eq!(count(&page, "figure")?, 9);
    assert_eq!(count(&page, "svg")?, count(&page, "figure")?);
    assert!(page.contains("press &lt;1&gt; &amp; co"));
    assert!(page.contains("s<sub>SN</sub>"));
    tables(&report)
}

/// All rows of a table have its columns, and numbers in them are numbers.
fn tables(report: &Report) -> Outcome {
    let tables = csv(report)?;
    let names: Vec<&str> = tables.iter().map(|it| it.0.as_str()).collect();
    let front = [
        "comparison.csv",
        "requirements.csv",
        "map-1.csv",
        "map-1-boundaries.csv",
    ];
    assert_eq!(names[..4], front);
    assert_eq!(names.len(), 13);
    for (name, bytes) in &tables {
        let mut reader = ::csv::Reader::from_reader(bytes.as_slice());
        let rows = reader.records().collect::<Result<Vec<_>, _>>()?;
        assert!(!rows.is_empty(), "{name}");
        let text = String::from_utf8(bytes.clone())?;
        assert!(!text.contains("NaN") && !text.contains("inf"), "{name}");
    }
    Ok(())
}

#[test]
fn what_is_absent_is_left_out_with_its_heading() -> Outcome {
    let page = html(&Report {
        machine: "press".to_owned(),
        ..Report::default()
    })?;
    stands_alone(&page);
    for element in ["section", "h2", "table", "figure", "ul", "dl"] {
        assert_eq!(count(&page, element)?, 0, "{element}");
    }
    assert_eq!(csv(&Report::default())?, []);
    Ok(())
}

/// Figures that are no numbers come to nothing worse than a dash.
#[test]
fn what_is_no_number_is_a_dash() -> Outcome {
    let nan = f64::NAN;
    let curve = |points: Vec<[f64; 2]>| Curve {
        name: "design".to_owned(),
        role: Role::Design,
        points,
    };
    let report = Report {
        requirements: vec![requirement(nan, f64::INFINITY)],
        maps: vec![Map {
            columns: 2,
            cells: vec![Some(nan), None],
            design: [nan, nan],
            ..Map::default()
        }],
        response: Some(Response {
            curves: vec![curve(vec![[1.0, nan], [nan, nan]]), curve(Vec::new())],
            design: [nan, nan],
            tolerance: Some([nan, nan]),
            bands: vec![vec![[nan; 3], [1.0, nan, 2.0]]],
            ..Response::default()
        }),
        portrait: Some(Portrait {
            faces: vec![("stop".to_owned(), nan)],
            ..Portrait::default()
        }),
        basin: Some(Basin::default()),
        erosion: Some(Erosion {
            points: vec![ErosionPoint {
                share: nan,
                ..ErosionPoint::default()
            }],
            ..Erosion::default()
        }),
        fronts: vec![Front {
            points: vec![[nan, 1.0]],
            design: Some([nan, nan]),
            ..Front::default()
        }],
        histogram: Some(Histogram {
            nominal: nan,
            worst: Some(nan),
            range: [nan, nan],
            counts: vec![0, 3],
            ..Histogram::default()
        }),
        sensitivities: vec![Sensitivity {
            effect: nan,
            share: Some(nan),
            ..Sensitivity::default()
        }],
        ..Report::default()
    };
    let page = html(&report)?;
    stands_alone(&page);
    count(&page, "svg")?;
    Ok(())
}
