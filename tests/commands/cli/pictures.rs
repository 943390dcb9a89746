//! Pictures of contacts and of load curves, and the units in summaries.

use super::*;

/// Distances of the lines of a drawing that have a colour.
fn lines(svg: &str) -> usize {
    svg.matches("<polyline").count() + svg.matches("<path").count()
}

#[test]
fn contacts_and_load_curves_are_drawn() {
    let folder = Folder::new();
    let runs = [
        (format!("{ROUGH_LINE} --modulus 2GPa --pressure 10MPa"), "elastic solid"),
        (format!("{ROUGH_SURFACE} --reduced-pressure 0.05"), "pressure"),
        (format!("{ROUGH_LINE} --reduced-pressure 1e-3..1e-1:5"), "area per load"),
    ];
    for (run, words) in runs {
        let output = folder.run(&format!("solve {run} --out contact.svg"));
        assert!(output.status.success(), "{}", text(&output.stderr));
        assert!(text(&output.stderr).contains("wrote contact.svg: a picture"), "{}", text(&output.stderr));
        let svg = std::fs::read_to_string(folder.join("contact.svg")).unwrap();
        assert!(svg.starts_with("<svg") || svg.contains("<svg"), "{run}");
        assert!(svg.contains(words) || lines(&svg) > 10, "{run}");
        let output = folder.run(&format!("solve {run} --out contact.png"));
        assert!(output.status.success(), "{}", text(&output.stderr));
        assert!(std::fs::read(folder.join("contact.png")).unwrap().starts_with(b"\x89PNG"));
    }
}

/// The options of a figure are the same for all pictures, and are refused where there is none.
#[test]
fn figures_have_their_size_on_paper() {
    let folder = Folder::new();
    let line = format!("{ROUGH_LINE} --modulus 2GPa --pressure 10MPa");
    let style = "--figure-size 85mm --figure-font 8pt --figure-title Figure --figure-x 0,0.5 --figure-legend none";
    std::fs::write(folder.join("study.toml"), STUDY).unwrap();
    for (run, file) in [
        (format!("solve {line} --out a.svg"), "a.svg"),
        (format!("solve {ROUGH_LINE} --reduced-pressure 1e-2,1e-1 --out b.svg"), "b.svg"),
        (format!("surface {ROUGH_LINE} --out c.svg"), "c.svg"),
        ("study study.toml --out d.csv".to_owned(), "d.svg"),
    ] {
        let output = folder.run(&format!("{run} {style}"));
        assert!(output.status.success(), "{run}: {}", text(&output.stderr));
        let svg = std::fs::read_to_string(folder.join(file)).unwrap();
        assert!(
            svg.contains("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"85.") || svg.contains(" width=\"84.9"),
            "{run}"
        );
        assert!(svg.contains(">Figure</text>"), "{run}");
    }
    let surface = std::fs::read_to_string(folder.join("c.svg")).unwrap();
    for words in [">distribution of the heights</text>", ">material ratio / %</text>"] {
        assert!(surface.contains(words), "{words}");
    }
    let output = folder.run(&format!("solve {line} --out a.pdf {style}"));
    assert!(output.status.success() && std::fs::read(folder.join("a.pdf")).unwrap().starts_with(b"%PDF-"));
    for (flags, words) in [
        ("--figure-size 85mm", "the flags --figure-... are for a picture, but none is written"),
        ("--figure-size 85 --out a.svg", "`85` is not a length: give one such as 85mm"),
        ("--figure-size 85m --out a.svg", "a length of 85 m makes no figure: give one from 0.02 to 2 m"),
        ("--figure-size wide --out a.svg", "`wide` is not a length: give one such as 85mm"),
        ("--figure-x 1 --out a.svg", "`1` is not a pair of limits"),
        ("--figure-y 2,1 --out a.svg", "an axis from 2 to 1 has no length"),
        ("--figure-dpi 1e9 --out a.png", "a resolution of 1000000000 dpi makes no figure"),
        ("--figure-colours bluish --out a.svg", "`bluish` is no colour: give blue, vermilion"),
        ("--figure-legend left --out a.svg", "`left` is no place of a legend"),
    ] {
        let output = folder.run(&format!("solve {line} {flags}"));
        assert_eq!(output.status.code(), Some(2), "{flags}");
        assert!(text(&output.stderr).contains(words), "{flags}: {}", text(&output.stderr));
    }
}

