//! What is counted on a contact.

use asperity::contact::{ContactModulus, Counted, Load};
use asperity::{Grid, Indenter, Problem};

fn switches(pressure: &[f64], grid: Grid) -> usize {
    let sine = Indenter::Sine { amplitude: 1.0 };
    let crossed = Indenter::CrossedSine { amplitude: 1.0 };
    let surface = if grid.is_line() { sine } else { crossed }.surface(grid).unwrap();
    Counted::new(&Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(1.0)).unwrap(), pressure).switches
}

#[test]
fn switches_count_the_contact_line_across_the_period() {
    let line = Grid::line(4, 1.0).unwrap();
    assert_eq!(switches(&[1.0, 1.0, 0.0, 1.0], line), 2);
    assert_eq!(switches(&[1.0; 4], line), 0);
    let mut block = [0.0; 16];
    for i in [0, 3, 12, 15] {
        block[i] = 1.0; // a 2 x 2 patch around the corner
    }
    assert_eq!(switches(&block, Grid::surface([4, 4], [1.0, 1.0]).unwrap()), 8);
}
