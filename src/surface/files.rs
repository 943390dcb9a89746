//! Height files, and output files that appear whole or not at all.

use crate::error::FileError;
use ndarray::{ArrayD, ArrayViewD};
use ndarray_npy::npy::header::Header;
use ndarray_npy::{ReadNpyError, ReadNpyExt, WriteNpyError, WriteNpyExt};
use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, Write};
use std::path::Path;
use tempfile::NamedTempFile;

/// Bytes at the start of a file that must hold the whole `.npy` header; NumPy writes 128.
const HEADER_BYTES: u64 = 4096;

/// Reads heights from a NumPy `.npy` file of doubles (`float64`) or singles (`float32`), of rank 1 (a line) or 2 (rows
/// of a surface), in C or Fortran order and either byte order.
///
/// # Errors
/// [`FileError::Read`] for a file that is missing or unreadable; [`FileError::Format`] with the reason for one that is
/// no `.npy` file, is truncated, or holds another type or rank.
pub fn read_heights(path: impl AsRef<Path>) -> Result<ArrayD<f64>, FileError> {
    let path = path.as_ref();
    let unreadable = |source| FileError::Read { path: path.into(), source };
    let (mut file, header) = open(path)?;
    file.rewind().map_err(unreadable)?;
    let heights = if header.is_single {
        ArrayD::<f32>::read_npy(BufReader::new(file)).map(|heights| heights.mapv(f64::from))
    } else {
        ArrayD::<f64>::read_npy(BufReader::new(file))
    };
    heights.map_err(|error| match error {
        ReadNpyError::Io(source) => unreadable(source),
        other => FileError::Format { path: path.into(), reason: other.to_string() },
    })
}

/// The shape of the heights in a file, as its header says.
///
/// # Errors
/// As [`read_heights`].
pub fn read_shape(path: impl AsRef<Path>) -> Result<Vec<usize>, FileError> {
    Ok(open(path.as_ref())?.1.shape)
}

/// What a usable header says.
struct Usable {
    shape: Vec<usize>,
    is_single: bool,
}

/// Opens a file whose header is usable.
fn open(path: &Path) -> Result<(File, Usable), FileError> {
    let unreadable = |source| FileError::Read { path: path.into(), source };
    let malformed = |reason| FileError::Format { path: path.into(), reason };
    if !std::fs::metadata(path).map_err(unreadable)?.is_file() {
        return Err(malformed("it is a directory or a device, give a .npy file".into()));
    }
    let mut file = File::open(path).map_err(unreadable)?;
    let bytes = file.metadata().map_err(unreadable)?.len();
    let header = check_header(&mut file, bytes).map_err(malformed)?;
    Ok((file, header))
}

/// Checks type, rank and length before anything of the claimed size is allocated.
fn check_header(file: &mut File, bytes: u64) -> Result<Usable, String> {
    let mut start = Vec::new();
    file.take(HEADER_BYTES).read_to_end(&mut start).map_err(|error| error.to_string())?;
    let mut rest = start.as_slice();
    let header = Header::from_reader(&mut rest).map_err(|error| format!("it is no .npy file ({error})"))?;
    let kind = header.type_descriptor.to_string();
    let size = match kind.trim_matches(['\'', '"', '<', '>', '=']) {
        "f8" => 8,
        "f4" => 4,
        _ => return Err(format!("it holds values of type {kind}, save float64 or float32")),
    };
    let rank = header.shape.len();
    if !(1..=2).contains(&rank) {
        return Err(format!("its array has rank {rank}, save rank 1 (a line) or 2 (a surface)"));
    }
    let data = bytes - (start.len() - rest.len()) as u64;
    let expected = header.shape.iter().try_fold(size, |product: u64, &n| product.checked_mul(n as u64));
    match expected {
        Some(expected) if expected == data => Ok(Usable { shape: header.shape, is_single: size == 4 }),
        _ => Err(format!("it holds {data} bytes of data, which is not what its shape {:?} needs", header.shape)),
    }
}

