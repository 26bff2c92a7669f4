//! The reports as tables for people.

use super::{
    DesignReport, MachineReport, MotionReport, OptimizeReport, OrbitReport, ReferenceReport,
    ZoneReport,
};

/// A row: what it is, and a cell for each column.
pub(crate) type Row = (String, Vec<String>);

/// The orbit, one quantity a line.
#[must_use]
pub fn orbit(report: &OrbitReport) -> String {
    let mut rows = machine(&report.machine);
    rows.push(row(
        "drive frequency eta",
        [number(report.motion.frequency)],
    ));
    rows.extend(motion(&report.motion));
    heading("Stable motion with one impact per drive period (z = 1)") + &table(&rows)
}

/// The zone, one quantity a line.
#[must_use]
pub fn zone(report: &ZoneReport) -> String {
    let mut rows = machine(&report.machine);
    rows.push(row("grazing frequency g0", [number(report.frequency_g0)]));
    rows.push(row("fold frequency s_SN", [number(report.frequency_sn)]));
    rows.push(row(
        "velocity X'- at the fold",
        [number(report.velocity_sn)],
    ));
    heading("Hysteresis zone of the z = 1 motion") + &table(&rows)
}

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

fn machine(report: &MachineReport) -> Vec<Row> {
    let strip = [
        ("strip stiffness k2/k1", report.piercing_stiffness),
        ("strip friction k3/k1", report.piercing_friction),
        ("strip thickness sigma", report.thickness),
        ("travel to the stop nu", report.travel),
    ];
    let mut rows = vec![
        row("regime", [report.regime.name().to_owned()]),
        row("clearance rho", [number(report.clearance)]),
        row("stiffness k4/k1", [number(report.stiffness)]),
        row("preload Fp/F0", [number(report.preload)]),
        row("damping beta1", [number(report.damping)]),
        row("contact damping beta", [number(report.contact_damping)]),
    ];
    rows.extend(
        strip
            .into_iter()
            .filter_map(|(label, value)| Some(row(label, [number(value?)]))),
    );
    rows
}

fn motion(report: &MotionReport) -> Vec<Row> {
    let multipliers = report.multipliers.map(|multiplier| {
        if multiplier.im == 0.0 {
            number(multiplier.re)
        } else {
            format!("{} {:+.6}i", number(multiplier.re), multiplier.im)
        }
    });
    let [first, second] = multipliers;
    vec![
        row(
            "before-impact velocity X'-",
            [number(report.before_impact_velocity)],
        ),
        row("greatest position X_m", [number(report.max_position)]),
        row("position X at drive angle 0", [number(report.position)]),
        row("velocity X' at drive angle 0", [number(report.velocity)]),
        row("trace of the monodromy", [number(report.trace)]),
        row("its determinant", [number(report.determinant)]),
        row("Floquet multipliers", [first]),
        row("", [second]),
    ]
}

/// A row with this label.
pub(crate) fn row(label: &str, cells: impl IntoIterator<Item = String>) -> Row {
    (label.to_owned(), cells.into_iter().collect())
}

/// An underlined title.
pub(crate) fn heading(title: &str) -> String {
    format!("{title}\n{}\n", "-".repeat(title.chars().count()))
}

fn number(value: f64) -> String {
    format!("{value:.6}")
}

/// Labels to the left, cells to the right, every column as wide as its widest cell.
pub(crate) fn table(rows: &[Row]) -> String {
    let label_width = rows.iter().map(|(label, _)| label.len()).max().unwrap_or(0);
    let columns = rows.iter().map(|(_, cells)| cells.len()).max().unwrap_or(0);
    let width = |column: usize| {
        rows.iter()
            .filter_map(|(_, cells)| cells.get(column))
            .map(String::len)
            .max()
            .unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for (label, cells) in rows {
        let mut line = format!("{label:label_width$}");
        for (cell, width) in cells.iter().zip(&widths) {
            line += &format!("   {cell:>width$}");
        }
        text += line.trim_end();
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{row, table};

    #[test]
    fn columns_line_up() {
        let rows = [
            row("a", ["1.5".to_owned()]),
            row("long", ["12.25".to_owned(), "x".to_owned()]),
        ];
        assert_eq!(table(&rows), "a        1.5\nlong   12.25   x\n");
    }
}
