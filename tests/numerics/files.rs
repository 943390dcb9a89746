//! Output files that appear completely or not at all.

use asperity::error::FileError;
use asperity::files::{check_target, write_beside};
use std::io::{self, Write};
use std::path::Path;

fn entries(folder: &Path) -> usize {
    std::fs::read_dir(folder).unwrap().count()
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

#[test]
fn drafts_go_when_a_writer_panics() {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("file");
    let panicked = std::panic::catch_unwind(|| {
        write_beside(&target, |_| {
            assert_eq!(entries(folder.path()), 1);
            panic!("on purpose")
        })
    });
    assert!(panicked.is_err() && entries(folder.path()) == 0);
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