/// Checks that a file can be made at `path`, so that a long computation does not end in vain.
///
/// # Errors
/// [`FileError::Target`] if `path` is a directory or a device, or nothing can be created in its folder.
pub fn check_target(path: &Path) -> Result<(), FileError> {
    beside(path).map(drop)
}

/// A temporary file in the folder of `path`, deleted unless it is renamed.
fn beside(path: &Path) -> Result<NamedTempFile, FileError> {
    let unfit = |reason: String| FileError::Target { path: path.into(), reason };
    if path.file_name().is_none() || path.as_os_str().as_encoded_bytes().ends_with(b"/") || path.is_dir() {
        return Err(unfit("it is a directory, give the name of a file".into()));
    }
    if path.exists() && !path.is_file() {
        return Err(unfit("it is not a regular file, give another name".into()));
    }
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        return Err(unfit(format!("there is no folder {}, make it first", folder.display())));
    }
    temporary(folder).map_err(|error| unfit(format!("nothing can be created in {}: {error}", folder.display())))
}

/// A temporary file with the permissions of any new file, less the umask.
fn temporary(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".asperity-");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

/// Makes the file `path` whole or not at all: `write` fills a temporary file in the same folder, which is flushed,
/// synced and then renamed over `path`.
///
/// # Errors
/// [`FileError::Target`] as [`check_target`]; [`FileError::Write`] if anything fails later. Neither leaves a new file
/// behind, nor touches one that was there.
pub fn write_beside(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>,
) -> Result<(), FileError> {
    let mut temporary = beside(path)?;
    let failed = |source| FileError::Write { path: path.into(), source };
    fill(temporary.as_file_mut(), write).map_err(failed)?;
    temporary.persist(path).map_err(|error| failed(error.error))?;
    Ok(())
}

fn fill(file: &mut File, write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>) -> io::Result<()> {
    let mut writer = BufWriter::new(&mut *file);
    write(&mut writer)?;
    writer.flush()?;
    drop(writer);
    file.sync_all()
}

