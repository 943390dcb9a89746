//! The fields of a contact in one file.

use crate::contact::Contact;
use crate::surface::Field;
use ndarray::{Array2, ArrayView1, arr0};
use ndarray_npy::{NpzWriter, WritableElement, WriteNpzError};
use std::io::Cursor;

/// The fields of a contact as `.npz`, of the rank that the heights came in: `height`, `pressure`, `gap`, `displacement`,
/// `contact` (bool), the scalars `converged` (bool) and `certificate`, and the text of the `setup` that repeats it, as bytes:
/// `bytes(npz["setup"]).decode()` in Python.
///
/// The archive is made in memory: a `ZipWriter` that meets a full disk complains on standard error by itself.
///
/// # Errors
/// The errors of the format, which fields of doubles do not meet.
pub fn archive(contact: &Contact, rank: usize, setup: Option<&str>) -> Result<Vec<u8>, WriteNpzError> {
    let mut npz = NpzWriter::new(Cursor::new(Vec::new()));
    if let Some(text) = setup {
        npz.add_array("setup", &ArrayView1::from(text.as_bytes()))?;
    }
    let fields: [(&str, &Field); 4] = [
        ("height", &contact.problem.surface().heights_as_given()),
        ("pressure", &contact.pressure),
        ("gap", &contact.gap),
        ("displacement", &contact.displacement),
    ];
    for (name, field) in fields {
        add(&mut npz, name, field, rank)?;
    }
    add(&mut npz, "contact", &contact.mask(), rank)?;
    npz.add_array("converged", &arr0(contact.is_converged()))?;
    npz.add_array("certificate", &arr0(contact.certificate.eta))?;
    Ok(npz.finish()?.into_inner())
}

fn add<T: WritableElement>(
    npz: &mut NpzWriter<Cursor<Vec<u8>>>,
    name: &str,
    field: &Array2<T>,
    rank: usize,
) -> Result<(), WriteNpzError> {
    if rank == 1 { npz.add_array(name, &field.row(0)) } else { npz.add_array(name, field) }
}
