//! The report for people.

use super::report::{ChaosReport, ExponentReport, MotionsReport, PeriodicReport, SettledReport};
use softstop::{Dimension, Machine};
use softstop_console::table::{Row, heading, row, table};

/// The signs of a machine's units, with a space before them; empty if it speaks ratios.
struct Signs {
    length: String,
    velocity: String,
    rate: &'static str,
}

impl Signs {
    fn new(machine: &Machine) -> Self {
        let after = |dimension| match machine.unit(dimension) {
            "" => String::new(),
            unit => format!(" {unit}"),
        };
        Self {
            length: after(Dimension::Length),
            velocity: after(Dimension::Velocity),
            rate: match machine.unit(Dimension::Time) {
                "" => "Omega",
                _ => "1/s",
            },
        }
    }

    fn impact(&self) -> String {
        match self.velocity.as_str() {
            "" => "before impact, X'-".to_owned(),
            unit => format!("before impact,{unit}"),
        }
    }
}

/// Before-impact velocities that are written out.
const MOST_VELOCITIES: usize = 8;

/// One motion after the other, then where they were looked for.
pub(super) fn text(machine: &Machine, report: &MotionsReport) -> String {
    let signs = Signs::new(machine);
    let (m, v) = (&signs.length, &signs.velocity);
    let mut text = heading(&format!("All motions of {}", report.title));
    for motion in &report.motions {
        text += &format!(
            "\n{} ({:.1} % of starts)\n",
            motion.name.text,
            100.0 * motion.share
        );
        text += &table(&rows(motion, &signs));
    }
    let ([x0, x1], [v0, v1]) = (report.region_position, report.region_velocity);
    text += &format!(
        "\n{} starts with {x0:.4} <= x <= {x1:.4}{m} and {v0:.4} <= x' <= {v1:.4}{v}; {} drive periods computed.\n",
        report.starts, report.periods_computed
    );
    if let Some(reason) = &report.reason {
        text += &format!("{} starts were lost: {reason}\n", report.lost);
    }
    text
}

fn rows(motion: &SettledReport, signs: &Signs) -> Vec<Row> {
    let mut rows = Vec::new();
    if let Some(orbit) = &motion.periodic {
        rows.extend(periodic(orbit, motion.name.order.as_deref(), signs));
    }
    if let Some([low, high]) = motion.positions {
        let held = format!("{low:.6} to {high:.6}{}", signs.length);
        rows.push(line("held at x", held));
    }
    if let Some(chaos) = &motion.chaos {
        rows.extend(self::chaos(chaos, signs));
    }
    rows.extend(
        motion
            .unsettled
            .as_ref()
            .map(|it| exponent(&it.exponents, signs)),
    );
    rows
}

fn line(label: &str, value: String) -> Row {
    row(&format!("  {label}"), [value])
}

fn periodic(orbit: &PeriodicReport, order: Option<&str>, signs: &Signs) -> Vec<Row> {
    let mut rows = Vec::new();
    if orbit.impacts > 0 {
        rows.push(line(
            "order of impacts",
            order.unwrap_or_default().to_owned(),
        ));
        rows.push(line(
            &signs.impact(),
            velocities(&orbit.before_impact_velocities),
        ));
    }
    let (x, v) = (orbit.position, orbit.velocity);
    rows.push(line(
        "state at drive angle phi",
        format!("x = {x:.9}{}, x' = {v:.9}{}", signs.length, signs.velocity),
    ));
    rows.push(line(
        "largest position",
        format!("{:.6}{}", orbit.max_position, signs.length),
    ));
    let [first, second] = orbit.multipliers;
    let multipliers = if first.im == 0.0 {
        format!("{:.6}, {:.6}", first.re, second.re)
    } else {
        format!(
            "{:.6} +- {:.6} i, modulus {:.6}",
            first.re, first.im, first.modulus
        )
    };
    rows.push(line("multipliers", multipliers));
    let [first, second] = orbit.exponents.per_period;
    let exponents = format!("{}, {} per drive period", rate(first), rate(second));
    rows.push(line("Lyapunov exponents", exponents));
    let returned = format!(
        "{:.1e} when met, {:.1e} when polished",
        orbit.returned, orbit.residual
    );
    rows.push(line("returns to within", returned));
    rows
}

/// An exponent: that of a multiplier zero is minus infinity.
fn rate(exponent: f64) -> String {
    if exponent.is_finite() {
        format!("{exponent:.6}")
    } else {
        "-infinity".to_owned()
    }
}

fn velocities(velocities: &[f64]) -> String {
    let shown = velocities
        .iter()
        .take(MOST_VELOCITIES)
        .map(|velocity| format!("{velocity:.6}"));
    let mut text = shown.collect::<Vec<_>>().join(", ");
    if velocities.len() > MOST_VELOCITIES {
        text += &format!(", ... ({} in all)", velocities.len());
    }
    text
}

fn chaos(chaos: &ChaosReport, signs: &Signs) -> Vec<Row> {
    let mut rows = vec![exponent(&chaos.exponents, signs)];
    rows.push(line(
        "impacts per drive period",
        format!("{:.3}", chaos.impacts_per_period),
    ));
    let ends = (
        chaos.least_before_impact_velocity,
        chaos.before_impact_velocity,
    );
    if let (Some(least), Some(largest)) = ends {
        rows.push(line(&signs.impact(), format!("{least:.4} to {largest:.4}")));
    }
    rows.push(line(
        "lifetime",
        match (chaos.lifetime, chaos.entered) {
            (Some(lifetime), Some(entered)) => {
                format!("{lifetime:.0} periods on average; {entered} starts came here first")
            }
            _ => format!("> {} periods (95 %): none left it", chaos.watched / 3),
        },
    ));
    rows
}

fn exponent(exponents: &ExponentReport, signs: &Signs) -> Row {
    let ([period, _], [second, _]) = (exponents.per_period, exponents.per_second);
    let error = exponents.error;
    line(
        "Lyapunov exponent",
        format!(
            "{period:.4} +- {error:.4} per drive period ({second:.5} {})",
            signs.rate
        ),
    )
}
