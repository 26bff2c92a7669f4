//! The report as a table for people.

use softstop_console::report::{MachineReport, MotionReport};
use softstop_console::table::{Row, heading, number, row, table};

use super::{DesignReport, OptimizeReport, ReferenceReport};

/// The design beside the paper's points, then what holds it back and where the files are.
#[must_use]
pub fn optimize(report: &OptimizeReport) -> String {
    let design = &report.design;
    let title = format!(
        "Hardest impact of the {} machine, margin M = {} from both ends of the zone",
        design.machine.regime.name(),
        design.margin
    );
    let mut text = heading(&title) + &table(&comparison(report));
    text += "\n";
    text += &zone_line(design);
    if !design.at_limits.is_empty() {
        text += &format!("Held back by: {}.\n", design.at_limits.join(", "));
    }
    for (kind, path) in &report.files {
        text += &format!("Written: {path} ({kind})\n");
    }
    text
}

fn zone_line(design: &DesignReport) -> String {
    format!(
        "Zone of the design: g0 = {} to s_SN = {}; the design stands at s = {} of it.\n",
        number(design.frequency_g0),
        number(design.frequency_sn),
        number(design.s),
    )
}

fn comparison(report: &OptimizeReport) -> Vec<Row> {
    let references: Vec<(&str, &ReferenceReport)> = report
        .reference
        .iter()
        .map(|(name, point)| (*name, point))
        .collect();
    let mut names = vec!["design".to_owned()];
    names.extend(
        references
            .iter()
            .map(|(name, point)| format!("{name} ({})", point.machine.regime.name())),
    );
    let mut gains = vec![String::new()];
    gains.extend(
        references
            .iter()
            .map(|(_, point)| format!("{:.4} x", point.gain)),
    );

    let design = &report.design;
    let mut columns = vec![(&design.machine, &design.motion)];
    columns.extend(
        references
            .iter()
            .map(|(_, point)| (&point.machine, &point.motion)),
    );
    let line = |label: &str, value: fn(&MachineReport, &MotionReport) -> f64| {
        row(
            label,
            columns
                .iter()
                .map(|(machine, motion)| number(value(machine, motion))),
        )
    };
    vec![
        (String::new(), names),
        line("before-impact velocity X'-", |_, motion| {
            motion.before_impact_velocity
        }),
        ("  design over this point".to_owned(), gains),
        line("stiffness k4/k1", |machine, _| machine.stiffness),
        line("preload Fp/F0", |machine, _| machine.preload),
        line("clearance rho", |machine, _| machine.clearance),
        line("drive frequency eta", |_, motion| motion.frequency),
        line("greatest position X_m", |_, motion| motion.max_position),
        line("position X at drive angle 0", |_, motion| motion.position),
        line("velocity X' at drive angle 0", |_, motion| motion.velocity),
        line("largest multiplier |mu|", |_, motion| largest(motion)),
    ]
}

fn largest(motion: &MotionReport) -> f64 {
    motion
        .multipliers
        .iter()
        .map(|multiplier| multiplier.modulus)
        .fold(0.0, f64::max)
}
