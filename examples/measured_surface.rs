//! From a measured file to a contact: look at the heights, have the steps chosen that they need, press them.
//!
//! cargo run --release --example measured_surface -- patch.x3p
//!
//! Without a file a text of heights is made first, as an instrument may write it: tilted, in micrometres, with a void.

use asperity::contact::Load;
use asperity::formats::{HeightFile, Scan};
use asperity::setup::{Cell, Recipe, Setup};
use asperity::surface::{Spectrum, Survey};
use asperity::{Grid, Surface};
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = match std::env::args_os().nth(1) {
        Some(path) => HeightFile::from(PathBuf::from(path)),
        None => HeightFile::in_memory("patch.txt", measured()?.into_bytes()),
    };
    let recipe = Recipe { height: Some(file.clone()), ..Recipe::default() };
    let cell = Cell::file();
    let choice = recipe.choice(&cell)?;
    choice.reasons.iter().for_each(|reason| println!("{reason}"));

    let recipe = Recipe { prepare: choice.preparation, ..recipe };
    let prepared = recipe.prepared(&file, &recipe.grid(&cell)?)?;
    prepared.effects.iter().for_each(|step| println!("{step}"));
    let survey = Survey::new(&prepared.scan)?;
    for axis in &survey.axes {
        let (noise, share) = (axis.noise, 100.0 * axis.noise_share);
        println!("noise along {}: {noise:.2e} rms, {share:.0} % of the mean square gradient", axis.axis);
    }
    if let Some(law) = survey.power_law {
        println!("power spectrum: H = {:.2}", law.hurst);
    }

    let setup = Setup::new(recipe, cell, Load::ReducedPressure(0.01));
    let contact = setup.solver.solver().solve(&setup.problem()?, &setup.stop, &mut ())?.converged()?;
    let resolved = contact.resolved();
    println!("area {:.4}, kappa_r {:.3}", resolved.relative_area, resolved.kappa_r);
    Ok(())
}

/// A part of a rough surface as a text.
fn measured() -> Result<String, Box<dyn std::error::Error>> {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 64.0, short_cutoff: 8.0, rms_gradient: 0.1 };
    let whole =
        Scan::from_surface(&Surface::rough(Grid::surface([256, 256], [256.0, 256.0])?, &spectrum, 1)?, 1).height;
    let height = |y: usize, x: usize| match (y, x) {
        (30, 40) => "NaN".to_owned(),
        _ => format!("{:.4}", whole[[y, x]] + 0.02 * x as f64),
    };
    let rows: Vec<String> = (0..128).map(|y| (0..160).map(|x| height(y, x)).collect::<Vec<_>>().join("\t")).collect();
    Ok(format!("# Channel: Topography\n# Width: 160 µm\n# Height: 128 µm\n# Value units: µm\n{}\n", rows.join("\n")))
}
