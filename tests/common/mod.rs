//! What the physics tests share.

use asperity::contact::{Contact, Dynamics, Gfmd, Masses, Multilevel, PolonskyKeer, Problem, Solver, Stop};

/// Solves to a certificate of `tolerance`.
pub fn solve(solver: &dyn Solver, problem: &Problem, tolerance: f64) -> Contact {
    let stop = Stop::new(tolerance, 200_000).unwrap();
    let contact = solver.solve(problem, &stop, &mut ()).and_then(Contact::converged);
    contact.unwrap_or_else(|error| panic!("{}: {error}", solver.settings()))
}

/// Every solver, with every kind of masses and dynamics.
pub fn solvers() -> Vec<Box<dyn Solver>> {
    let gfmd = |masses, dynamics| Box::new(Gfmd { masses, dynamics, ..Gfmd::default() }) as Box<dyn Solver>;
    vec![
        Box::new(PolonskyKeer),
        Box::new(Multilevel),
        gfmd(Masses::Uniform, Dynamics::Damped),
        gfmd(Masses::Uniform, Dynamics::Fire),
        gfmd(Masses::Stiffness, Dynamics::Damped),
        gfmd(Masses::Stiffness, Dynamics::Fire),
    ]
}

/// Relative difference in the L2 norm.
pub fn relative_l2<'a>(found: impl IntoIterator<Item = &'a f64>, expected: impl IntoIterator<Item = &'a f64>) -> f64 {
    let (mut difference, mut norm) = (0.0, 0.0);
    for (a, b) in found.into_iter().zip(expected) {
        difference += (a - b).powi(2);
        norm += b.powi(2);
    }
    (difference / norm).sqrt()
}
