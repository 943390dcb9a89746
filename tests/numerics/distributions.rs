//! Distributions of pressure and gap, the spectrum of the pressure, and the elastic energy, against exact solutions.

use crate::common::solve;
use asperity::contact::{
    Contact, ContactModulus, Distribution, Load, Multilevel, Problem, State, archive, archive_of_states,
};
use asperity::surface::{Indenter, PowerSpectrum, Spectrum};
use asperity::theory::Westergaard;
use asperity::{Grid, Surface};
use std::f64::consts::PI;

fn sine(load: Load) -> Contact {
    let surface = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(4096, 1.0).unwrap()).unwrap();
    solve(&Multilevel, &Problem::new(surface, ContactModulus(1.0), load).unwrap(), 1e-10)
}

fn rough(grid: Grid, reduced_pressure: f64) -> Contact {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.05, rms_gradient: 0.02 };
    let surface = Surface::rough(grid, &spectrum, 1).unwrap();
    let load = Load::ReducedPressure(reduced_pressure);
    solve(&Multilevel, &Problem::new(surface, ContactModulus(2.0), load).unwrap(), 1e-10)
}

/// The share of the nodes in the bins up to some value.
fn share(distribution: &Distribution, up_to: f64) -> f64 {
    let bins = distribution.bins().filter(|([_, high], _)| *high <= up_to * (1.0 + 1e-12));
    bins.map(|([low, high], density)| density * (high - low)).sum()
}

#[test]
fn a_sine_in_full_contact_has_the_arcsine_law() {
    // p = m (1 + cos x) / 1 at the load where the valleys just touch: share below m is one half, below m/2 one third
    let full = Westergaard { amplitude: 0.01, period: 1.0, contact_modulus: 1.0 }.full_pressure();
    let contact = sine(Load::MeanPressure(1.0001 * full));
    let distribution = contact.pressure_distribution(400, 2.0 * full);
    assert_eq!(distribution.density.len(), 400);
    assert!(
        (share(&distribution, full) - 0.5).abs() < 2e-3 && (share(&distribution, 0.5 * full) - 1.0 / 3.0).abs() < 2e-3
    );
    let gap = contact.gap_distribution(10, contact.max_gap());
    assert!(gap.density.iter().all(|density| *density == 0.0), "{gap:?}");
}

#[test]
fn shares_of_pressure_and_gap_are_contact_and_the_rest() {
    for grid in [Grid::line(4096, 1.0).unwrap(), Grid::surface([128, 96], [1.0, 1.0]).unwrap()] {
        let contact = rough(grid, 0.05);
        let area = contact.counted().relative_area;
        let pressure = contact.pressure_distribution(64, contact.max_pressure());
        let gap = contact.gap_distribution(64, contact.max_gap());
        let all = f64::INFINITY;
        assert!((share(&pressure, all) - area).abs() < 1e-12 && (share(&gap, all) - (1.0 - area)).abs() < 1e-12);
        // the mean of the binned pressure is the load, to the width of a bin
        let mean: f64 = pressure.bins().map(|([low, high], density)| density * 0.5 * (high * high - low * low)).sum();
        assert!((mean / contact.mean_pressure() - 1.0).abs() < 0.02, "{mean}");
    }
}

#[test]
fn the_spectrum_of_the_pressure_sums_to_its_variance() {
    for grid in [Grid::line(4096, 1.0).unwrap(), Grid::surface([128, 96], [1.0, 1.0]).unwrap()] {
        let contact = rough(grid, 0.05);
        let mean = contact.mean_pressure();
        let variance = contact.pressure.mapv(|p| (p - mean).powi(2)).mean().unwrap();
        let sum = contact.pressure_spectrum().integral(|_, density| density);
        assert!((sum / variance - 1.0).abs() < 1e-12, "{sum} against {variance}");
    }
}

