//! The zoo of stops: its pictures, its page and its example scenes say what the library does.

use std::fs;

use softstop::{Machine, PhaseKind, Release, Scene, Stop};
use softstop_explore::simulate::name;
use softstop_explore::stops::stroke::ContactStroke;
use softstop_explore::stops::{picture, zoo::ZOO};
use softstop_testing::{
    assert_near, assert_relative, docs, hertz, is_near, kelvin_voigt, preloaded, slope,
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn scene(name: &str) -> Result<Scene, Box<dyn std::error::Error>> {
    let text = fs::read_to_string(docs("scenes").join(name))?;
    Ok(Machine::from_toml(&text)?.scene)
}

fn kinds(scene: &Scene) -> Vec<&'static str> {
    let scene = scene.check().expect("valid");
    scene
        .phases()
        .phases
        .iter()
        .map(|phase| name(phase.kind))
        .collect()
}

/// The file of a line `Scene: [..](scenes/FILE)`.
fn linked(line: &str) -> Option<&str> {
    let (_, link) = line.strip_prefix("Scene: ")?.split_once("(scenes/")?;
    link.strip_suffix(')')
}

#[test]
fn pictures_are_what_the_command_writes() -> Outcome {
    for exhibit in &ZOO {
        let file = docs("stops").join(format!("{}.svg", exhibit.name));
        let drawn = picture(exhibit).map_err(|failure| failure.to_string())?;
        assert!(
            look_alike(&fs::read_to_string(&file)?, &drawn),
            "{}: run `softstop stops --output docs/stops`",
            file.display()
        );
    }
    Ok(())
}

/// Coordinates may differ by what a machine's own rounding can do to their last digit.
const PIXELS: f64 = 0.03;

fn look_alike(a: &str, b: &str) -> bool {
    let words = |text: &str| -> Vec<String> {
        let is_apart = |c: char| c.is_whitespace() || "<>\"(),=".contains(c);
        text.split(is_apart).map(str::to_owned).collect()
    };
    let (a, b) = (words(a), words(b));
    let same = |(a, b): (&String, &String)| match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) => is_near(a, b, PIXELS),
        _ => a == b,
    };
    a.len() == b.len() && a.iter().zip(&b).all(same)
}

#[test]
fn every_picture_is_on_the_page_and_no_other() -> Outcome {
    let page = fs::read_to_string(docs("stops.md"))?;
    for exhibit in &ZOO {
        assert!(page.contains(&format!("(stops/{}.svg)", exhibit.name)));
    }
    assert_eq!(fs::read_dir(docs("stops"))?.count(), ZOO.len());
    Ok(())
}

#[test]
fn the_page_names_the_phases_that_each_scene_lowers_to() -> Outcome {
    let page = fs::read_to_string(docs("stops.md"))?;
    let mut lines = page.lines();
    let mut seen = 0;
    while let Some(file) = lines.by_ref().find_map(linked) {
        let rows = lines
            .by_ref()
            .skip_while(|line| !line.starts_with("| phase"));
        let named: Vec<&str> = rows
            .skip(2)
            .map_while(|line| line.strip_prefix("| ")?.split(" |").next())
            .collect();
        assert_eq!(named, kinds(&scene(file)?), "{file}");
        seen += 1;
    }
    assert_eq!(seen, 10);
    Ok(())
}

#[test]
fn the_toml_of_the_page_is_that_of_its_scenes() -> Outcome {
    let page = fs::read_to_string(docs("stops.md"))?;
    let mut snippet = String::new();
    let mut seen = 0;
    for line in page.lines() {
        match line.strip_prefix("    ") {
            Some("[stop]") => snippet = "[stop]\n".into(),
            Some(code) => snippet += &format!("{code}\n"),
            None => {}
        }
        if let Some(file) = linked(line) {
            let shown: toml::Table = snippet.parse()?;
            let whole: toml::Table = fs::read_to_string(docs("scenes").join(file))?.parse()?;
            for key in ["stop", "piercing", "rigid"] {
                assert_eq!(shown.get(key), whole.get(key), "{file}: {key}");
            }
            seen += 1;
        }
    }
    assert_eq!(seen, 10);
    Ok(())
}

/// Work in J that a stroke leaves in the stop: the area of its loop.
fn area(stroke: &ContactStroke) -> f64 {
    let points: Vec<(f64, f64)> = stroke.points().collect();
    let trapezium = |pair: &[(f64, f64)]| 0.5 * (pair[1].0 - pair[0].0) * (pair[1].1 + pair[0].1);
    points.windows(2).map(trapezium).sum()
}

