//! `softstop explore`: a machine as a page that computes its motions in the browser.

use std::env;
use std::io::{IsTerminal, stdout};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, anyhow};
use clap::Args;
use serde_json::json;
use softstop::Machine;
use softstop_console::arguments::MachineArguments;
use softstop_console::export::Export;
use softstop_console::failure::Failure;
use softstop_console::output::{Format, folder_and_file};
use softstop_console::report;
use softstop_console::table::heading;
use softstop_console::units::Units;
use softstop_draw::style::{self, bifurcation};
use softstop_dynamics::motion_kind::MotionClass;

use crate::page::{fill, in_script};
use crate::palette::motion_color;

const EXAMPLES: &str = "\
Examples:
  softstop explore
      the paper's unloaded machine: drag its clearance, and the bifurcation diagram follows
  softstop explore docs/scenes/rigid.toml --output rigid.html
      any machine with any stop, in the units of its file

The page computes in the browser, with the same engine, and needs nothing from elsewhere. Its address holds the machine:
keep it as a bookmark, or send it. Where a browser is there, it is opened.";

/// Arguments of `softstop explore`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct ExploreArguments {
    /// The page to write
    #[arg(long, value_name = "FILE.html", default_value = "explorer.html")]
    pub output: PathBuf,
    /// How to print the summary
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
    /// The machine.
    #[command(flatten)]
    pub machine: MachineArguments,
}

/// The engine as compressed WebAssembly; empty where it was not built.
const ENGINE: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/engine.wasm.gz"));

/// Writes the page, and opens it if somebody sits there.
pub fn run(arguments: &ExploreArguments) -> Result<(), Failure> {
    let machine = arguments.machine.machine()?;
    if ENGINE.is_empty() {
        return Err(Failure::Run(anyhow!(
            "this program was built without the engine for pages, or before it changed: cargo xtask explorer builds it"
        )));
    }
    let (folder, file) = folder_and_file(&arguments.output)?;
    let export = Export::of_file("html", folder, file)?;
    export.file("html", page(&machine)?.as_bytes())?;
    let figures = report::machine(&machine, &[]);
    let text = heading("Explorer") + &figures.text(&Units::of(&machine));
    export.finish(&report::stated(&machine), text, arguments.format)?;
    if stdout().is_terminal() {
        open(&arguments.output);
    }
    Ok(())
}

/// The document.
fn page(machine: &Machine) -> Result<String, Failure> {
    let color = |color: &str| style::themed(&color.to_lowercase());
    let classes = MotionClass::ALL.iter();
    let classes = classes.map(|class| (class.name(), color(motion_color(*class))));
    let named = ["unloaded", "loaded"].map(|name| Machine::named(name).map(|it| it.to_toml()));
    let start = json!({
        "machine": machine.to_toml(),
        "named": named,
        "classes": classes.collect::<Vec<_>>(),
        "marks": {
            "SN": color(bifurcation::FOLD),
            "PD": color(bifurcation::FLIP),
            "NS": color(bifurcation::NEIMARK_SACKER),
            "G": color(bifurcation::GRAZING),
        },
    });
    let start = serde_json::to_string(&start).context("cannot write JSON")?;
    let parts = [
        ("page.css", include_str!("../assets/explorer/page.css")),
        ("uPlot.css", include_str!("../assets/uplot/uPlot.min.css")),
        (
            "uPlot.js",
            include_str!("../assets/uplot/uPlot.iife.min.js"),
        ),
        ("uPlot licence", include_str!("../assets/uplot/LICENSE")),
        ("worker.js", include_str!("../assets/explorer/worker.js")),
        ("engine.js", include_str!("../assets/explorer/engine.js")),
        ("charts.js", include_str!("../assets/explorer/charts.js")),
        ("page.js", include_str!("../assets/explorer/page.js")),
        ("start", &in_script(&start)),
        ("engine", &base64(ENGINE)),
    ];
    Ok(fill(include_str!("../assets/explorer/page.html"), &parts))
}

/// Bytes in the 64 letters of RFC 4648.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let letters = bytes.chunks(3).flat_map(|chunk| {
        let byte = |place: usize| u32::from(chunk.get(place).copied().unwrap_or(0));
        let group = byte(0) << 16 | byte(1) << 8 | byte(2);
        let letter = move |place: usize| match place <= chunk.len() {
            true => char::from(LETTERS[(group >> (18 - 6 * place) & 63) as usize]),
            false => '=',
        };
        (0..4).map(letter)
    });
    letters.collect()
}

/// Opens a page in the browser, if there is a screen.
fn open(page: &Path) {
    let has_screen = ["DISPLAY", "WAYLAND_DISPLAY"]
        .iter()
        .any(|it| env::var_os(it).is_some());
    let (program, words): (_, &[&str]) = match () {
        () if cfg!(windows) => ("cmd", &["/C", "start", ""]),
        () if cfg!(target_os = "macos") => ("open", &[]),
        () if has_screen => ("xdg-open", &[]),
        () => return,
    };
    let mut browser = Command::new(program);
    browser.args(words).arg(page);
    // A browser that does not come up is no failure: the page is there.
    let _ = browser
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_holds_the_machine_and_all_its_parts() -> Result<(), Failure> {
        let machine = Machine {
            description: Some("</script>".to_owned()),
            ..Machine::named("loaded").ok_or_else(|| anyhow!("the paper's"))?
        };
        let page = page(&machine)?;
        let (_, given) = page
            .split_once("id=\"given\">")
            .ok_or_else(|| anyhow!("what is given"))?;
        let (given, _) = given.split_once("</script>").unwrap_or_default();
        let given: serde_json::Value = serde_json::from_str(given).context("JSON")?;
        assert_eq!(given["machine"].as_str(), Some(machine.to_toml().as_str()));
        assert_eq!(
            given["classes"].as_array().map(Vec::len),
            Some(MotionClass::ALL.len())
        );
        let places = [
            "version",
            "style",
            "page.css",
            "uPlot.js",
            "worker.js",
            "page.js",
            "engine",
        ];
        let empty = |name: &&str| page.contains(&["{{", name, "}}"].concat());
        assert_eq!(places.iter().find(|it| empty(it)), None);
        Ok(())
    }

    #[test]
    fn bytes_are_written_as_the_standard_has_it() {
        let known = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
        ];
        for (text, letters) in known {
            assert_eq!(base64(text.as_bytes()), letters);
        }
    }
}
