//! Random roughness on the command line.

use super::*;

const SURFACE: &str = "--rolloff 0.125 --short-cutoff 0.03125 --hurst 0.8 --points 128,128 --size 1";

fn described(folder: &Folder, line: &str) -> serde_json::Value {
    let output = folder.run(&format!("surface {line} --json"));
    assert!(output.status.success(), "{}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn refused(folder: &Folder, line: &str) -> String {
    let output = folder.run(&format!("surface {line}"));
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    text(&output.stderr).to_owned()
}

#[test]
fn the_spectrum_of_a_surface_is_written_and_read_again_in_every_convention() {
    let folder = Folder::new();
    let whole = described(&folder, &format!("{SURFACE} --rms-gradient 0.1 --psd plain.csv"));
    let rms = whole["rms_height"].as_f64().unwrap();
    for convention in ["surface", "surface-two-pi", "profile", "profile-two-pi"] {
        described(
            &folder,
            &format!("{SURFACE} --rms-gradient 0.1 --psd {convention}.csv --psd-convention {convention}"),
        );
        let again = described(&folder, &format!("--spectrum {convention}.csv --points 128,128 --size 1"));
        let found = again["rms_height"].as_f64().unwrap();
        // another realisation of a spectrum in bands, of profiles by an integral over their slope
        assert!((found / rms - 1.0).abs() < 0.25, "{convention}: {found} against {rms}");
    }
    let plain = std::fs::read_to_string(folder.join("plain.csv")).unwrap();
    assert!(plain.starts_with("# convention: surface\nwavenumber,density\n"), "{plain}");
    assert_eq!(plain, std::fs::read_to_string(folder.join("surface.csv")).unwrap());
}

#[test]
fn lays_and_heights_are_described() {
    let folder = Folder::new();
    let found = described(&folder, &format!("{SURFACE} --rms-height 1e-3 --peklenik 3 --lay-angle 0 --weibull 2"));
    let of = |key: &str| found[key].as_f64().unwrap();
    assert!((of("rms_height") / 1e-3 - 1.0).abs() < 1e-9);
    assert!((of("peklenik") / 3.0 - 1.0).abs() < 0.4, "{}", of("peklenik"));
    // Weibull's distribution of shape 2 is Rayleigh's, of skewness 0.631
    assert!((of("skewness") - 0.631).abs() < 0.01);
    assert_eq!(found["rank_map"]["height_error"], 0.0);
    let rows = folder.run(&format!("surface {SURFACE} --rms-gradient 0.1 --skewness=-1 --kurtosis 4 --exact spectrum"));
    let said = text(&rows.stdout);
    assert!(said.contains("distribution") && said.contains("spectrum exact, heights within"), "{said}");
    assert!(said.contains("heights of skewness -1 and kurtosis 4"), "{said}");
}

#[test]
fn what_does_not_go_together_is_refused_in_one_sentence() {
    let folder = Folder::new();
    std::fs::write(folder.join("psd.csv"), "50 1\n200 0.1\n").unwrap();
    for (line, said) in [
        (
            SURFACE.to_owned(),
            "give the scale of the roughness: `rms-gradient` or `rms-height` (--rms-gradient or --rms-height)",
        ),
        (format!("{SURFACE} --rms-gradient 0.1 --rms-height 1"), "give one of them"),
        (format!("{SURFACE} --rms-gradient 0.1 --skewness 1"), "a skewness needs a kurtosis"),
        (format!("{SURFACE} --rms-gradient 0.1 --skewness 1 --kurtosis 1.5"), "which is 2.0"),
        (format!("{SURFACE} --rms-gradient 0.1 --weibull 1 --beta 2,5"), "several distributions"),
        (format!("{SURFACE} --rms-gradient 0.1 --exact spectrum"), "leave out `exact`"),
        (format!("{SURFACE} --rms-gradient 0.1 --lay-angle 3"), "without a Peklenik number"),
        (format!("{SURFACE} --rms-gradient 0.1 --rolloff-form none"), "the roll-off form is none"),
        (format!("{SURFACE} --rms-gradient 0.1 --spectrum psd.csv"), "both a table and a Hurst exponent"),
        ("--spectrum none.csv --points 64,64 --size 1".into(), "cannot read none.csv"),
        ("--spectrum psd.csv --points 16,16 --size 1".into(), "too short for the grid"),
    ] {
        let refusal = refused(&folder, &line);
        assert!(refusal.contains(said), "{line}: {refusal}");
        assert_eq!(refusal.trim().lines().count(), 1, "{refusal}");
    }
}

#[test]
fn two_processes_make_a_honed_plateau() {
    let folder = Folder::new();
    let scene = "\
[surface]
seed = 3
joined = \"lower\"

[surface.spectrum]
hurst = 0.8
rolloff-wavelength = 0.125
short-cutoff = 0.03125
rms-height = 1e-4

[surface.second-spectrum]
hurst = 0.8
rolloff-wavelength = 0.25
short-cutoff = 0.03125
rms-height = 1e-3
peklenik = 4

[grid]
points = [256, 256]
size = 1
";
    std::fs::write(folder.join("honed.toml"), scene).unwrap();
    let lower = described(&folder, "honed.toml");
    std::fs::write(folder.join("sum.toml"), scene.replace("joined = \"lower\"\n", "")).unwrap();
    let sum = described(&folder, "sum.toml");
    let skewness = |of: &serde_json::Value| of["skewness"].as_f64().unwrap();
    assert!(skewness(&lower) < -1.0 && skewness(&sum).abs() < 0.5, "{} and {}", skewness(&lower), skewness(&sum));
    // both processes are independent, so that the squares of their heights add up
    let square = sum["rms_height"].as_f64().unwrap().powi(2);
    assert!((square / 1.01e-6 - 1.0).abs() < 0.05, "{square}");
    std::fs::write(folder.join("alone.toml"), scene.replace("[surface.second", "[surface.third")).unwrap();
    assert!(refused(&folder, "alone.toml").contains("third-spectrum"));
}