/// Kinetic energy in J that a mass of 1 kg loses in a stroke, rebounds included.
fn lost(name: &str, speed: f64, damped: bool) -> Result<(f64, f64), Box<dyn std::error::Error>> {
    let stroke = ContactStroke::new(&scene(name)?, speed, 0.1, damped)?;
    let blow = stroke.rebound.map_or(0.0, |wall| {
        0.5 * (wall.before * wall.before - wall.after * wall.after)
    });
    let exit = stroke.exit_speed.ok_or("the mass does not come back")?;
    let kinetic = 0.5 * (speed * speed - exit * exit);
    Ok((kinetic - blow, area(&stroke)))
}

#[test]
fn the_area_of_a_loop_is_the_energy_that_the_stroke_loses() -> Outcome {
    for (name, speed, damped) in [
        ("kelvin-voigt.toml", 6.0, true),
        ("kelvin-voigt-zero-force.toml", 6.0, true),
        ("piecewise-linear.toml", 6.0, false),
        ("piecewise-linear-unloading.toml", 6.0, false),
        ("hertz.toml", 6.0, false),
        ("hunt-crossley.toml", 6.0, false),
        ("preloaded.toml", 20.0, false),
        ("piercing.toml", 8.0, false),
        ("rigid.toml", 6.0, false),
    ] {
        let (kinetic, area) = lost(name, speed, damped)?;
        println!("{name}");
        assert_near(kinetic, area, 2e-3 * speed * speed);
    }
    Ok(())
}

#[test]
fn elastic_stops_throw_the_mass_back_as_fast_as_it_came() -> Outcome {
    for (name, speed) in [
        ("piecewise-linear.toml", 6.0),
        ("hertz.toml", 6.0),
        ("preloaded.toml", 20.0),
    ] {
        let stroke = ContactStroke::new(&scene(name)?, speed, 0.1, false)?;
        let exit = stroke.exit_speed.ok_or("the mass does not come back")?;
        println!("{name}");
        assert_relative(exit, speed, 1e-9);
    }
    Ok(())
}

/// Laws that are one and the same in a limit lower to the same phases.
#[test]
fn limits_of_the_laws_lower_to_one_another() -> Outcome {
    let base = scene("preloaded.toml")?;
    let with = |stop: Stop| {
        Scene {
            stop,
            ..base.clone()
        }
        .check()
        .map(|scene| scene.phases().clone())
    };
    let spring = with(kelvin_voigt(50.0, Release::Clearance));
    let preloaded = with(preloaded(50.0, 0.0));
    let linear = with(hertz(50.0, 1.0, 0.0));
    let slope = slope(0.0, 50.0);
    let chain = with(Stop::PiecewiseLinear {
        loading: vec![slope],
        unloading: vec![slope],
    });
    assert_eq!(spring, preloaded);
    assert_eq!(spring, linear);
    assert_eq!(spring, chain);
    Ok(())
}

#[test]
fn layers_without_thickness_do_not_exist() -> Outcome {
    let mut scene = scene("piercing.toml")?;
    scene.rigid = None;
    let strip = scene.piercing.as_mut().ok_or("no strip")?;
    strip.thickness = 0.0;
    assert_eq!(kinds(&scene), ["free", "gap", "stop", "cut", "cut", "stop"]);
    let strip = scene.piercing.as_mut().ok_or("no strip")?;
    (strip.thickness, strip.travel) = (0.4, 0.0);
    let lowered = kinds(&scene);
    assert_eq!(lowered, ["free", "gap", "stop", "pierce", "pierce", "stop"]);
    Ok(())
}

#[test]
fn interference_is_a_start_in_contact() -> Outcome {
    let mut scene = scene("kelvin-voigt.toml")?;
    scene.clearance = -0.5;
    let start = softstop::Start::REST;
    assert_eq!(scene.motion(start)?.kind(), PhaseKind::Stop);
    Ok(())
}

#[test]
fn names_of_phases_are_those_of_the_library() -> Outcome {
    for kind in [
        PhaseKind::Free,
        PhaseKind::Pierce,
        PhaseKind::Cut,
        PhaseKind::Gap,
        PhaseKind::Stop,
        PhaseKind::Released,
        PhaseKind::Chatter,
        PhaseKind::Stuck,
        PhaseKind::Resting,
    ] {
        assert_eq!(serde_json::to_value(kind)?, name(kind));
    }
    Ok(())
}
