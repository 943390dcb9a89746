//! The bare algorithm of Polonsky & Keer (1999) on the library's elastic half-space, without any of its bookkeeping.
//!
//! `cargo run --release --example minimal_polonsky_keer`

use asperity::elastic::HalfSpace;
use asperity::{Grid, Indenter};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (n, contact_modulus, mean_pressure) = (512, 1.0, 0.05);
    let grid = Grid::line(n, 1.0)?;
    let surface = Indenter::Sine { amplitude: 0.05 }.surface(grid)?;
    let h = surface.heights();
    let mut half_space = HalfSpace::new(&grid, contact_modulus);
    let (mut p, mut t) = (vec![mean_pressure; n], vec![0.0; n]);
    let (mut u, mut r) = (vec![0.0; n], vec![0.0; n]);
    let (mut old_square, mut delta) = (1.0, 0.0);
    for iteration in 0.. {
        // gap, less its mean over the contact
        half_space.displacement(&p, &mut u);
        let contact: Vec<usize> = (0..n).filter(|&i| p[i] > 0.0).collect();
        let mean = |f: &dyn Fn(usize) -> f64| contact.iter().map(|&i| f(i)).sum::<f64>() / contact.len() as f64;
        let datum = mean(&|i| u[i] - h[i]);
        let g: Vec<f64> = (0..n).map(|i| u[i] - h[i] - datum).collect();
        // conjugate direction and exact step
        let square: f64 = contact.iter().map(|&i| g[i] * g[i]).sum();
        for i in 0..n {
            t[i] = if p[i] > 0.0 { g[i] + delta * square / old_square * t[i] } else { 0.0 };
        }
        half_space.displacement(&t, &mut r);
        let mean_r = mean(&|i| r[i]);
        let sum = |f: &dyn Fn(usize) -> f64| contact.iter().map(|&i| f(i)).sum::<f64>();
        let tau = sum(&|i| g[i] * t[i]) / sum(&|i| (r[i] - mean_r) * t[i]);
        // step, clip tension, admit penetrating nodes, restore the load
        let before = p.clone();
        delta = 1.0;
        for i in 0..n {
            p[i] = if p[i] > 0.0 { (p[i] - tau * t[i]).max(0.0) } else { 0.0 };
            if p[i] == 0.0 && g[i] < 0.0 {
                (p[i], delta) = (-tau * g[i], 0.0);
            }
        }
        let load: f64 = p.iter().sum::<f64>() / n as f64;
        p.iter_mut().for_each(|p| *p *= mean_pressure / load);
        old_square = square;
        let change: f64 = p.iter().zip(&before).map(|(a, b)| (a - b).abs()).sum::<f64>() / n as f64;
        if change < 1e-10 * mean_pressure {
            let share = contact.len() as f64 / n as f64;
            let exact = 2.0 / std::f64::consts::PI * (mean_pressure / (std::f64::consts::PI * 0.05)).sqrt().asin();
            println!("{iteration} iterations: relative area {share:.4}, exact {exact:.4}");
            return Ok(());
        }
    }
    Ok(())
}
