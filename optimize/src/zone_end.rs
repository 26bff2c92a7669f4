//! What the ends of zones are called.

use softstop_dynamics::continuation::Test;
use softstop_dynamics::zone::ZoneEnd;
use softstop_explore::zone::lost_by;

/// What ends a zone, in words.
pub(crate) fn end_name(end: &ZoneEnd) -> String {
    match &end.loss {
        _ if end.is_critical(Test::Fold) => "s_SN".to_owned(),
        _ if end.is_critical(Test::Flip) => "s_PD".to_owned(),
        loss => lost_by(loss),
    }
}
