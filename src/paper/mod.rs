//! `asperity paper`: the tables and figures of van Dokkum et al. (2018), made again.

mod bar;
mod beyond;
mod comparison;
mod fig1;
mod fig2;
mod fig3;
mod fig4;
mod fig5;
mod gw;
mod means;
mod options;
mod part;
mod printed;
#[cfg(feature = "record")]
mod recording;
mod rough;
mod smooth;
mod study;
mod table1;

use super::Outcome;
use anyhow::Result;
use asperity::files::write_csv;
use asperity::plot::{Figure, write_png, write_svg};
use asperity::study::Row;
use comparison::{Comparison, Finding};
use options::Options;
use part::Part;
use std::io::{Write, stdout};
use study::Study;

/// Makes the tables and figures of the paper again, and says for every number of it what is found here.
///
/// The paper: van Dokkum, Khajeh Salehani, Irani & Nicola, Tribol. Lett. 66:115 (2018). Each figure comes as a CSV of every
/// solved point, SVG, PNG and a recording; comparison.csv holds the final table. Started again after it was killed it goes
/// on where it was, and the CSV is the same to the last bit. With other Hurst exponents, seeds, loads and sizes the same
/// command makes a study of your own.
#[derive(clap::Args)]
pub struct Paper {
    /// What to make, in this order
    #[arg(value_enum, value_name = "PART", default_values_t = [Part::All])]
    parts: Vec<Part>,
    #[command(flatten)]
    options: Options,
}

/// What a part came to.
pub struct Made {
    /// The figure, if it is one.
    pub figure: Option<Figure>,
    /// The paper's numbers beside those found here.
    pub findings: Vec<Finding>,
}

impl Paper {
    /// Runs the command.
    pub fn run(&self) -> Result<Outcome> {
        let study = Study::new(&self.options)?;
        study.check_folder()?;
        let parts = Part::expand(&self.parts);
        parts.iter().try_for_each(|part| part.check(&study))?;
        study.prepare(&parts)?;
        let mut comparison = Comparison::default();
        for part in parts {
            let made = part.make(&study)?;
            if let Some(figure) = &made.figure {
                write_svg(&study.file(part.name(), "svg"), figure)?;
                write_png(&study.file(part.name(), "png"), figure)?;
                #[cfg(feature = "record")]
                if study.record {
                    recording::record(part, &study, figure)?;
                }
            }
            comparison.add(part.name(), made.findings)?;
            comparison.write_csv(&study.file("comparison", "csv"))?;
        }
        comparison.write_text(&mut stdout())?;
        writeln!(stdout(), "\nAll of it is in {}", self.options.out.display())?;
        let unconverged = study.unconverged();
        for Row { name, ny, nx, hurst, seed, reduced_pressure, certificate, .. } in &unconverged {
            let [hurst, seed] = [hurst.unwrap_or(f64::NAN), seed.map_or(f64::NAN, |seed| seed as f64)];
            let place = format!("{name}, {ny} x {nx} points, H {hurst}, seed {seed}, p* {reduced_pressure:.3e}");
            writeln!(stdout(), "not converged, left out of all averages: {place}: certificate {certificate:.1e}")?;
        }
        Ok(if unconverged.is_empty() { Outcome::Done } else { Outcome::NotConverged })
    }
}