/// A small study under mean pressures with units: each curve has a marker of its own, and the load is the one that was prescribed.
const STUDY: &str = "surface = { spectrum = { hurst = [0.3, 0.8], rolloff-wavelength = 0.25, short-cutoff = 0.05, rms-gradient = 0.1 }, seed = \"1-2\" }
grid = { points = 512, size = 1.0 }
solid = { contact-modulus = \"1 GPa\" }
load = { mean-pressure = [\"1 MPa\", \"5 MPa\"] }
";

#[test]
fn figures_of_studies_have_all_bars_within_their_frames() {
    let folder = Folder::new();
    std::fs::write(folder.join("study.toml"), STUDY).unwrap();
    assert!(folder.run("study study.toml").status.success());
    let svg = std::fs::read_to_string(folder.join("study.svg")).unwrap();
    for words in [">mean pressure / MPa</text>", ">aᵣₑₗ</text>", ">κᵣ</text>", ">hurst 0.3</text>"] {
        assert!(svg.contains(words), "{words}: {svg}");
    }
    // a bar that is cut has one cap; caps are 8 units wide
    let ends: Vec<Vec<f64>> = svg
        .lines()
        .filter(|line| line.contains("stroke-width=\"1.4\""))
        .map(|line| line.split('"').nth(1).unwrap().split([' ', ',']).map(|it| it.parse().unwrap()).collect())
        .collect();
    let (caps, bars): (Vec<_>, Vec<_>) = ends.into_iter().partition(|it| it[1] == it[3]);
    assert!(bars.len() >= 6 && caps.len() == 2 * bars.len(), "{} {}", bars.len(), caps.len());
}

/// Results and tables of several runs are one picture, with a curve and a marker for each.
#[test]
fn several_results_are_drawn_together() {
    let folder = Folder::new();
    for (file, run) in [
        ("line.csv", format!("solve {ROUGH_LINE} --reduced-pressure 1e-2,3e-2,1e-1 --out line.csv")),
        ("surface.npz", format!("solve {ROUGH_SURFACE} --reduced-pressure 2e-2,1e-1 --out surface.npz")),
    ] {
        assert!(folder.run(&run).status.success(), "{file}");
    }
    std::fs::write(folder.join("study.toml"), STUDY).unwrap();
    assert!(folder.run("study study.toml").status.success());
    let output =
        folder.run("plot line.csv surface.npz study.csv --x p* --y relative_area --out all.svg --figure-size 85mm");
    assert!(output.status.success(), "{}", text(&output.stderr));
    let svg = std::fs::read_to_string(folder.join("all.svg")).unwrap();
    for words in
        [">line</text>", ">surface</text>", ">study, hurst 0.3</text>", ">study, hurst 0.8</text>", ", p*</text>"]
    {
        assert!(svg.contains(words), "{words}: {svg}");
    }
    // three dots of the line, two of the surface, two loads of the study for each exponent, and one of each in the legend
    let filled = |svg: &str, colour: &str| svg.matches(&format!("fill=\"{colour}\" fill-opacity=\"1\"")).count();
    let all = ["#0072b2", "#d55e00", "#009e73", "#cc79a7"];
    assert_eq!(all.map(|colour| filled(&svg, colour)), [4, 3, 3, 3]);
    let coloured = "plot line.csv surface.npz --y relative_area --out own.svg --figure-colours black,#ff0080";
    assert!(folder.run(coloured).status.success());
    let own = std::fs::read_to_string(folder.join("own.svg")).unwrap();
    assert_eq!(["#000000", "#ff0080", "#0072b2"].map(|colour| filled(&own, colour)), [4, 3, 0]);
    // the bars of a study are those of its own figure: the standard deviation over the seeds plus the error of the grid
    assert!(folder.run("plot study.csv --x mean_pressure --out bars.svg").status.success());
    let bars = std::fs::read_to_string(folder.join("bars.svg")).unwrap();
    let of_study = std::fs::read_to_string(folder.join("study.svg")).unwrap();
    let [bars, of_study] = [bars, of_study].map(|svg| svg.matches("stroke-width=\"1.4\"").count());
    // the figure of the study has the area as well
    assert_eq!(2 * bars, of_study);
    for (line, words) in [
        ("plot line.csv --y nonsense --out a.svg", "there is no quantity `nonsense`"),
        ("plot line.csv --y time --out a.svg", "line.csv is not a valid result or table file: it has no time"),
        ("plot nowhere.csv --out a.svg", "cannot read nowhere.csv"),
        ("plot line.csv --out line.csv", "give a name that ends in .svg or .pdf or .png"),
        ("plot study.toml --out a.svg", "study.toml is not a valid"),
    ] {
        let output = folder.run(line);
        assert_eq!(output.status.code(), Some(2), "{line}");
        assert!(text(&output.stderr).contains(words), "{line}: {}", text(&output.stderr));
    }
}

/// The value of a row of a summary.
fn row<'a>(output: &'a Output, name: &str) -> Option<&'a str> {
    text(&output.stdout).lines().find_map(|line| line.trim().strip_prefix(name)).map(str::trim)
}

#[test]
fn summaries_have_units_where_the_setup_has_them() {
    let folder = Folder::new();
    let cylinder = "solve --indenter cylinder --radius 100um --points 4096 --size 160um --young 210GPa --poisson 0.3";
    let output = folder.run(&format!("{cylinder} --pressure 10MPa"));
    // Hertz: a = sqrt(4 F R / (pi E*)) with F = 1600 N/m, p0 = 2 F / (pi a); the neighbours of a periodic contact change them by 1e-3
    let modulus: f64 = 210e9 / (1.0 - 0.09);
    let half_width = (4.0 * 1600.0 * 1e-4 / (std::f64::consts::PI * modulus)).sqrt();
    let largest = 2.0 * 1600.0 / (std::f64::consts::PI * half_width);
    let near = |found: Option<&str>, unit: &str, told: f64| {
        let (number, found_unit) = found.unwrap().split_once(' ').unwrap();
        let number: f64 = number.parse().unwrap();
        assert!(found_unit == unit && (number / told - 1.0).abs() < 5e-3, "{number} {found_unit}, not {told} {unit}");
    };
    near(row(&output, "half-width of the contact"), "nm", half_width * 1e9);
    near(row(&output, "largest pressure"), "GPa", largest * 1e-9);
    near(row(&output, "mean pressure"), "MPa", 10.0);
    let all = folder.run(&format!("{cylinder} --pressure 10MPa --verbose"));
    assert!(row(&all, "elastic energy per area").unwrap().ends_with(" J/m²"));
    let bare = folder.run("solve --indenter sphere --radius 1 --points 64,64 --size 4 --modulus 1 --pressure 1e-2");
    assert!(row(&bare, "largest pressure").unwrap().parse::<f64>().is_ok(), "{}", text(&bare.stdout));
    assert!(row(&bare, "area of the contact").unwrap().parse::<f64>().is_ok());
    let layer = folder.run("solve --indenter cylinder --radius 1mm --points 512 --size 4mm --modulus 1GPa --poisson 0.3 --layer 1mm --pressure 1MPa");
    assert!(row(&layer, "approach").unwrap().ends_with(" µm"), "{}{}", text(&layer.stdout), text(&layer.stderr));
}

#[test]
fn small_areas_have_their_digits() {
    let folder = Folder::new();
    let output = folder.run("solve --indenter cylinder --radius 1 --points 65536 --size 4 --modulus 1 --pressure 1e-7");
    let area = row(&output, "relative area").unwrap().split_whitespace().next().unwrap();
    // by Hertz: 2 sqrt(4 F R / (pi E*)) over the length of the cell
    let exact = 2.0 * (4.0 * 4e-7 / std::f64::consts::PI).sqrt() / 4.0;
    assert!((area.parse::<f64>().unwrap() / exact - 1.0).abs() < 0.1, "{area}");
}

#[test]
fn approach_and_plastic_area_are_in_tables_and_archives() {
    let folder = Folder::new();
    let run =
        "--indenter cylinder --radius 1 --points 256 --size 4 --modulus 1 --poisson 0.3 --layer 1 --hardness 0.02";
    let output = folder.run(&format!("solve {run} --pressure 1e-3,1e-2 --out curve.csv"));
    assert!(output.status.success(), "{}", text(&output.stderr));
    let mut table = csv::Reader::from_path(folder.join("curve.csv")).unwrap();
    let names = table.headers().unwrap().clone();
    let last = table.records().last().unwrap().unwrap();
    let value = |name: &str| -> f64 { last[names.iter().position(|it| it == name).unwrap()].parse().unwrap() };
    let (summary, _) = solve(&folder, &format!("{run} --pressure 1e-2"));
    assert_close(value("approach"), number(&summary, "approach"), 1e-6, "approach");
    assert_close(value("plastic_area"), summary["plasticity"]["area"].as_f64().unwrap(), 1e-12, "plastic area");
    assert!(value("approach") > 0.0 && value("plastic_area") > 0.0);
    let mut npz = NpzReader::new(File::open(folder.join("contact.npz")).unwrap()).unwrap();
    let approach: ArrayD<f64> = npz.by_name("approach").unwrap();
    assert_close(approach.sum(), number(&summary, "approach"), 0.0, "approach in the archive");
}

/// What yields has no gap in any output, and its overlap stands under its own name.
#[test]
fn gaps_of_what_yields_are_zero_and_overlaps_have_their_own_name() {
    let folder = Folder::new();
    let run = "--hurst 0.8 --rolloff 0.25 --short-cutoff 0.05 --rms-gradient 0.1 --points 512 --size 1 --hardness 0.02 --reduced-pressure";
    let (summary, _) = solve(&folder, &format!("{run} 0.15"));
    let mut npz = NpzReader::new(File::open(folder.join("contact.npz")).unwrap()).unwrap();
    let [gap, overlap]: [ArrayD<f64>; 2] = ["gap", "overlap"].map(|name| npz.by_name(name).unwrap());
    assert!(gap.iter().chain(&overlap).all(|it| *it >= 0.0) && gap.iter().zip(&overlap).all(|(g, o)| g * o == 0.0));
    assert_close(gap.sum() / 512.0, number(&summary, "mean_gap"), 1e-10, "mean gap");
    assert_close(overlap.sum() / 512.0, number(&summary, "plastic_overlap"), 1e-10, "overlap");
    assert!(number(&summary, "plastic_overlap") > number(&summary, "mean_gap"));
    let output = folder.run(&format!("solve {run} 0.01,0.15,0.01 --out curve.csv"));
    assert!(output.status.success(), "{}", text(&output.stderr));
    let mut table = csv::Reader::from_path(folder.join("curve.csv")).unwrap();
    let names = table.headers().unwrap().clone();
    let rows: Vec<_> = table.records().map(Result::unwrap).collect();
    let value =
        |row: usize, name: &str| -> f64 { rows[row][names.iter().position(|it| it == name).unwrap()].parse().unwrap() };
    assert_close(value(1, "mean_gap"), number(&summary, "mean_gap"), 1e-5, "mean gap in the table");
    // what was flattened stays flat, and is no gap
    assert!(value(2, "plastic_overlap") >= value(1, "plastic_overlap") * (1.0 - 1e-6));
    assert!((0..3).all(|row| value(row, "mean_gap") > 0.0));
}
