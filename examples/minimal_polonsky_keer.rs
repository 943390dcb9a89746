//! A solver of one's own: Polonsky & Keer (1999) in a few lines, watched, certified and recorded like those of the crate.
//!
//! `cargo run --release --example minimal_polonsky_keer`, then `cargo run --release -- view minimal.rrd`

use asperity::contact::{Certificate, Contact, ContactModulus, Load, Observer, Run, Solver, Step};
use asperity::record::{Options, Recording, Scene};
use asperity::{Grid, Indenter, Problem, Stop, error::SolveError, surface::Field};
use std::path::Path;

struct MinimalPolonskyKeer;

impl Solver for MinimalPolonskyKeer {
    fn name(&self) -> &str {
        "minimal-polonsky-keer"
    }

    fn settings(&self) -> String {
        "conjugate gradients on the contact".into()
    }

    fn solve_from(
        &self,
        start: Option<&Field>,
        problem: &Problem,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<Contact, SolveError> {
        let load = problem.mean_pressure().ok_or(SolveError::NeedsPressure { solver: self.name().into() })?;
        let (n, h) = (problem.nodes(), problem.height());
        let mut run = Run::begin(self, problem, stop, observer);
        let mut half_space = problem.response();
        let (mut p, mut u, mut t, mut r) = (problem.first_pressure(start), vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        let (mut old_square, mut delta) = (1.0, 0.0);
        let status = loop {
            half_space.displacement(&p, &mut u);
            let certificate = Certificate::from_displacement(problem, &p, &u);
            run.offer(&certificate, &p);
            let work = run.work(half_space.transforms());
            if let Some(status) = run.show(&Step::new(problem, work, &p, &u).with_certificate(certificate)) {
                break status;
            }
            // the gap, less its mean over the contact, is the gradient
            let contact: Vec<usize> = (0..n).filter(|&i| p[i] > 0.0).collect();
            let sum = |f: &dyn Fn(usize) -> f64| contact.iter().map(|&i| f(i)).sum::<f64>();
            let datum = sum(&|i| u[i] - h[i]) / contact.len() as f64;
            let g: Vec<f64> = (0..n).map(|i| u[i] - h[i] - datum).collect();
            // conjugate direction and exact step
            let square = sum(&|i| g[i] * g[i]);
            for i in 0..n {
                t[i] = if p[i] > 0.0 { g[i] + delta * square / old_square * t[i] } else { 0.0 };
            }
            half_space.displacement(&t, &mut r);
            let mean_r = sum(&|i| r[i]) / contact.len() as f64;
            let tau = sum(&|i| g[i] * t[i]) / sum(&|i| (r[i] - mean_r) * t[i]);
            // step, clip tension, admit nodes that penetrate, restore the load
            (old_square, delta) = (square, 1.0);
            for i in 0..n {
                p[i] = (p[i] - tau * t[i]).max(0.0);
                if p[i] == 0.0 && g[i] < 0.0 {
                    (p[i], delta) = (-tau * g[i], 0.0);
                }
            }
            let mean = p.iter().sum::<f64>() / n as f64;
            p.iter_mut().for_each(|p| *p *= load / mean);
            run.advance();
        };
        Ok(run.finish(status, half_space))
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let sine = Indenter::Sine { amplitude: 0.05 }.surface(Grid::line(512, 1.0)?)?;
    let problem = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(0.05))?;
    let recording = Recording::create(Path::new("minimal.rrd"), &[Scene::new("sine", &problem)], Options::default())?;
    let contact = MinimalPolonskyKeer.solve(&problem, &Stop::default(), &mut recording.recorder(0))?.converged()?;
    recording.finish()?;
    println!("{} steps, certificate {:.1e}, in minimal.rrd", contact.work.iterations, contact.certificate.eta);
    Ok(())
}
