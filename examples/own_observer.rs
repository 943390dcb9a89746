//! An observer of your own: it watches the relaxation and ends it once the contact area has settled.
//!
//! `cargo run --release --example own_observer`

use asperity::contact::{ContactModulus, Gfmd, Load, Observer, Solver, Step, Wish};
use asperity::{Grid, Indenter, Problem, Stop};
use std::ops::ControlFlow;

/// Ends a run when the number of nodes in contact has stayed the same for `patience` steps.
struct SettledArea {
    patience: usize,
    nodes: usize,
    since: usize,
}

impl Observer for SettledArea {
    fn step(&mut self, step: &Step<'_>) -> Wish {
        // statistics are computed here, because they are asked for, and only once per step
        let nodes = step.counted().contact_nodes;
        if nodes != self.nodes {
            (self.nodes, self.since) = (nodes, step.index());
        }
        if step.index().is_multiple_of(100) {
            println!("step {:>4}: {nodes:>3} nodes in contact, mean gap {:.6}", step.index(), step.mean_gap());
        }
        let settled = nodes > 0 && step.index() - self.since >= self.patience;
        Ok(if settled { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(1024, 1.0)?)?;
    let problem = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(0.01))?;
    let mut observer = SettledArea { patience: 100, nodes: 0, since: 0 };
    let contact = Gfmd::default().solve(&problem, &Stop::default(), &mut observer)?;
    println!("{} after {} steps: {:?}", contact.status, contact.work.iterations, contact.certificate);
    Ok(())
}
