//! Constrained conjugate gradients where nodes enter and leave in turns.

use asperity::contact::{ContactModulus, Each, Load, PolonskyKeer, Solver, Step};
use asperity::surface::Field;
use asperity::{Grid, Problem, Stop, Surface};
use std::ops::ControlFlow;

/// A block of nodes over flat ground.
fn block(shape: [usize; 2], width: usize) -> Surface {
    let height = Field::from_shape_fn(shape, |(y, x)| if y < width && x < width { 1.0 } else { 0.0 });
    Surface::new(Grid::surface(shape, [1.0, 1.0]).unwrap(), height).unwrap()
}

fn pressed(surface: Surface, reduced_pressure: f64) -> Problem {
    Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(reduced_pressure)).unwrap()
}

#[test]
fn blocks_over_flat_ground_do_not_trap_it() {
    for (shape, width) in [([51, 28], 1), ([51, 28], 2), ([64, 64], 1), ([64, 64], 2), ([7, 90], 1)] {
        for reduced_pressure in [8e-3, 9e-3, 1e-2, 1.2e-2, 1.5e-2, 2e-2, 5e-2] {
            let problem = pressed(block(shape, width), reduced_pressure);
            let contact = PolonskyKeer.solve(&problem, &Stop::default(), &mut ()).unwrap().converged();
            assert!(contact.is_ok(), "{shape:?} {width} {reduced_pressure}: {}", contact.unwrap_err());
        }
    }
}

#[test]
fn the_energy_does_not_rise_when_the_contact_changes() {
    let problem = pressed(block([51, 28], 1), 2e-2);
    let (mut before, mut energy, mut changes) = (Vec::new(), 0.0, 0);
    let mut watch = Each(|step: &Step<'_>| {
        let now = step.energy().value();
        let contact: Vec<bool> = step.pressure().iter().map(|&p| p > 0.0).collect();
        if step.index() > 0 && contact != before {
            assert!(now <= energy + 1e-12, "{energy} to {now} at {}", step.index());
            changes += 1;
        }
        (before, energy) = (contact, now);
        ControlFlow::Continue(())
    });
    PolonskyKeer.solve(&problem, &Stop::default(), &mut watch).unwrap();
    assert!(changes > 3);
}
