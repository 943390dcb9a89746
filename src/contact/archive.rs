//! The fields of contacts in one file.

use super::archive_seal::{ArchiveDigest, SEAL};
use crate::contact::{Contact, On, PartialSlip, Quantity, Reading, Resolved, State};
use crate::elastic::Stress;
use crate::formats::MemberSum;
use crate::surface::PowerSpectrum;
use crc32fast::Hasher;
use ndarray::{
    Array1, ArrayBase, ArrayView1, ArrayView2, Axis, CowArray, Data, Dimension, Ix2, RemoveAxis, arr0, arr1, arr2,
    arr3, stack,
};
use ndarray_npy::{NpzWriter, WritableElement, WriteNpyExt, WriteNpzError};
use std::borrow::Borrow;
use std::io::{self, Cursor, Write};
use strum::IntoEnumIterator;

/// The fields of a contact as `.npz`, with the `rank` of the array of heights, and all numbers that are reported for
/// it.
///
/// | array                                                | shape                | what it holds                               |
/// |------------------------------------------------------|----------------------|---------------------------------------------|
/// | `height`, `pressure`, `gap`, `displacement`          | `(ny, nx)` or `(nx)` | the fields, in the units of the problem     |
/// | `contact`                                            | `(ny, nx)` or `(nx)` | whether the nodes touch                     |
/// | `filled`, where voids were filled                    | `(ny, nx)` or `(nx)` | whether the heights of the nodes were filled in and never measured |
/// | `pressure_edges`, `pressure_density`                 | `(65)`, `(64)`       | the [`Distribution`](crate::contact::Distribution) of the pressure in contact |
/// | `gap_edges`, `gap_density`                           | `(65)`, `(64)`       | and that of the gap beside it               |
/// | `wavenumber`                                         | `(waves)`            | `q = 2 pi / wavelength`, ascending          |
/// | `height_spectrum`, `pressure_spectrum`               | `(waves)`            | the [`PowerSpectrum`] of each               |
/// | `segments`, of rank 1                                | `(n, 2)`             | first and last position of each segment of contact |
/// | `contour`, of rank 2                                 | `(n, 2, 2)`          | lines of the contour, the `x` and `y` of both ends |
/// | `x`, and `y` of rank 2                               | `(nx)`, `(ny)`       | positions of columns and rows, from 0       |
/// | `size`                                               | `(rank)`             | lengths of the cell along the axes          |
/// | `contact_modulus`                                    | `()`                 | `E*`                                        |
/// | those of [`Quantity`] with a meaning              | `()`                 | load, area and all else, by their names     |
/// | `converged`                                          | `()`                 | whether the certificate met the tolerance   |
/// | `status`, `solver`                                   | bytes                | how the solver stopped, and its name        |
/// | `certificate_numbers`                                | `(9)`                | all numbers of the [`Certificate`](crate::contact::Certificate), in the order of its fields |
/// | `coarser`                                            | `(6)`                | the contact on the next coarser grid: relative area, rms gradient, `kappa_r`, reduced pressure, and numbers of edges; NaN if it is not known |
/// | `yielding`, where there is a hardness                | `(ny, nx)` or `(nx)` | whether the nodes yield                     |
/// | `overlap`, where there is a hardness                 | `(ny, nx)` or `(nx)` | the overlap of the nodes that yield, which is not part of the gap |
/// | `hardness`, where there is one                       | `()`                 | the hardness                                |
/// | `setup`                                              | bytes                | the text of the setup that repeats it       |
/// | `digest`                                             | bytes                | the digest of all other arrays with the version of the program, see [`ArchiveSeal`](crate::contact::ArchiveSeal) |
///
/// The text is `bytes(npz["setup"]).decode()` in Python.
///
/// The archive is made in memory, spectra first, while there is room for their transforms: a `ZipWriter` that meets a
/// full disk writes to standard error.
///
/// # Errors
/// The errors of the format, which fields of doubles do not meet.
pub fn archive(contact: &Contact, rank: usize, setup: Option<&str>) -> Result<Vec<u8>, WriteNpzError> {
    ArchiveWriter::new(&[contact], false, rank, setup)?.finish()
}

