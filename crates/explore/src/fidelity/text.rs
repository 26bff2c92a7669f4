//! The comparison for people.

use softstop_console::column::{Column, Unit, text};
use softstop_console::columns;
use softstop_console::export::Report;
use softstop_console::table::heading;

use super::report::{FidelityReport, ModelReport, TrackReport};

impl Report for FidelityReport {
    fn text(&self) -> String {
        let value = self.units.label(self.quantity.name(), Unit::Of(self.unit));
        let title = format!("Models of {} for its {value}", self.title);
        let mut text =
            heading(&title) + &text(&models(), &self.models, &self.units) + "\n" + &self.advice();
        for missing in &self.unmatched {
            text += &format!("Without a model: {}: {}\n", missing.named, missing.reason);
        }
        if let Some(tracks) = &self.structure {
            text += "\n";
            text += &heading("Regimes over the sweep, from rest and from a flung start");
            text += &self::text(&regimes(), tracks, &self.units);
        }
        text
    }
}

impl FidelityReport {
    /// Which model to take.
    fn advice(&self) -> String {
        let matched = match self.operating_velocity {
            _ if self.predictive => {
                "Matched at the velocity of each model's own motion.".to_owned()
            }
            Some(velocity) => {
                let unit = self.units.name(Unit::Velocity);
                format!("Matched at the machine's own {velocity:.6} {unit}")
                    .trim_end()
                    .to_owned()
                    + "."
            }
            None => "The scene's motion has no impact.".to_owned(),
        };
        let tolerance = self.tolerance;
        let found = match self.cheapest {
            None => format!("No model is within {tolerance}."),
            Some(named) if self.cheapest_is_scene => format!(
                "Within {tolerance} nothing costs less than the scene itself ({named}): take it as it is."
            ),
            Some(named) => format!("The cheapest model within {tolerance}: {named}."),
        };
        format!("{matched} Costs are per drive period.\n{found}\n")
    }
}

fn models() -> [Column<ModelReport>; 5] {
    columns! { ModelReport, model;
        "model" [None] Plain, "its name" => model.name();
        "value" [None] Fixed(6), "of the quantity" => model.value;
        "error" [None] Plain, "of it" => error(model.error);
        "evaluations" [None] Fixed(1), "per drive period" => model.cost.evaluations_per_period;
        "time" [Of("us")] Fixed(2), "per drive period" => model.cost.microseconds_per_period;
    }
}

fn regimes() -> [Column<TrackReport>; 6] {
    columns! { TrackReport, track;
        "model" [None] Plain, "its name" => track.named.to_string();
        "same_z" [None] Percent(1), "share" => track.agreement.map(|it| it.same_regime);
        "same_kind" [None] Percent(1), "share" => track.agreement.map(|it| it.same_kind);
        "g0" [Frequency] Fixed(6), "grazing" => track.grazing_frequency;
        "s_PD" [Frequency] Fixed(6), "flip" => track.flip_frequency;
        "s_SN" [Frequency] Fixed(6), "fold" => track.fold_frequency;
    }
}

impl ModelReport {
    fn name(&self) -> String {
        let scene = if self.is_scene { " = the scene" } else { "" };
        format!("{}{scene}", self.named)
    }
}

fn error(error: Option<f64>) -> String {
    match error {
        None => "no value".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(error) if error.is_finite() => format!("{error:.2e}"),
        Some(_) => "other".to_owned(),
    }
}
