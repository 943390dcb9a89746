//! Pressures computed by another code: Tamaas 2.9.0, Polonsky-Keer-Rey, to a tolerance of 1e-12, with the same kernel.
//!
//! The differences are printed with `cargo test --release --test numerics reference:: -- --nocapture`.

use crate::common::{relative_l2, solve, solvers};
use crate::peer::Peer;
use asperity::contact::{Contact, ContactModulus, Problem, Solver};

struct Case {
    peer: Peer,
    problem: Problem,
}

impl Case {
    fn new(peer: Peer) -> Self {
        let modulus = ContactModulus(peer.contact_modulus);
        Self { problem: Problem::new(peer.surface.clone(), modulus, peer.load()).unwrap(), peer }
    }

    fn assert_agrees(&self, solver: &dyn Solver, contact: &Contact) {
        let who = format!("{}, {}", self.peer.name, solver.settings());
        let error = relative_l2(&contact.pressure, &self.peer.pressure);
        println!("{error:.1e}  {who}");
        assert!(error < 1e-6, "{who}: pressures differ by {error}");
        let faint = 1e-9 * self.problem.expected_mean_pressure();
        let differ = |(a, b): (&f64, &f64)| (*a > 0.0) != (*b > 0.0) && a.max(*b) > faint;
        let differing = contact.pressure.iter().zip(&self.peer.pressure).filter(|&pair| differ(pair)).count();
        assert_eq!(differing, 0, "{who}: nodes in one contact only");
        assert_eq!(contact.counted().relative_area, self.peer.relative_area, "{who}");
        assert!((contact.mean_gap() / self.peer.mean_gap - 1.0).abs() < 1e-8, "{who}: mean gap");
    }
}

#[test]
fn every_solver_finds_the_pressures_of_the_reference() {
    for case in Peer::all().into_iter().map(Case::new) {
        for solver in solvers() {
            case.assert_agrees(solver.as_ref(), &solve(solver.as_ref(), &case.problem, 1e-12));
        }
    }
}