/// One state as `.npz`: as [`archive`], with the further fields of the state under their names. Where the leakage was found, these are, along both axes, the
/// magnitude of the flux over its mean (`flux_x`, `flux_y`), and the pressure of the fluid over its drop (`fluid_pressure_x`,
/// `fluid_pressure_y`), which is NaN where nothing flows.
///
/// # Errors
/// The errors of [`archive`].
pub fn archive_of_state(state: &State, rank: usize, setup: Option<&str>) -> Result<Vec<u8>, WriteNpzError> {
    let mut archive = ArchiveWriter::new(&[&state.contact], false, rank, setup)?;
    archive.add_state_fields(&[state])?;
    archive.finish()
}

/// A contact in partial slip as `.npz`: as [`archive`] of what is pressed, with the `traction`, where it sticks (`stick`) and the pressure of the
/// contact that sticks (`stick_pressure`), all of the shape of the pressure, and the numbers `friction_coefficient`, `tangential`, `stick_area` and
/// `slip_area`.
///
/// # Errors
/// The errors of [`archive`].
pub fn archive_of_slip(slip: &PartialSlip, rank: usize, setup: Option<&str>) -> Result<Vec<u8>, WriteNpzError> {
    let mut archive = ArchiveWriter::new(&[&slip.pressed], false, rank, setup)?;
    archive.add_field("traction", slip.traction().view())?;
    archive.add_field("stick", slip.sticks().view())?;
    archive.add_field("stick_pressure", slip.stuck.pressure.view())?;
    let areas = [("stick_area", slip.stick().relative_area), ("slip_area", slip.slip_area())];
    let loads = [("friction_coefficient", slip.friction.coefficient), ("tangential", slip.friction.tangential)];
    for (name, value) in loads.into_iter().chain(areas) {
        archive.add_array(name, &arr0(value))?;
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
    let mut npz = ArchiveWriter::empty(2, false, true);
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
    npz.finish()
}

/// The states of a process as `.npz`: as [`archive_of_state`], with the states along a further first axis of all but `height` and its spectrum,
/// wavenumbers, positions, size and modulus. A number that only some of the states have is NaN in the others. Two texts have a line for each state:
/// its claim (`claim`), and the point of the path that it has reached (`point`), from 0, or `-` between two points. Where tractions of different
/// bodies displace the surface into the solid, `displacement` includes it.
///
/// States of a solid that yields below its surface have the cut below the row `cut_row`: the depths of the interfaces of the layers, `cut_interfaces`,
/// shape `(layers + 1)`, and in the layers the accumulated plastic strain `cut_plastic_strain` and the von Mises stress `cut_von_mises`, shape
/// `(states, layers, nx)`.
///
/// # Errors
/// The errors of the format, which fields of doubles do not meet, unless there are no states.
pub fn archive_of_states(states: &[impl Borrow<State>], rank: usize, setup: &str) -> Result<Vec<u8>, WriteNpzError> {
    let states: Vec<&State> = states.iter().map(Borrow::borrow).collect();
    archive_of(&states, ArchiveWriter::empty(rank, true, false), setup)
}

/// One of the states of a run that goes on, as `.npz`: as [`archive_of_states`], without spectra and distributions.
///
/// # Errors
/// The errors of [`archive_of_states`].
pub fn archive_of_part(state: &State, rank: usize, setup: &str) -> Result<Vec<u8>, WriteNpzError> {
    archive_of(&[state], ArchiveWriter::empty(rank, true, true), setup)
}

/// The states in an archive that has begun.
fn archive_of(states: &[&State], archive: ArchiveWriter, setup: &str) -> Result<Vec<u8>, WriteNpzError> {
    let contacts: Vec<&Contact> = states.iter().map(|state| &state.contact).collect();
    let mut archive = archive.with(&contacts, Some(setup))?;
    let points: Vec<String> =
        states.iter().map(|it| it.point.map_or("-".to_owned(), |point| point.to_string())).collect();
    archive.add_words("claim", states.iter().map(|it| it.claim.into()))?;
    archive.add_words("point", points.iter().map(String::as_str))?;
    archive.add_state_fields(states)?;
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

/// The array of all numbers of the certificates.
pub(super) const CERTIFICATE: &str = "certificate_numbers";

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
    /// The digest of the arrays so far.
    digest: ArchiveDigest,
    rank: usize,
    /// Whether what depends on the state has a first axis of states.
    is_list: bool,
    /// Whether spectra and distributions are left out.
    is_short: bool,
}

impl ArchiveWriter {
    /// An archive of the contacts of one surface, if there are any.
    fn new(contacts: &[&Contact], is_list: bool, rank: usize, setup: Option<&str>) -> Result<Self, WriteNpzError> {
        Self::empty(rank, is_list, false).with(contacts, setup)
    }

    fn empty(rank: usize, is_list: bool, is_short: bool) -> Self {
        let npz = NpzWriter::new(Cursor::new(Vec::new()));
        Self { npz, digest: ArchiveDigest::own(), rank, is_list, is_short }
    }

    fn with(mut self, contacts: &[&Contact], setup: Option<&str>) -> Result<Self, WriteNpzError> {
        if let Some(first) = contacts.first() {
            self.add_problem(first, setup)?;
            self.add_contacts(first, contacts)?;
        }
        Ok(self)
    }

    fn add_contacts(&mut self, first: &Contact, contacts: &[&Contact]) -> Result<(), WriteNpzError> {
        let curves = if self.is_short { &[][..] } else { &CURVES };
        for (name, of) in curves {
            self.add_each(name, contacts.iter().map(|contact| Array1::from(of(contact)).into()))?;
        }
        for (name, of) in FIELDS {
            self.add_fields(name, contacts.iter().map(|contact| of(contact).into()))?;
        }
        self.add_fields("contact", contacts.iter().map(|contact| contact.mask().into()))?;
        if !self.is_list {
            self.add_outline(first)?;
        }
        self.add_each("converged", contacts.iter().map(|contact| arr0(contact.is_converged()).into()))?;
        self.add_words("status", contacts.iter().map(|contact| contact.status.name()))?;
        self.add_words("solver", contacts.iter().map(|contact| contact.solver.as_str()))?;
        self.add_each("coarser", contacts.iter().map(|contact| arr1(&Resolved::numbers(contact.coarser)).into()))?;
        self.add_each(CERTIFICATE, contacts.iter().map(|contact| arr1(&contact.certificate.numbers()).into()))?;
        if let Some(hardness) = first.problem.law().hardness() {
            self.add_fields("yielding", contacts.iter().map(|contact| contact.yielding().into()))?;
            self.add_fields("overlap", contacts.iter().map(|contact| contact.overlap().into()))?;
            self.add_array("hardness", &arr0(hardness))?;
        }
        let readings: Vec<Reading<'_>> = contacts.iter().map(|contact| Reading::from(*contact)).collect();
        // a number without a meaning is absent
        let has = |it: &Quantity| {
            contacts.iter().zip(&readings).any(|(contact, reading)| it.tells_of(contact) && reading.get(*it).is_some())
        };
        for quantity in Quantity::iter().filter(has) {
            self.add_each(quantity.name(), readings.iter().map(|it| arr0(it.value(quantity)).into()))?;
        }
        Ok(())
    }

    /// Adds what does not depend on the load.
    fn add_problem(&mut self, contact: &Contact, setup: Option<&str>) -> Result<(), WriteNpzError> {
        if let Some(text) = setup {
            self.add_array("setup", &ArrayView1::from(text.as_bytes()))?;
        }
        let (surface, modulus) = (contact.problem.surface(), contact.problem.contact_modulus());
        let grid = surface.grid();
        self.add_array("x", &grid.x().collect::<Array1<f64>>())?;
        if self.rank > 1 {
            self.add_array("y", &grid.y().collect::<Array1<f64>>())?;
        }
        self.add_array("size", &ArrayView1::from(&grid.size()[2 - self.rank.min(2)..]))?;
        self.add_array("contact_modulus", &arr0(modulus))?;
        if !self.is_short {
            let heights = PowerSpectrum::new(surface);
            self.add_array("wavenumber", &ArrayView1::from(&heights.wavenumber))?;
            self.add_array("height_spectrum", &ArrayView1::from(&heights.density))?;
        }
        if let Some(filled) = surface.filled() {
            let filled = ArrayView2::from_shape(grid.shape(), filled).expect("filled nodes are those of the grid");
            self.add_field("filled", filled)?;
        }
        self.add_field("height", surface.heights_as_given().view())
    }

    /// Adds the fields that states have besides those of their contacts, and the layers that some of them lie in.
    fn add_state_fields(&mut self, states: &[&State]) -> Result<(), WriteNpzError> {
        let Some(first) = states.first() else { return Ok(()) };
        if let Some(layers) = &first.layers {
            self.add_array("cut_row", &arr0(layers.row as u64))?;
            self.add_array("cut_interfaces", &ArrayView1::from(&layers.interfaces))?;
        }
        for kind in first.fields.iter().map(|it| it.kind) {
            let (row, values) = (kind.row(), states.iter().filter_map(|state| Some(state.field(kind)?.view().into())));
            match row.on {
                On::Surface => self.add_fields(row.array, values)?,
                // a cut has layers along its first axis, below a line too
                On::Cut => self.add_each(row.array, values)?,
            }
        }
        Ok(())
    }

    /// Adds the edges of a contact, resolved between the nodes.
    fn add_outline(&mut self, contact: &Contact) -> Result<(), WriteNpzError> {
        let edges = contact.edges();
        if self.rank == 1 {
            return self.add_array("segments", &arr2(&edges.segments()));
        }
        let [dy, dx] = contact.problem.surface().grid().spacing();
        let lines: Vec<[[f64; 2]; 2]> =
            edges.contour().into_iter().map(|line| line.map(|[y, x]| [x * dx, y * dy])).collect();
        self.add_array("contour", &arr3(&lines))
    }

    /// Adds a field of the rank that the heights came in.
    fn add_field<T: WritableElement>(&mut self, name: &str, field: ArrayView2<'_, T>) -> Result<(), WriteNpzError> {
        if self.rank == 1 { self.add_array(name, &field.row(0)) } else { self.add_array(name, &field) }
    }

    /// Adds a field of each contact.
    fn add_fields<'a, T: WritableElement + Clone + 'a>(
        &mut self,
        name: &str,
        fields: impl Iterator<Item = CowArray<'a, T, Ix2>>,
    ) -> Result<(), WriteNpzError> {
        if self.rank == 1 {
            self.add_each(name, fields.map(|field| field.index_axis_move(Axis(0), 0)))
        } else {
            self.add_each(name, fields)
        }
    }

    /// Adds an array of each contact, those of a list along a first axis.
    fn add_each<'a, T: WritableElement + Clone + 'a, D: Dimension<Larger: RemoveAxis>>(
        &mut self,
        name: &str,
        arrays: impl Iterator<Item = CowArray<'a, T, D>>,
    ) -> Result<(), WriteNpzError> {
        let arrays: Vec<_> = arrays.collect();
        match arrays.as_slice() {
            [one] if !self.is_list => self.add_array(name, one),
            several => {
                let views: Vec<_> = several.iter().map(|array| array.view()).collect();
                self.add_array(name, &stack(Axis(0), &views).expect("the contacts are of one surface"))
            }
        }
    }

    /// Adds a text of lines, with a word of each contact.
    fn add_words<'a>(&mut self, name: &str, words: impl Iterator<Item = &'a str>) -> Result<(), WriteNpzError> {
        let text = words.collect::<Vec<_>>().join("\n");
        self.add_array(name, &ArrayView1::from(text.as_bytes()))
    }

    /// Adds an array to the archive and to its digest.
    fn add_array<S: Data<Elem: WritableElement>, D: Dimension>(
        &mut self,
        name: &str,
        array: &ArrayBase<S, D>,
    ) -> Result<(), WriteNpzError> {
        // the archive does not tell the check sums of its members, so that the bytes are made twice
        let mut sum = ByteSum::default();
        array.write_npy(&mut sum)?;
        self.digest.add(&MemberSum { name: name.into(), bytes: sum.bytes, crc: sum.crc.finalize() });
        self.npz.add_array(name, array)
    }

    /// The bytes of the archive, with its digest at the end.
    fn finish(mut self) -> Result<Vec<u8>, WriteNpzError> {
        self.npz.add_array(SEAL, &ArrayView1::from(self.digest.own_seal().as_bytes()))?;
        Ok(self.npz.finish()?.into_inner())
    }
}

/// The length and the check sum of bytes that are written to it and not kept.
#[derive(Default)]
struct ByteSum {
    bytes: u64,
    crc: Hasher,
}

impl Write for ByteSum {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.bytes += bytes.len() as u64;
        self.crc.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
