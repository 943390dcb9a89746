//! Heights as files that other programs read.

mod file_writer;
mod gwy;
mod sdf;
mod stl;
#[cfg(feature = "instruments")]
mod x3p;
mod xyz;

use super::npy;
use crate::error::FileError;
use crate::files::{check_named, write_beside};
use crate::formats::Scan;
use file_writer::FileWriter;
use std::io;
use std::path::Path;

/// A format for writing heights, recognised by the ending of a file name.
struct ExportFormat {
    ending: &'static str,
    /// Why a scan cannot be written, if that is so.
    refuses: fn(&Scan) -> Option<&'static str>,
    write: fn(&Scan, &mut FileWriter) -> io::Result<()>,
}

/// All formats.
const EXPORTS: &[ExportFormat] = &[
    ExportFormat { ending: "npy", refuses: |_| None, write: npy },
    ExportFormat { ending: "sdf", refuses: |_| None, write: sdf::write },
    #[cfg(feature = "instruments")]
    ExportFormat { ending: "x3p", refuses: |_| None, write: x3p::write },
    ExportFormat { ending: "xyz", refuses: |_| None, write: xyz::write },
    ExportFormat { ending: "gwy", refuses: of_profile, write: gwy::write },
    ExportFormat { ending: "stl", refuses: of_open_solid, write: stl::write },
];

/// Why a profile cannot be written to a format of maps.
fn of_profile(scan: &Scan) -> Option<&'static str> {
    let is_profile = scan.shape().contains(&1);
    is_profile.then_some("the format holds maps, and this is a profile: write it as .sdf, .x3p, .xyz or .npy")
}

/// Why heights are not the top of a closed solid.
fn of_open_solid(scan: &Scan) -> Option<&'static str> {
    let is_open = scan.voids() > 0;
    of_profile(scan).or(is_open.then_some("a solid has no void heights: fill them, or cut them off"))
}

impl Scan {
    /// The endings of names that [`Scan::write`] knows.
    pub fn endings() -> Vec<&'static str> {
        EXPORTS.iter().map(|it| it.ending).collect()
    }

    /// Writes heights in metres to a file for other programs, in the format of the ending of its name. All digits are
    /// kept, the first row is that at `y = 0`, and one row is a profile.
    ///
    /// | ending | format | voids |
    /// |--------|--------|-------|
    /// | `.npy` | NumPy's array of doubles, of rank 1 for a profile; without the spacing | NaN |
    /// | `.sdf` | text of ISO 25178-71 | `BAD` |
    /// | `.x3p` | archive of ISO 25178-72 with doubles (feature `instruments`) | NaN |
    /// | `.gwy` | file of Gwyddion 2, maps only | masked |
    /// | `.stl` | triangles of a closed block in millimetres, binary STL, maps only | refused |
    /// | `.xyz` | text of x, y and height in columns, of x and height for a profile | left out, NaN in a profile |
    ///
    /// # Errors
    /// [`FileError::Target`] for another ending and for what the format cannot hold, and the errors of [`write_beside`].
    ///
    /// ```
    /// use asperity::formats::{Measurement, Scan};
    /// let height = ndarray::arr2(&[[1e-6, 2e-6, 3e-6], [4e-6, f64::NAN, 6e-6]]);
    /// let scan = Scan { height, spacing: [5e-6, 2e-6] };
    /// let folder = tempfile::tempdir()?;
    /// let path = folder.path().join("patch.sdf");
    /// scan.write(&path)?;
    /// let read = Measurement::read(&path, None)?;
    /// assert_eq!((read.spacing, read.height[[1, 2]]), (Some([5e-6, 2e-6]), 6e-6));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), FileError> {
        let path = path.as_ref();
        check_named(path, &Self::endings())?;
        let ending = path.extension().unwrap_or_default();
        for export in EXPORTS.iter().filter(|it| ending.eq_ignore_ascii_case(it.ending)) {
            if let Some(reason) = (export.refuses)(self) {
                return Err(FileError::Target { path: path.into(), reason: reason.into() });
            }
            write_beside(path, |file| (export.write)(self, file))?;
        }
        Ok(())
    }
}

fn npy(scan: &Scan, file: &mut FileWriter) -> io::Result<()> {
    let heights = scan.height.view();
    npy::write(if scan.is_line() { heights.row(0).into_dyn() } else { heights.into_dyn() }, file)
}
