//! Stress below a smooth and a rough contact under the same load: where it is largest, and recordings with photoelastic fringes.
//!
//! `cargo run --release --example stress_fringes`

use asperity::contact::{Contact, Load, Observer};
use asperity::error::{SolidError, SolveError};
use asperity::record::{Options, Recording, Scene};
use asperity::setup::{Body, Cell, Part, Recipe, Setup, Solid};
use asperity::surface::Spectrum;
use asperity::{Indenter, Problem};

/// Steel against a rigid surface: Young's modulus in pascals, Poisson's ratio.
const STEEL: Body = Body { young: 210e9, poisson: 0.3 };
const CELL: f64 = 160e-6;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let load = Load::MeanPressure(20e6);
    let cylinder = Indenter::Cylinder { radius: 100.0 * CELL };
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 40e-6, short_cutoff: 5e-6, rms_gradient: 1e-3 };
    let rough = Recipe { spectrum: Some(spectrum.into()), ..Recipe::indenter(cylinder) };
    let setups = [Recipe::indenter(cylinder), rough]
        .map(|surface| Setup::new(surface, Cell::line(4096, CELL), load).on(Solid::Bodies(STEEL, None)));
    let problems = [setups[0].problem()?, setups[1].problem()?];

    let names = ["smooth", "rough"];
    let scenes = [0, 1].map(|i| Scene { name: names[i].into(), ..Scene::from_setup(&setups[i], &problems[i]) });
    let what = [Part::Profile, Part::Fields, Part::Mask, Part::Stress, Part::Fringes].into_iter().collect();
    let path = std::env::temp_dir().join("stress_fringes.rrd");
    let options = Options { what, ..Options::default() };
    let recording = Recording::create(&path, &scenes, options)?;
    for i in [0, 1] {
        let contact = solve(&setups[i], &problems[i], &mut recording.recorder(i))?;
        print(names[i], &contact)?;
    }
    recording.finish()?;
    println!("rerun {}", path.display());
    Ok(())
}

fn solve(setup: &Setup, problem: &Problem, recorder: &mut dyn Observer) -> Result<Contact, SolveError> {
    setup.solver.solver().solve(problem, &setup.stop, recorder)?.converged()
}

/// Prints the largest shear stress at some depths.
fn print(name: &str, contact: &Contact) -> Result<(), SolidError> {
    println!("{name}: largest pressure {:.0} MPa", contact.max_pressure() / 1e6);
    println!("  depth [um]  tau_max [MPa]");
    let depth = [0.1e-6, 0.5e-6, 2e-6, 5e-6, 10e-6, 20e-6, 40e-6];
    let tau = contact.stress(contact.highest_row(), STEEL.poisson, &depth)?.tau_max();
    for (depth, row) in depth.iter().zip(tau.rows()) {
        let highest = row.iter().copied().fold(0.0, f64::max);
        println!("  {:>10.1}  {:>13.1}", depth * 1e6, highest / 1e6);
    }
    Ok(())
}
