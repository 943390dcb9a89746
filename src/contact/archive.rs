//! The fields of contacts in one file.

use crate::contact::{Contact, OBSERVABLES, PartialSlip, State};
use crate::elastic::Stress;
use crate::surface::PowerSpectrum;
use ndarray::{Array0, Array1, Array2, ArrayView, ArrayView1, ArrayView2, Axis, Dimension, arr0, arr2, arr3, stack};
use ndarray_npy::{NpzWriter, WritableElement, WriteNpzError};
use std::io::Cursor;

/// The fields of a contact as `.npz`, with the `rank` of the array of heights, and all numbers that are reported for
/// it.
///
/// | array                                                | shape                | what it holds                               |
/// |------------------------------------------------------|----------------------|---------------------------------------------|
/// | `height`, `pressure`, `gap`, `displacement`          | `(ny, nx)` or `(nx)` | the fields, in the units of the problem     |
/// | `contact`                                            | `(ny, nx)` or `(nx)` | whether the nodes touch                     |
/// | `pressure_edges`, `pressure_density`                 | `(65)`, `(64)`       | the [`Distribution`](crate::contact::Distribution) of the pressure in contact |
/// | `gap_edges`, `gap_density`                           | `(65)`, `(64)`       | and that of the gap beside it               |
/// | `wavenumber`                                         | `(waves)`            | `q = 2 pi / wavelength`, ascending          |
/// | `height_spectrum`, `pressure_spectrum`               | `(waves)`            | the [`PowerSpectrum`] of each               |
/// | `segments`, of rank 1                                | `(n, 2)`             | first and last position of each segment of contact |
/// | `contour`, of rank 2                                 | `(n, 2, 2)`          | lines of the contour, the `x` and `y` of both ends |
/// | `x`, and `y` of rank 2                               | `(nx)`, `(ny)`       | positions of columns and rows, from 0       |
/// | `size`                                               | `(rank)`             | lengths of the cell along the axes          |
/// | `contact_modulus`                                    | `()`                 | `E*`                                        |
/// | those of [`OBSERVABLES`]                             | `()`                 | load, area and all else, by their names     |
/// | `converged`                                          | `()`                 | whether the certificate met the tolerance   |
/// | `yielding`, where there is a hardness                | `(ny, nx)` or `(nx)` | whether the nodes yield                     |
/// | `hardness`, `plastic_overlap`, `plastic_load_share` | `()`  | it, and the [`Plasticity`](crate::contact::Plasticity) |
/// | `setup`                                              | bytes                | the text of the setup that repeats it       |
///
/// The text is `bytes(npz["setup"]).decode()` in Python.
///
/// The archive is made in memory, spectra first, while there is room for their transforms: a `ZipWriter` that meets a
/// full disk writes to standard error.
///
/// # Errors
/// The errors of the format, which fields of doubles do not meet.
pub fn archive(contact: &Contact, rank: usize, setup: Option<&str>) -> Result<Vec<u8>, WriteNpzError> {
    of_one(contact, rank, setup)?.finish()
}

/// A contact in partial slip as `.npz`: as [`archive`] of what is pressed, with the `traction` and where it sticks (`stick`), both of
/// the shape of the pressure, and the numbers `friction`, `tangential`, `stick_area` and `slip_area`.
///
/// # Errors
/// The errors of [`archive`].
pub fn archive_of_slip(slip: &PartialSlip, rank: usize, setup: Option<&str>) -> Result<Vec<u8>, WriteNpzError> {
    let mut archive = of_one(&slip.pressed, rank, setup)?;
    archive.add_field("traction", &slip.traction().view())?;
    archive.add_field("stick", &slip.sticks().view())?;
    let areas = [("stick_area", slip.stick().relative_area), ("slip_area", slip.slip_area())];
    let loads = [("friction", slip.friction.coefficient), ("tangential", slip.friction.tangential)];
    for (name, value) in loads.into_iter().chain(areas) {
        archive.npz.add_array(name, &arr0(value))?;
    }
    archive.finish()
}

