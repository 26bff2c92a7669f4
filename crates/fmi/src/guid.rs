//! The GUID: a fingerprint of the model description.

use uuid::Uuid;

use crate::description;
use crate::fault::Fault;
use crate::imprint::Imprint;
use crate::standard::Standard;
use crate::unit::Unit;

const NAMESPACE: Uuid = Uuid::from_bytes(*b"softstop/fmi-2.0");

/// A name-based UUID of the model description, taken with an empty `guid`. Name, description and start
/// values are part of it, so the library must know them to know its GUID: they stand in its block. It is taken of the
/// description by FMI 2.0 for both standards, whose descriptions say the same, but for model exchange.
fn uuid_of<U: Unit>(imprint: &Imprint<U>, exchange: bool) -> std::io::Result<Uuid> {
    let xml = description::v2::write(imprint, "", exchange)?;
    Ok(Uuid::new_v5(&NAMESPACE, xml.as_bytes()))
}

/// The GUID, in braces, of the FMU with this imprint.
///
/// # Errors
/// If the XML cannot be written.
pub fn guid_of<U: Unit>(imprint: &Imprint<U>) -> std::io::Result<String> {
    let exchange = imprint.standard() == Standard::Fmi2 && imprint.has_exchange();
    uuid_of(imprint, exchange).map(|uuid| uuid.braced().to_string())
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
        .get_or_init(|| uuid_of(&Imprint::<U>::library(), false).ok());
    uuid.ok_or_else(not_computed)
}

/// The GUID in an FMU for FMI 2.0 that tells of model exchange.
pub(crate) fn exchange_uuid<U: Unit>() -> Result<Uuid, Fault> {
    uuid_of(&Imprint::<U>::library(), true).map_err(|_| not_computed())
}

fn not_computed() -> Fault {
    Fault::Internal("the GUID cannot be computed".to_owned())
}
