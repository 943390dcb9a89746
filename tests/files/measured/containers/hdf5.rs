//! Files of HDF5, which `tests/data/hdf5/make.py` writes with h5py, the library of the HDF Group.

/// A map, a profile and an amplitude in a group, with links that lead in circles.
pub fn plain() -> Vec<u8> {
    include_bytes!("../../../data/hdf5/plain.h5").to_vec()
}

/// A map in packed chunks and a series of one map.
pub fn packed() -> Vec<u8> {
    include_bytes!("../../../data/hdf5/packed.h5").to_vec()
}

/// A surface of Zygo Mx to which links lead.
pub fn zygo() -> Vec<u8> {
    include_bytes!("../../../data/hdf5/nanometres.datx").to_vec()
}

/// A surface of Zygo Mx in fringes, without links.
pub fn fringes() -> Vec<u8> {
    include_bytes!("../../../data/hdf5/fringes.datx").to_vec()
}

/// A map of NetCDF-4 whose coordinates fall along x, with a mask, and an uneven profile.
pub fn scales() -> Vec<u8> {
    include_bytes!("../../../data/hdf5/scales.nc").to_vec()
}

/// A dataset of a million by a million points, none of which is stored.
pub fn huge() -> Vec<u8> {
    include_bytes!("../../../data/hdf5/huge.h5").to_vec()
}