/// The stress below row `row` of a contact as `.npz`.
///
/// | array                                               | shape          | what it holds                                  |
/// |-----------------------------------------------------|----------------|------------------------------------------------|
/// | `x`                                                 | `(nx)`         | positions of the columns, from 0               |
/// | `depth`                                             | `(depths)`     | depths below the surface                       |
/// | `pressure`                                          | `(nx)`         | the pressure above                             |
/// | `sigma_xx`, `sigma_yy`, `sigma_zz`, `tau_xz`        | `(depths, nx)` | stresses, positive in tension                  |
/// | `tau_xy`, `tau_yz`, of surfaces                     | `(depths, nx)` | the others, which are zero below lines         |
/// | `tau_max`, `von_mises`                              | `(depths, nx)` | see [`Stress`]                                 |
/// | `sigma_confined`                                    | `()`           | the part of `sigma_xx` by the mean pressure without lateral strain, see [`Contact::confined_stress`] |
/// | `row`                                               | `()`           | the row, from 0                                |
/// | `poisson`, `poisson_is_assumed`                     | `()`           | Poisson's ratio, and whether it was assumed
/// |
/// | `setup`                                             | bytes          | the text of the setup that repeats it          |
///
/// # Errors
/// The errors of [`archive`].
pub fn archive_of_stress(
    (contact, row): (&Contact, usize),
    stress: &Stress,
    poisson_is_assumed: bool,
    setup: &str,
) -> Result<Vec<u8>, WriteNpzError> {
    let mut npz = NpzWriter::new(Cursor::new(Vec::new()));
    npz.add_array("setup", &ArrayView1::from(setup.as_bytes()))?;
    npz.add_array("x", &contact.problem.surface().grid().x().collect::<Array1<f64>>())?;
    npz.add_array("depth", &ArrayView1::from(&stress.depth))?;
    npz.add_array("pressure", &contact.pressure.row(row))?;
    let plane = [("sigma_xx", &stress.xx), ("sigma_yy", &stress.yy), ("sigma_zz", &stress.zz), ("tau_xz", &stress.xz)];
    let others = [("tau_xy", &stress.xy), ("tau_yz", &stress.yz)].into_iter().filter(|_| !stress.is_plane);
    for (name, field) in plane.into_iter().chain(others) {
        npz.add_array(name, field)?;
    }
    npz.add_array("tau_max", &stress.tau_max())?;
    npz.add_array("von_mises", &stress.von_mises())?;
    npz.add_array("sigma_confined", &arr0(contact.confined_stress(stress.poisson)))?;
    npz.add_array("row", &arr0(row as u64))?;
    npz.add_array("poisson", &arr0(stress.poisson))?;
    npz.add_array("poisson_is_assumed", &arr0(poisson_is_assumed))?;
    Ok(npz.finish()?.into_inner())
}

/// The archive of one contact, to which more can be added.
fn of_one(contact: &Contact, rank: usize, setup: Option<&str>) -> Result<ArchiveWriter, WriteNpzError> {
    let mut archive = ArchiveWriter::new(contact, rank, setup)?;
    for (name, of) in CURVES {
        archive.npz.add_array(name, &ArrayView1::from(&of(contact)))?;
    }
    for (name, of) in FIELDS {
        archive.add_field(name, &of(contact))?;
    }
    archive.add_field("contact", &contact.mask().view())?;
    archive.add_outline(contact)?;
    archive.npz.add_array("converged", &arr0(contact.is_converged()))?;
    if let Some(hardness) = contact.problem.law().hardness() {
        archive.add_field("yielding", &contact.yielding().view())?;
        archive.npz.add_array("hardness", &arr0(hardness))?;
        for (name, of) in PLASTICITY {
            archive.npz.add_array(name, &arr0(of(contact)))?;
        }
    }
    let state = State::from(contact);
    for row in OBSERVABLES {
        archive.npz.add_array(row.name, &arr0((row.value)(&state)))?;
    }
    Ok(archive)
}

/// The contacts of one surface under several loads as `.npz`: as [`archive`], with the loads along a further first axis of all but
/// `height` and its spectrum, wavenumbers, positions, size and modulus.
///
/// # Errors
/// The errors of the format, which fields of doubles do not meet, unless there are no contacts.
pub fn archive_of_loads(contacts: &[Contact], rank: usize, setup: &str) -> Result<Vec<u8>, WriteNpzError> {
    let Some(first) = contacts.first() else {
        return Ok(NpzWriter::new(Cursor::new(Vec::new())).finish()?.into_inner());
    };
    let mut archive = ArchiveWriter::new(first, rank, Some(setup))?;
    for (name, of) in CURVES {
        let curves: Vec<Array1<f64>> = contacts.iter().map(|contact| of(contact).into()).collect();
        let curves: Vec<ArrayView1<f64>> = curves.iter().map(|curve| curve.view()).collect();
        archive.npz.add_array(name, &stack(Axis(0), &curves).expect("one surface has one set of waves"))?;
    }
    for (name, of) in FIELDS {
        let fields: Vec<ArrayView2<f64>> = contacts.iter().map(of).collect();
        archive.add_field(name, &stack(Axis(0), &fields).expect("one surface has one shape").view())?;
    }
    let masks: Vec<Array2<bool>> = contacts.iter().map(Contact::mask).collect();
    let masks: Vec<ArrayView2<bool>> = masks.iter().map(|mask| mask.view()).collect();
    archive.add_field("contact", &stack(Axis(0), &masks).expect("one surface has one shape").view())?;
    archive.npz.add_array("converged", &contacts.iter().map(Contact::is_converged).collect::<Array1<bool>>())?;
    if let Some(hardness) = first.problem.law().hardness() {
        let masks: Vec<Array2<bool>> = contacts.iter().map(Contact::yielding).collect();
        let masks: Vec<ArrayView2<bool>> = masks.iter().map(|mask| mask.view()).collect();
        archive.add_field("yielding", &stack(Axis(0), &masks).expect("one surface has one shape").view())?;
        archive.npz.add_array("hardness", &arr0(hardness))?;
        for (name, of) in PLASTICITY {
            archive.npz.add_array(name, &contacts.iter().map(of).collect::<Array1<f64>>())?;
        }
    }
    let states: Vec<State<'_>> = contacts.iter().map(State::from).collect();
    for row in OBSERVABLES {
        archive.npz.add_array(row.name, &states.iter().map(row.value).collect::<Array1<f64>>())?;
    }
    archive.finish()
}

