//! The GUID: a fingerprint of the model description.

use std::sync::OnceLock;

use uuid::Uuid;

use crate::model_description;
use crate::start::{StartValues, library_start_values};

const NAMESPACE: Uuid = Uuid::from_bytes(*b"softstop/fmi-2.0");

/// A GUID in braces, held without a heap so that unloading the library leaves nothing behind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Braced([u8; 38]);

impl Braced {
    fn as_str(&self) -> &str {
        std::str::from_utf8(&self.0).unwrap_or_default()
    }
}

fn fingerprint(xml: &str) -> Uuid {
    Uuid::new_v5(&NAMESPACE, xml.as_bytes())
}

fn braced(uuid: Uuid) -> Braced {
    let mut text = [0; 38];
    uuid.braced().encode_lower(&mut text);
    Braced(text)
}

/// The GUID of the unit with these start values: a name-based UUID of its model description, taken
/// with an empty `guid`.
///
/// # Errors
/// If the XML cannot be written.
pub fn guid_of(start: &StartValues) -> Result<String, std::io::Error> {
    let xml = model_description::write(start, "")?;
    Ok(braced(fingerprint(&xml)).as_str().to_owned())
}

fn library() -> Option<&'static (Uuid, Braced)> {
    static GUID: OnceLock<Option<(Uuid, Braced)>> = OnceLock::new();
    GUID.get_or_init(|| {
        let xml = model_description::write(&library_start_values(), "").ok()?;
        let uuid = fingerprint(&xml);
        Some((uuid, braced(uuid)))
    })
    .as_ref()
}

/// The GUID of this very library, or nothing if its description cannot be written.
pub fn library_guid() -> Option<&'static str> {
    library().map(|(_, text)| text.as_str())
}

/// The same as a number.
pub(crate) fn library_uuid() -> Option<Uuid> {
    library().map(|(uuid, _)| *uuid)
}
