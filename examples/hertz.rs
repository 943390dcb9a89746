//! A cylinder on an elastic solid, held against the closed form: where the error of a contact comes from.
//!
//! `cargo run --release --example hertz`

use asperity::contact::{ContactModulus, Load, PolonskyKeer, Solver};
use asperity::theory::{Exact, hertz};
use asperity::{Grid, Indenter, Problem, Stop};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (radius, contact_modulus, mean_pressure) = (1.0, 1.0, 8e-3);
    let cylinder = Indenter::Cylinder { radius };
    println!("kappa_r of a lone cylinder: {:.5}", hertz::KAPPA_R_LINE);
    println!("points  area       kappa_r    counted    mean gap");
    for points in [256, 1024, 4096, 16384] {
        let grid = Grid::line(points, 4.0 * radius)?;
        let problem =
            Problem::new(cylinder.surface(grid)?, ContactModulus(contact_modulus), Load::MeanPressure(mean_pressure))?;
        let contact = PolonskyKeer.solve(&problem, &Stop::default(), &mut ())?.converged()?;
        let resolved = contact.resolved();
        println!(
            "{points:>6}  {:.6}  {:.6}  {:.6}  {:.7}",
            resolved.relative_area,
            resolved.kappa_r,
            contact.counted().kappa_r,
            contact.mean_gap()
        );
    }
    // the solver is periodic: so is this solution, whose contact is a little smaller than that of the lone cylinder
    let grid = Grid::line(16384, 4.0 * radius)?;
    if let Some(exact) = Exact::new(&cylinder, &grid, contact_modulus, mean_pressure) {
        let (kappa_r, gap) = (exact.kappa_r.unwrap_or(f64::NAN), exact.mean_gap.unwrap_or(f64::NAN));
        println!(" exact  {:.6}  {kappa_r:.6}            {gap:.7}", exact.relative_area);
    }
    Ok(())
}