/// A field of a contact.
type FieldOf = fn(&Contact) -> ArrayView2<'_, f64>;

/// The fields that are found.
const FIELDS: [(&str, FieldOf); 3] = [
    ("pressure", |contact| contact.pressure.view()),
    ("gap", |contact| contact.gap.view()),
    ("displacement", |contact| contact.displacement.view()),
];

/// A number of a contact.
type NumberOf = fn(&Contact) -> f64;

/// What yields.
const PLASTICITY: [(&str, NumberOf); 2] = [
    ("plastic_overlap", |contact| contact.plasticity().overlap),
    ("plastic_load_share", |contact| contact.plasticity().load_share),
];

/// Bins of the distributions.
const BINS: usize = 64;

/// A curve over the bins or waves of a contact.
type CurveOf = fn(&Contact) -> Vec<f64>;

/// The curves that are found: distributions, and the spectrum of the pressure.
const CURVES: [(&str, CurveOf); 5] = [
    ("pressure_edges", |contact| contact.pressure_distribution(BINS, contact.max_pressure()).edges),
    ("pressure_density", |contact| contact.pressure_distribution(BINS, contact.max_pressure()).density),
    ("gap_edges", |contact| contact.gap_distribution(BINS, contact.max_gap()).edges),
    ("gap_density", |contact| contact.gap_distribution(BINS, contact.max_gap()).density),
    ("pressure_spectrum", |contact| contact.pressure_spectrum().density),
];

/// An archive that is being written.
struct ArchiveWriter {
    npz: NpzWriter<Cursor<Vec<u8>>>,
    rank: usize,
}

impl ArchiveWriter {
    /// An archive of what does not depend on the load.
    fn new(contact: &Contact, rank: usize, setup: Option<&str>) -> Result<Self, WriteNpzError> {
        let mut npz = NpzWriter::new(Cursor::new(Vec::new()));
        if let Some(text) = setup {
            npz.add_array("setup", &ArrayView1::from(text.as_bytes()))?;
        }
        let (surface, modulus) = (contact.problem.surface(), contact.problem.contact_modulus());
        let grid = surface.grid();
        npz.add_array("x", &grid.x().collect::<Array1<f64>>())?;
        if rank > 1 {
            npz.add_array("y", &grid.y().collect::<Array1<f64>>())?;
        }
        npz.add_array("size", &ArrayView1::from(&grid.size()[2 - rank.min(2)..]))?;
        npz.add_array("contact_modulus", &Array0::from_elem((), modulus))?;
        let heights = PowerSpectrum::new(surface);
        npz.add_array("wavenumber", &ArrayView1::from(&heights.wavenumber))?;
        npz.add_array("height_spectrum", &ArrayView1::from(&heights.density))?;
        let mut archive = Self { npz, rank };
        archive.add_field("height", &surface.heights_as_given().view())?;
        Ok(archive)
    }

    /// Adds the edges of a contact, resolved between the nodes.
    fn add_outline(&mut self, contact: &Contact) -> Result<(), WriteNpzError> {
        let edges = contact.edges();
        if self.rank == 1 {
            return self.npz.add_array("segments", &arr2(&edges.segments()));
        }
        let [dy, dx] = contact.problem.surface().grid().spacing();
        let lines: Vec<[[f64; 2]; 2]> =
            edges.contour().into_iter().map(|line| line.map(|[y, x]| [x * dx, y * dy])).collect();
        self.npz.add_array("contour", &arr3(&lines))
    }

    /// Adds a field whose last axes are those of the grid.
    fn add_field<T: WritableElement, D: Dimension>(
        &mut self,
        name: &str,
        field: &ArrayView<'_, T, D>,
    ) -> Result<(), WriteNpzError> {
        let field = field.view().into_dyn();
        let rows = Axis(field.ndim() - 2);
        if self.rank == 1 {
            self.npz.add_array(name, &field.index_axis(rows, 0))
        } else {
            self.npz.add_array(name, &field)
        }
    }

    fn finish(self) -> Result<Vec<u8>, WriteNpzError> {
        Ok(self.npz.finish()?.into_inner())
    }
}
