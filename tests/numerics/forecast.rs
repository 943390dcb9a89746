//! The guess of contact area and pressure before solving.

use asperity::contact::{ContactModulus, Forecast, Load};
use asperity::{Grid, Indenter, Problem};

#[test]
fn a_sphere_is_forecast_within_a_factor_of_two() {
    let (radius, length, contact) = (1.0_f64, 4.0, 0.3_f64);
    let sphere = Indenter::Sphere { radius }.surface(Grid::surface([256, 256], [length; 2]).unwrap()).unwrap();
    let load = 4.0 / 3.0 * contact.powi(3) / radius;
    let problem = Problem::new(sphere, ContactModulus(1.0), Load::MeanPressure(load / length.powi(2))).unwrap();
    let forecast = Forecast::new(&problem);
    let area = std::f64::consts::PI * contact.powi(2) / length.powi(2);
    let peak = 2.0 * contact / (std::f64::consts::PI * radius);
    assert!((0.5..2.0).contains(&(forecast.relative_area / area)), "{}", forecast.relative_area / area);
    assert!((0.5..5.0).contains(&(forecast.max_pressure / peak)), "{}", forecast.max_pressure / peak);
}
