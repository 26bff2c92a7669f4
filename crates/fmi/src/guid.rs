//! The GUID: a fingerprint of the model description.

use std::io;

use uuid::Uuid;

use crate::description;
use crate::fault::Fault;
use crate::imprint::Imprint;
use crate::options::Options;
use crate::standard::Standard;
use crate::unit::Unit;

const NAMESPACE: Uuid = Uuid::from_bytes(*b"softstop/fmi-2.0");

/// A name-based UUID of the model description, taken with an empty `guid`. Name, description and start
/// values are part of it, so the library must know them to know its GUID: they stand in its block. It is taken of the
/// description by FMI 2.0 for both standards, whose descriptions say the same, but for model exchange; with what only
/// FMI 3.0 can tell, of that by FMI 3.0.
fn uuid_of<U: Unit>(imprint: &Imprint<U>) -> io::Result<Uuid> {
    let xml = match imprint.standard() {
        Standard::Fmi3 if imprint.clock().is_some() || imprint.has_arrays() => {
            description::v3::write(imprint, "")?
        }
        Standard::Fmi3 => description::v2::write(imprint, "", false)?,
        Standard::Fmi2 => description::v2::write(imprint, "", imprint.has_exchange())?,
    };
    Ok(Uuid::new_v5(&NAMESPACE, xml.as_bytes()))
}

/// The GUID, in braces, of the FMU with this imprint.
///
/// # Errors
/// If the XML cannot be written.
pub fn guid_of<U: Unit>(imprint: &Imprint<U>) -> io::Result<String> {
    uuid_of(imprint).map(|uuid| uuid.braced().to_string())
}

/// The GUID of this very library, or nothing if its description cannot be written.
pub fn library_guid<U: Unit>() -> Option<String> {
    let uuid = library_uuid::<U>().ok()?;
    Some(uuid.braced().to_string())
}

/// The GUID as a number. It is held without a heap so that unloading the library leaves nothing behind.
pub(crate) fn library_uuid<U: Unit>() -> Result<Uuid, Fault> {
    let uuid = U::about()
        .guid
        .get_or_init(|| uuid_of(&Imprint::<U>::library()).ok());
    uuid.ok_or_else(not_computed)
}

/// The options of the FMU with this library and this GUID.
pub(crate) fn options_of<U: Unit>(
    standard: Standard,
    argument: &str,
    guid: &str,
) -> Result<Options, Fault> {
    let own = library_uuid::<U>()?.braced().to_string();
    if guid == own {
        return Ok(Options::default());
    }
    for options in Options::choices(standard) {
        let imprint = Imprint::<U>::library().with_standard(standard);
        let other = guid_of(&imprint.with_options(options)).map_err(|_| not_computed())?;
        if guid == other {
            return Ok(options);
        }
    }
    Err(Fault::Instantiation(format!(
        "{argument} is {guid:?}, this library's is {own:?}"
    )))
}

fn not_computed() -> Fault {
    Fault::Internal("the GUID cannot be computed".to_owned())
}