#[test]
fn the_elastic_energy_is_a_sum_over_waves() {
    // on a line, where each wave has a value of its own: <p u>/2 with u = 2 p/(E* q), and E* = 2
    let contact = rough(Grid::line(4096, 1.0).unwrap(), 0.05);
    let sum = contact.pressure_spectrum().integral(|q, density| 0.5 * density / q);
    assert!((sum / contact.elastic_energy() - 1.0).abs() < 1e-12, "{sum} against {}", contact.elastic_energy());
}

#[test]
fn in_full_contact_pressures_follow_the_heights() {
    let grid = Grid::line(1024, 1.0).unwrap();
    let contact = rough(grid, 20.0);
    assert_eq!(contact.counted().relative_area, 1.0);
    let (heights, pressures) = (PowerSpectrum::new(contact.problem.surface()), contact.pressure_spectrum());
    for ((q, height), pressure) in heights.wavenumber.iter().zip(&heights.density).zip(&pressures.density) {
        let expected = (0.5 * 2.0 * q).powi(2) * height;
        assert!((pressure - expected).abs() < 1e-9 * pressures.density[0].max(expected), "{q}: {pressure} {expected}");
    }
}

#[test]
fn the_load_is_what_the_elastic_energy_falls_by_with_the_mean_gap() {
    // Westergaard's sine in full contact: U = E* q D^2/8, and a gap of nothing
    let full = sine(Load::MeanPressure(0.05));
    let expected = 2.0 * PI * 0.01 * 0.01 / 8.0;
    assert!((full.elastic_energy() / expected - 1.0).abs() < 1e-6, "{}", full.elastic_energy());
    let on_surface = |load: Load| rough(Grid::surface([96, 96], [1.0, 1.0]).unwrap(), load.value() / (2.0 * 0.02));
    let contacts: [fn(Load) -> Contact; 2] = [sine, on_surface];
    for contact in contacts {
        let at = |pressure: f64| contact(Load::MeanPressure(pressure));
        let [below, middle, above] = [0.98, 1.0, 1.02].map(|factor| at(0.004 * factor));
        let slope = (above.elastic_energy() - below.elastic_energy()) / (below.mean_gap() - above.mean_gap());
        assert!((slope / middle.mean_pressure() - 1.0).abs() < 3e-3, "{slope} against {}", middle.mean_pressure());
    }
}

#[test]
fn archives_hold_distributions_and_spectra() {
    let contacts = [0.01, 0.05].map(|pressure| rough(Grid::surface([48, 72], [1.0, 1.5]).unwrap(), pressure));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("contacts.npz");
    let read = |bytes: Vec<u8>, name: &str| -> ndarray::ArrayD<f64> {
        std::fs::write(&path, bytes).unwrap();
        ndarray_npy::NpzReader::new(std::fs::File::open(&path).unwrap()).unwrap().by_name(name).unwrap()
    };
    let spectrum = contacts[1].pressure_spectrum();
    let one = |name| read(archive(&contacts[1], 2, None).unwrap(), name);
    let states = contacts.clone().map(|contact| State::from_contact(contact, None));
    let all = |name| read(archive_of_states(&states, 2, "").unwrap(), name);
    let waves = spectrum.density.len();
    assert_eq!(one("pressure_spectrum").into_raw_vec_and_offset().0, spectrum.density);
    assert_eq!(one("wavenumber").into_raw_vec_and_offset().0, spectrum.wavenumber);
    assert_eq!((one("height_spectrum").shape(), all("height_spectrum").shape()), (&[waves][..], &[waves][..]));
    assert_eq!(all("pressure_spectrum").shape(), [2, waves]);
    for (name, bins) in [("pressure_edges", 65), ("pressure_density", 64), ("gap_edges", 65), ("gap_density", 64)] {
        assert_eq!((one(name).shape(), all(name).shape()), (&[bins][..], &[2, bins][..]), "{name}");
    }
    assert_eq!(one("gap_edges")[64], contacts[1].max_gap());
}
