//! Random slides, checked by sums that share no formula with the solver.

use asperity::contact::{ContactModulus, Load, MonotoneSets, Problem, Solver, Status, Stop};
use asperity::surface::Spectrum;
use asperity::{Grid, Surface};
use std::f64::consts::TAU;

/// Numbers between 0 and 1 (Knuth's generator).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A power of ten between two exponents.
    fn power(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(low + (high - low) * self.next())
    }
}

/// The displacement of a pressure that slides, by sums over all pairs of waves and nodes: each wave of pressure is marched through the
/// equation of the creep, `eps - V tau eps' = f p`, with cosines and sines.
fn displacement(shape: [usize; 2], pressure: &[f64], vt: f64, creep: f64) -> Vec<f64> {
    let [ny, nx] = shape;
    let n = (ny * nx) as f64;
    let mut u = vec![0.0; ny * nx];
    // one of each pair of opposite waves
    for ky in 0..ny {
        for kx in 0..nx {
            let signed = |k: usize, n: usize| if 2 * k > n { k as f64 - n as f64 } else { k as f64 };
            let [my, mx] = [signed(ky, ny), signed(kx, nx)];
            let is_nyquist = |m: f64, n: usize| 2.0 * m.abs() == n as f64;
            let is_own_mirror = (my == 0.0 || is_nyquist(my, ny)) && (mx == 0.0 || is_nyquist(mx, nx));
            let is_first = mx > 0.0 || mx == 0.0 && my > 0.0;
            if kx == 0 && ky == 0 || !(is_first || is_own_mirror) {
                continue;
            }
            // waves that are not their own mirror images stand for two, but along the Nyquist column both of them are met
            let [qy, qx] = [TAU * my, TAU * mx];
            let phase = |y: usize, x: usize| TAU * (my * y as f64 / ny as f64 + mx * x as f64 / nx as f64);
            let (mut cosine, mut sine) = (0.0, 0.0);
            for (i, p) in pressure.iter().enumerate() {
                let (s, c) = phase(i / nx, i % nx).sin_cos();
                cosine += p * c;
                sine += p * s;
            }
            let twice = if is_own_mirror || is_nyquist(mx, nx) { 1.0 } else { 2.0 };
            (cosine, sine) = (twice * cosine / n, twice * sine / n);
            // eps = a cos + b sin:  a - w b = f c,  b + w a = f s, with w = V tau q_x
            let w = if is_nyquist(mx, nx) { 0.0 } else { vt * qx };
            let (a, b) = if is_nyquist(mx, nx) {
                // the real part of the weight
                let real = creep / (1.0 + (vt * qx).powi(2));
                (real * cosine, real * sine)
            } else {
                let d = 1.0 + w * w;
                (creep * (cosine + w * sine) / d, creep * (sine - w * cosine) / d)
            };
            let compliance = 2.0 / qx.hypot(qy);
            for (i, u) in u.iter_mut().enumerate() {
                let (s, c) = phase(i / nx, i % nx).sin_cos();
                *u += compliance * ((cosine + a) * c + (sine + b) * s);
            }
        }
    }
    u
}

#[test]
fn sixty_random_slides_are_right() {
    let mut random = Random(20_260_711);
    for case in 0..60 {
        let is_line = case % 2 == 0;
        let grid = if is_line {
            Grid::line([128, 243, 512][case / 2 % 3], 1.0)
        } else {
            Grid::surface([[16, 16], [24, 32], [15, 20]][case / 2 % 3], [1.0, 1.0])
        };
        let grid = grid.unwrap();
        let spectrum = Spectrum {
            hurst: 0.2 + 0.7 * random.next(),
            rolloff_wavelength: 0.5,
            short_cutoff: if is_line { 0.04 } else { 0.2 },
            rms_gradient: 0.01,
        };
        let surface = Surface::rough(grid, &spectrum, case as u64).unwrap();
        let (creep, vt, load) = (random.power(-2.0, 4.0), random.power(-7.0, 5.0), random.power(-4.0, 0.0));
        let problem = Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(load)).unwrap();
        let problem = problem.sliding(vt, &[(creep, 1.0)]).unwrap();
        let stop = Stop::new(1e-8, 3000).unwrap();
        let contact = MonotoneSets.solve(&problem, &stop, &mut ()).unwrap();
        let what = format!("{case}: f {creep:.1e}, V tau {vt:.1e}, p* {load:.1e}");
        assert!(contact.status == Status::Converged && contact.work.transforms < 10_000, "{what}: {:?}", contact.work);
        let p = contact.pressure.as_slice().unwrap();
        let u = displacement(grid.shape(), p, vt, creep);
        let (n, height) = (p.len() as f64, problem.height());
        let load = p.iter().sum::<f64>();
        assert!(p.iter().all(|&p| p >= 0.0) && (load / n / problem.mean_pressure().unwrap() - 1.0).abs() < 1e-9);
        let gap: Vec<f64> = u.iter().zip(height).map(|(u, h)| u - h).collect();
        let lowest = gap.iter().copied().fold(f64::INFINITY, f64::min);
        let complementarity = p.iter().zip(&gap).map(|(p, gap)| p * (gap - lowest)).sum::<f64>() / load;
        let largest = u.iter().fold(problem.rms_height(), |most: f64, u| most.max(u.abs()));
        assert!(
            complementarity <= 1.1e-8 * problem.rms_height() + 1e-11 * largest,
            "{what}: {complementarity:e} of {:e}",
            problem.rms_height()
        );
    }
}
