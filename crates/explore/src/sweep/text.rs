//! What a sweep came to, for people.

use std::fmt::Write;

use super::report::{ChainReport, SweepReport};

/// Jumps of a sweep that are told; the file holds all.
const MOST: usize = 12;

pub(super) fn text(report: &SweepReport) -> String {
    let mut text = format!(
        "{} from {} to {}: {} values of {} drive periods, {:.3e} per period\n",
        report.parameter,
        report.range[0],
        report.range[1],
        report.steps,
        report.periods,
        report.rate_per_period,
    );
    let step = (report.range[1] - report.range[0]) / (report.steps - 1) as f64;
    let digits = (1.0 - step.log10()).clamp(6.0, 15.0) as usize;
    for sweep in &report.sweeps {
        chain(&mut text, sweep, digits);
    }
    if !report.hysteresis.is_empty() {
        text.push_str("\nHysteresis (up | down)\n");
    }
    for zone in &report.hysteresis {
        let clearance = clearance(zone.clearance);
        let (from, to) = (zone.from, zone.to);
        let _ = writeln!(
            text,
            "  {clearance}{from:.digits$} to {to:.digits$}: {} | {}",
            zone.up, zone.down
        );
    }
    text.push('\n');
    for file in &report.files {
        let _ = writeln!(text, "wrote {file}");
    }
    text
}

fn clearance(clearance: Option<f64>) -> String {
    clearance.map_or_else(String::new, |clearance| format!("rho = {clearance}, "))
}

fn chain(text: &mut String, sweep: &ChainReport, digits: usize) {
    let clearance = clearance(sweep.clearance);
    let _ = writeln!(
        text,
        "\n{clearance}{}: {} steps, {} of chaos, {} unsettled",
        sweep.direction, sweep.steps, sweep.chaotic, sweep.unsettled
    );
    for jump in sweep.jumps.iter().take(MOST) {
        let _ = writeln!(
            text,
            "  {:.digits$} -> {:.digits$}  {} -> {}  velocity {:.4} -> {:.4}",
            jump.from, jump.to, jump.before, jump.after, jump.velocity_before, jump.velocity_after
        );
    }
    if sweep.jumps.len() > MOST {
        let _ = writeln!(text, "  and {} more", sweep.jumps.len() - MOST);
    }
    if let Some(error) = &sweep.error {
        let _ = writeln!(text, "  ended early: {error}");
    }
}
