//! How a design was searched, as a record.

use std::collections::BTreeMap;

use serde::Serialize;
use softstop_console::number::NumberStyle::Six;

use crate::design::search::Resolution;
use crate::optimize::outcome::Interrupted;

/// How the design was searched.
#[derive(Debug, Serialize)]
pub struct SearchReport {
    /// Values held and ranges searched, in words.
    pub bounds: BTreeMap<String, String>,
    /// Zones computed at most.
    pub evaluations: u64,
    /// Zones that were computed.
    pub evaluations_used: u64,
    /// How fine it was looked for, if trials were in the way.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resolution: Option<Resolution>,
    /// What was interrupted, if the run was asked to end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interrupted: Option<Interrupted>,
}

impl SearchReport {
    /// What has to be known of the design, for people.
    pub(crate) fn text(&self) -> String {
        let interrupted = self
            .interrupted
            .map(|it| format!("Interrupted: {}.\n", it.words()));
        let resolution = self.resolution.map(|it| {
            format!(
                "What takes many motions is counted on some, and has no derivatives: searched in steps of {} % of each range \
                 and {} % of the zone.\n",
                Six.format(100.0 * it.axes),
                Six.format(100.0 * it.place)
            )
        });
        interrupted.into_iter().chain(resolution).collect()
    }
}
