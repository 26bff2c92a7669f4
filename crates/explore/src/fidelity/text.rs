//! The result for people.

use super::report::{FidelityReport, ModelReport, TrackReport};
use softstop_console::table::{heading, row, table};

/// The models, what to take, the structure if it was asked for, and where the files are.
pub(super) fn text(report: &FidelityReport) -> String {
    let quantity = report.quantity;
    let title = format!("Models of {} for its {}", report.scene(), quantity.name());
    let mut text = heading(&title) + &models(report) + "\n" + &advice(report);
    for missing in &report.unmatched {
        text += &format!("Without a model: {}: {}\n", missing.named, missing.reason);
    }
    if let Some(tracks) = &report.structure {
        text += "\n";
        text += &heading("Regimes over the sweep, from rest and from a flung start");
        text += &structure(tracks);
    }
    text.push('\n');
    for (kind, path) in &report.files {
        text += &format!("Written: {path} ({kind})\n");
    }
    text
}

fn models(report: &FidelityReport) -> String {
    let unit = report.quantity.unit();
    let head = [
        format!("value ({unit})"),
        "error".to_owned(),
        "evaluations".to_owned(),
        "us".to_owned(),
    ];
    let cells = |model: &ModelReport| {
        let cost = &model.cost;
        let cells = [
            model
                .value
                .map_or("none".to_owned(), |value| format!("{value:.6}")),
            error(model.error),
            format!("{:.1}", cost.evaluations_per_period),
            format!("{:.2}", cost.microseconds_per_period),
        ];
        let name = model.named.to_string();
        row(
            &if model.is_scene {
                name + " = the scene"
            } else {
                name
            },
            cells,
        )
    };
    let rows: Vec<_> = [row("model", head)]
        .into_iter()
        .chain(report.models.iter().map(cells))
        .collect();
    table(&rows)
}

fn error(error: Option<f64>) -> String {
    match error {
        None => "no value".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(error) if error.is_finite() => format!("{error:.2e}"),
        Some(_) => "other".to_owned(),
    }
}

fn advice(report: &FidelityReport) -> String {
    let matched = match report.operating_velocity {
        _ if report.predictive => "Matched at the velocity of each model's own motion.".to_owned(),
        Some(velocity) => format!("Matched at the scene's own {velocity:.6} m/s."),
        None => "The scene's motion has no impact.".to_owned(),
    };
    let tolerance = report.tolerance;
    let found = match report.cheapest {
        None => format!("No model is within {tolerance}."),
        Some(named) if report.cheapest_is_scene => format!(
            "Within {tolerance} nothing costs less than the scene itself ({named}): take it as it is."
        ),
        Some(named) => format!("The cheapest model within {tolerance}: {named}."),
    };
    format!("{matched} Costs are per drive period.\n{found}\n")
}

fn structure(tracks: &[TrackReport]) -> String {
    let head = ["same z", "same kind", "g0", "s_PD", "s_SN"].map(str::to_owned);
    let number =
        |value: Option<f64>| value.map_or("none".to_owned(), |value| format!("{value:.6}"));
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let cells = |track: &TrackReport| {
        let agreement = |share: fn(&super::structure::Agreement) -> f64| {
            track
                .agreement
                .as_ref()
                .map(share)
                .map_or("none".to_owned(), percent)
        };
        let cells = [
            agreement(|agreement| agreement.same_regime),
            agreement(|agreement| agreement.same_kind),
            number(track.grazing_frequency),
            number(track.flip_frequency),
            number(track.fold_frequency),
        ];
        row(&track.named.to_string(), cells)
    };
    let rows: Vec<_> = [row("model", head)]
        .into_iter()
        .chain(tracks.iter().map(cells))
        .collect();
    table(&rows)
}
