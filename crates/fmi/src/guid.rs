//! The GUID: a fingerprint of the model description.

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
/// description by FMI 2.0 without options for both standards, whose descriptions say the same, but for model exchange.
fn plain_uuid<U: Unit>(imprint: &Imprint<U>) -> Uuid {
    let xml = description::v2::write(imprint, "", false);
    Uuid::new_v5(&NAMESPACE, xml.as_bytes())
}

/// That of the FMU with options, by the one of the FMU without.
fn with_options(plain: Uuid, options: Options) -> Uuid {
    let Options {
        exchange,
        clock,
        arrays,
    } = options;
    match options == Options::default() {
        true => plain,
        false => Uuid::new_v5(&plain, &[exchange, clock, arrays].map(u8::from)),
    }
}

/// The GUID, in braces, of the FMU with this imprint.
pub fn guid_of<U: Unit>(imprint: &Imprint<U>) -> String {
    let uuid = with_options(plain_uuid(imprint), imprint.options());
    uuid.braced().to_string()
}

/// The GUID of this very library.
pub fn library_guid<U: Unit>() -> String {
    library_uuid::<U>().braced().to_string()
}

/// The GUID as a number. It is held without a heap so that unloading the library leaves nothing behind.
pub(crate) fn library_uuid<U: Unit>() -> Uuid {
    let guid = &U::about().guid;
    *guid.get_or_init(|| plain_uuid(&Imprint::<U>::library()))
}

/// The options of the FMU with this library and this GUID.
pub(crate) fn options_of<U: Unit>(
    standard: Standard,
    argument: &str,
    guid: &str,
) -> Result<Options, Fault> {
    let plain = library_uuid::<U>();
    let text = |options| with_options(plain, options).braced().to_string();
    let mut choices = Options::choices(standard).into_iter();
    choices
        .find(|options| text(*options) == guid)
        .ok_or_else(|| {
            let own = text(Options::default());
            Fault::Instantiation(format!("{argument} is {guid:?}, this library's is {own:?}"))
        })
}
