//! What is recorded of a surface without a contact.

use super::*;
use asperity::formats::Scan;
use asperity::record::record_survey;
use asperity::surface::Survey;

#[test]
fn a_surface_is_a_relief_and_a_line_is_a_curve_beside_their_spectra() {
    let folder = tempfile::tempdir().unwrap();
    let spectrum = Spectrum { hurst: 0.7, rolloff_wavelength: 0.25, short_cutoff: 0.05, rms_gradient: 0.1 };
    let grids = [Grid::line(256, 1.0).unwrap(), Grid::surface([48, 64], [1.0, 1.0]).unwrap()];
    for (grid, panels) in
        grids.into_iter().zip([["/figure/0", "/figure/1", "/figure/2"], ["/figure/0", "/figure/1", "/surface/relief"]])
    {
        let surface = Surface::rough(grid, &spectrum, 1).unwrap();
        let survey = Survey::new(&Scan::from_surface(&surface, 1)).unwrap();
        let path = folder.path().join(format!("{}.rrd", panels[2].len()));
        record_survey(&path, "heights", &surface, &survey, "m", "words").unwrap();
        let (entities, shown) = (entities(&path), shown_paths(&path));
        for panel in panels {
            assert!(shown.contains(&format!("{panel}/**")), "{panel} is not shown: {shown:?}");
            assert!(entities.iter().any(|it| it.starts_with(&format!("{panel}/"))), "{panel}: {entities:?}");
        }
        assert!(entities.contains("/description"));
        assert_eq!(entities.contains("/surface/relief/solid"), !grid.is_line());
    }
    let surface = Surface::rough(grids[1], &spectrum, 1).unwrap();
    let survey = Survey::new(&Scan::from_surface(&surface, 1)).unwrap();
    let nowhere = folder.path().join("none").join("h.rrd");
    assert!(matches!(record_survey(&nowhere, "", &surface, &survey, "", ""), Err(FileError::Target { .. })));
}
