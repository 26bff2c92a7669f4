//! Arrays of parameters, for an FMU that tells of each as one variable: the value reference of its first element is its own.

use std::borrow::Cow;

use crate::abi::component::Component;
use crate::fault::Fault;
use crate::unit::Unit;

/// The value references of scalars: those of all elements in place of an array's.
pub(super) fn expanded<'a, U: Unit>(
    component: &Component<U>,
    references: &'a [u32],
) -> Result<Cow<'a, [u32]>, Fault> {
    if !component.importer.options.arrays {
        return Ok(references.into());
    }
    let table = &U::about().table;
    let mut scalars = Vec::with_capacity(references.len());
    for &reference in references {
        match table.by_reference(reference).and_then(|row| row.element()) {
            None => scalars.push(reference),
            Some((array, 1)) => scalars.extend(table.rows_of(array).map(|(_, row)| row.reference)),
            Some(_) => return Err(Fault::UnknownReference { reference }),
        }
    }
    Ok(scalars.into())
}