/// Writes heights (or any field) as a NumPy `.npy` file of doubles.
///
/// # Errors
/// As [`write_beside`].
///
/// ```
/// use asperity::surface::{read_heights, write_heights};
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("heights.npy");
/// let heights = ndarray::arr1(&[0.0, 1.0, 0.5, -1.0]).into_dyn();
/// write_heights(&path, heights.view())?;
/// assert_eq!(read_heights(&path)?, heights);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_heights(path: impl AsRef<Path>, heights: ArrayViewD<f64>) -> Result<(), FileError> {
    write_beside(path.as_ref(), |writer| {
        heights.write_npy(writer).map_err(|error| match error {
            WriteNpyError::Io(source) => source,
            other => io::Error::other(other),
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use ndarray::{Array2, ShapeBuilder, arr2};

    fn reason(path: &Path) -> String {
        match read_heights(path) {
            Err(FileError::Format { reason, .. }) => reason,
            other => panic!("{other:?}"),
        }
    }

    fn entries(folder: &Path) -> usize {
        std::fs::read_dir(folder).unwrap().count()
    }

    #[test]
    fn heights_survive_a_round_trip_in_both_orders() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("h.npy");
        let c = arr2(&[[1.0, 2.0, 3.0], [4.0, 5.0, 6.5]]);
        let mut fortran = Array2::zeros((2, 3).f());
        fortran.assign(&c);
        for heights in [c.clone(), fortran] {
            write_heights(&path, heights.view().into_dyn()).unwrap();
            assert_eq!(read_heights(&path).unwrap(), c.clone().into_dyn());
            assert_eq!(entries(folder.path()), 1);
        }
    }

    #[test]
    fn singles_are_widened() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("h.npy");
        ndarray_npy::write_npy(&path, &ndarray::arr1(&[0.5f32, -2.25])).unwrap();
        assert_eq!(read_heights(&path).unwrap(), ndarray::arr1(&[0.5, -2.25]).into_dyn());
    }

    #[test]
    fn unusable_files_say_why() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("h.npy");
        assert!(matches!(read_heights(&path), Err(FileError::Read { .. })));
        assert!(reason(folder.path()).contains("directory"));
        for text in [&b""[..], b"hello", b"\x93NUMPY\x01\x00\xff\xff", b"\x93NUMPY\x02\x00\xff\xff\xff\xff"] {
            std::fs::write(&path, text).unwrap();
            assert!(reason(&path).contains("no .npy file"), "{text:?}: {}", reason(&path));
        }
        ndarray_npy::write_npy(&path, &ndarray::arr1(&[1i32, 2])).unwrap();
        assert!(reason(&path).contains("i4"), "{}", reason(&path));
        ndarray_npy::write_npy(&path, &ndarray::Array3::<f64>::zeros((1, 2, 3))).unwrap();
        assert!(reason(&path).contains("rank 3"));
        ndarray_npy::write_npy(&path, &ndarray::arr0(1.0)).unwrap();
        assert!(reason(&path).contains("rank 0"));
    }

    #[test]
    fn truncated_and_boastful_files_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("h.npy");
        write_heights(&path, ndarray::ArrayD::zeros(vec![8, 8]).view()).unwrap();
        let whole = std::fs::read(&path).unwrap();
        for length in 0..whole.len() {
            std::fs::write(&path, &whole[..length]).unwrap();
            assert!(!reason(&path).is_empty());
        }
        let boastful = String::from_utf8_lossy(&whole[10..128]).replace("(8, 8)", "(999999999999, 8)");
        let header = [b"\x93NUMPY\x01\x00", &(boastful.len() as u16).to_le_bytes()[..], boastful.as_bytes()].concat();
        std::fs::write(&path, header).unwrap();
        assert!(reason(&path).contains("999999999999"), "{}", reason(&path));
        let nested = [b"\x93NUMPY\x01\x00\x00\x0f", &[b'('; 0x0f00][..]].concat();
        std::fs::write(&path, nested).unwrap();
        assert!(reason(&path).contains("no .npy file"));
    }

    #[test]
    fn unfit_targets_are_refused_and_nothing_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        std::fs::write(&file, "old").unwrap();
        let missing = folder.path().join("missing/h.npy");
        for path in [folder.path(), &missing, &file.join("h.npy"), Path::new("/"), Path::new(""), &file.join("")] {
            assert!(matches!(check_target(path), Err(FileError::Target { .. })), "{path:?}");
            assert!(matches!(write_beside(path, |_| Ok(())), Err(FileError::Target { .. })), "{path:?}");
        }
        assert!(check_target(&file).is_ok() && check_target(Path::new("h.npy")).is_ok());
        assert_eq!((entries(folder.path()), std::fs::read(&file).unwrap()), (1, b"old".to_vec()));
    }

    #[test]
    fn a_failed_write_keeps_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        std::fs::write(&file, "old").unwrap();
        let failed = write_beside(&file, |writer| {
            writer.write_all(b"new")?;
            Err(io::Error::other("disc on fire"))
        });
        assert!(matches!(failed, Err(FileError::Write { .. })));
        assert_eq!((entries(folder.path()), std::fs::read(&file).unwrap()), (1, b"old".to_vec()));
        write_beside(&file, |writer| writer.write_all(b"new")).unwrap();
        assert_eq!((entries(folder.path()), std::fs::read(&file).unwrap()), (1, b"new".to_vec()));
    }

    #[cfg(unix)]
    #[test]
    fn devices_are_no_targets_and_permissions_are_ordinary() {
        use std::os::unix::fs::PermissionsExt;
        assert!(matches!(write_beside(Path::new("/dev/full"), |_| Ok(())), Err(FileError::Target { .. })));
        let folder = tempfile::tempdir().unwrap();
        let (ours, plain) = (folder.path().join("ours"), folder.path().join("plain"));
        write_beside(&ours, |_| Ok(())).unwrap();
        std::fs::write(&plain, "").unwrap();
        let mode = |path: &Path| std::fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&ours), mode(&plain));
    }
}
