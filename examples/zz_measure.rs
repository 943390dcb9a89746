use asperity::contact::*;
use asperity::surface::Spectrum;
use asperity::{Grid, Indenter, Problem, Stop, Surface};
fn main() {
    // visc cylindr
    let n = 8192;
    let cyl = Indenter::Cylinder { radius: 50.0 }.surface(Grid::line(n, 400.0).unwrap()).unwrap();
    for tau in [0.0, 0.009, 0.045, 2.0] {
        let p = Problem::new(cyl.clone(), ContactModulus(1905.0), Load::MeanPressure(1.5)).unwrap().sliding(1000.0, &[(1.0, tau)]).unwrap();
        let mut count = 0;
        let c = MonotoneSets.solve(&p, &Stop::new(1e-10, 10000).unwrap(), &mut Each(|_: &Step<'_>| { count += 1; std::ops::ControlFlow::Continue(()) })).unwrap();
        let xs: Vec<f64> = c.pressure.iter().enumerate().filter(|(_, p)| **p > 0.0).map(|(i, _)| (i as f64 - 4096.0) * 400.0 / 8192.0).collect();
        println!("tau {tau}: pmax {:.3} [{:.2},{:.2}] {:?} {:?} eta {:e} steps {count}", c.max_pressure(), xs[0], xs[xs.len()-1], c.status, c.work, c.certificate.eta);
    }
    let args: Vec<String> = std::env::args().collect();
    let lines = [(0.2, 0.01), (0.2, 0.1), (0.8, 0.01), (0.8, 0.1), (0.8, 0.5)];
    for surface in [false, true] {
        for (hurst, pr) in lines {
            let spectrum = Spectrum { hurst, rolloff_wavelength: 0.25, short_cutoff: if surface { 0.03 } else { 0.004 }, rms_gradient: 1e-2 };
            let grid = if surface { Grid::surface([256, 256], [1.0, 1.0]) } else { Grid::line(1 << 14, 1.0) }.unwrap();
            let s = Surface::rough(grid, &spectrum, 1).unwrap();
            for f in [1.0, 9.0, 1e3] {
                for vt in [1e-4, 1e-2, 1.0, 100.0] {
                    let rest = Problem::new(s.clone(), ContactModulus(1.0), Load::ReducedPressure(pr)).unwrap();
                    let p = rest.sliding(vt, &[(f, 1.0)]).unwrap();
                    let c = MonotoneSets.solve(&p, &Stop::new(1e-8, if args.len() > 1 {30} else {300}).unwrap(), &mut ()).unwrap();
                    println!("surf {surface} H {hurst} p* {pr} f {f} vt {vt}: {:?} it {} tr {} {:.2}s eta {:.1e} area {:.4}", c.status, c.work.iterations, c.work.transforms, c.work.seconds, c.certificate.eta, c.counted().relative_area);
                }
            }
        }
    }
}
