//! Pictures of contacts and of load curves, and the units in summaries.

use super::*;
use asperity::quantity::number_in_words;
use zip::{ZipArchive, ZipWriter};

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

/// A needle has several times the pressure of all other nodes: the colours end below it, and its pressure is told. Mirror images are told, too.
#[test]
fn a_map_shows_more_than_its_largest_pressure_and_tells_mirror_images() {
    let folder = Folder::new();
    let hill = |y: usize, x: usize| 1e-3 * ((0.3 * x as f64).sin() + (0.4 * y as f64).cos() + 0.02 * (x + y) as f64);
    let needle = |(y, x): (usize, usize)| hill(y, x) + if [y, x] == [20, 30] { 4e-3 } else { 0.0 };
    write_npy(folder.join("needle.npy"), &Array2::from_shape_fn((48, 64), needle)).unwrap();
    let solve = "solve --height needle.npy --size 0.48,0.64 --modulus 1 --pressure 5e-3";
    for (flags, title) in [("", "needle"), ("--mirror both", "needle with its mirror images")] {
        let output = folder.run(&format!("{solve} {flags} --out map.svg --json"));
        assert!(output.status.success(), "{}", text(&output.stderr));
        let summary: Value = serde_json::from_slice(&output.stdout).unwrap();
        let highest = number_in_words(summary["max_pressure"].as_f64().unwrap());
        let svg = std::fs::read_to_string(folder.join("map.svg")).unwrap();
        assert!(svg.contains(&format!(">{title}</text>")), "{title}");
        assert!(folder.run(&format!("{solve} {flags} --out needle.npz")).status.success());
        assert!(folder.run("plot needle.npz --map pressure --out drawn.svg").status.success());
        let drawn = std::fs::read_to_string(folder.join("drawn.svg")).unwrap();
        assert!(drawn.contains(&format!(">{title}</text>")), "{title}: {drawn}");
        assert!(svg.contains(&format!(">pressure, at most {highest}</text>")), "{title}: {highest}");
    }
    let smooth = "solve --indenter sphere --radius 1 --points 64,64 --size 1 --modulus 1 --pressure 1e-2 --out map.svg";
    assert!(folder.run(smooth).status.success());
    let svg = std::fs::read_to_string(folder.join("map.svg")).unwrap();
    assert!(
        svg.contains(">pressure</text>") && !svg.contains("at most"),
        "a smooth contact has all of its pressures in colours"
    );
}

/// Maps of results have the same colours: the axis of each goes to the largest value of all. The setup of a result tells its units.
#[test]
fn maps_of_results_stand_side_by_side() {
    let folder = Folder::new();
    let rough = "solve --hurst 0.8 --rolloff 500um --short-cutoff 100um --rms-gradient 0.1 --points 32,32 --size 1mm --modulus 230GPa";
    for (name, pressure) in [("light", "100MPa"), ("heavy", "900MPa")] {
        assert!(folder.run(&format!("{rough} --pressure {pressure} --out {name}.npz")).status.success());
    }
    let largest = |name: &str| {
        let mut archive = NpzReader::new(File::open(folder.join(&format!("{name}.npz"))).unwrap()).unwrap();
        let pressure: Array2<f64> = archive.by_name("pressure").unwrap();
        pressure.iter().copied().fold(0.0, f64::max)
    };
    assert!(largest("heavy") > 1.05 * largest("light"));
    let svg = |line: &str| {
        let output = folder.run(line);
        assert!(output.status.success(), "{line}: {}", text(&output.stderr));
        std::fs::read_to_string(folder.join("maps.svg")).unwrap()
    };
    let both = svg("plot light.npz heavy.npz --map pressure --out maps.svg");
    let alone = svg("plot heavy.npz --map pressure --out maps.svg");
    for title in ["light", "heavy", "x / mm"] {
        assert!(both.contains(&format!(">{title}</text>")), "{title}");
    }
    let bar = |svg: &str| {
        svg.split("</text>")
            .filter_map(|it| it.rsplit('>').next())
            .filter(|it| it.contains("/ GPa"))
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    assert_eq!((bar(&both).len(), bar(&alone).len()), (2, 1));
    assert!(bar(&both).iter().all(|name| *name == bar(&alone)[0]), "{:?}", bar(&both));
    assert!(svg("plot light.npz heavy.npz --map gap --out maps.svg").contains(">gap / µm</text>"));
    assert!(svg("solve light.npz --out maps.svg").contains("/ GPa</text>"));

    folder.run("solve --indenter cylinder --radius 1 --points 64 --size 4 --modulus 1 --pressure 1e-2 --out line.npz");
    folder.run("solve --indenter sphere --radius 1 --points 16,16 --size 4 --modulus 1 --pressure 1e-2 --out bare.npz");
    for (files, reason) in
        [("line.npz", "has no maps"), ("light.npz bare.npz", "the same units"), ("light.npz new.toml", "has no maps")]
    {
        let output = folder.run(&format!("plot {files} --map pressure --out none.svg"));
        assert_eq!(output.status.code(), Some(2), "{files}");
        assert!(text(&output.stderr).contains(reason) && !folder.join("none.svg").exists(), "{}", text(&output.stderr));
    }
}

/// The value of a row of a summary.
fn row<'a>(output: &'a Output, name: &str) -> Option<&'a str> {
    text(&output.stdout).lines().find_map(|line| line.trim().strip_prefix(name)).map(str::trim)
}

/// Numbers alone are lengths without a unit beside pressures with one, and a result of them says so: solved again it is printed, and drawn, in the
/// same units. A setup that was written before results said so is in metres.
#[test]
fn a_result_has_the_units_of_its_setup() {
    let folder = Folder::new();
    for (size, said) in [("--radius 1 --size 4", "radius 1.0"), ("--radius 1mm --size 4mm", "radius 1 mm")] {
        let run = format!("solve --indenter sphere {size} --points 32,32 --young 210GPa --poisson 0.3");
        let first = folder.run(&format!("{run} --pressure 90MPa --out run.npz"));
        let mut results = vec!["solve run.npz", "solve --setup-of run.npz --pressure 90MPa"];
        if cfg!(feature = "record") {
            assert!(folder.run(&format!("{run} --pressure 90MPa --record run.rrd")).status.success());
            results.push("solve --setup-of run.rrd");
        }
        for again in results {
            let output = folder.run(again);
            for name in ["source", "mean gap", "spacing", "area of the contact", "contact modulus E*", "mean pressure"]
            {
                assert_eq!(row(&output, name), row(&first, name), "{again}: {name}");
            }
        }
        assert!(row(&first, "source").unwrap().ends_with(said), "{}", text(&first.stdout));
        assert!(row(&first, "contact modulus E*").unwrap().contains("E 210 GPa"), "{}", text(&first.stdout));
        assert!(folder.run("plot run.npz --map gap --out gap.svg").status.success());
        let svg = std::fs::read_to_string(folder.join("gap.svg")).unwrap();
        assert_eq!(svg.contains(">x / mm</text>"), size.contains("mm"), "{svg}");
        assert!(folder.run(&format!("{run} --pressure 90MPa --save-setup scene.toml")).status.success());
        let scene = std::fs::read_to_string(folder.join("scene.toml")).unwrap();
        std::fs::write(folder.join("older.toml"), scene.replace("length-unit = \"\"", "length-unit = \"m\"")).unwrap();
        assert!(row(&folder.run("solve older.toml"), "mean gap").unwrap().contains("m ("));
    }
    // a file has metres, also where the grid of its surface is chosen later
    let rough = "--hurst 0.8 --rolloff 40um --short-cutoff 20um --rms-gradient 0.05 --points 16,16 --size 100um";
    assert!(folder.run(&format!("surface {rough} --out patch.sdf")).status.success());
    let solved = folder.run(
        "solve patch.sdf --prepare auto --refine auto --young 3GPa --poisson 0.4 --pressure 10MPa --out patch.npz",
    );
    assert!(row(&solved, "mean gap").unwrap().contains("nm ("), "{}", text(&solved.stdout));
    assert_eq!(row(&folder.run("solve patch.npz"), "mean gap"), row(&solved, "mean gap"));
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
    let (own, beside) = row(&output, "half-width of the contact").unwrap().split_once("   exact ").unwrap();
    near(Some(own), "nm", half_width * 1e9);
    near(Some(beside), "nm", half_width * 1e9);
    near(row(&output, "largest pressure"), "GPa", largest * 1e-9);
    near(row(&output, "mean pressure"), "MPa", 10.0);
    let all = folder.run(&format!("{cylinder} --pressure 10MPa --verbose"));
    assert!(row(&all, "elastic energy per area").unwrap().ends_with(" J/m²"));
    let bare = folder.run("solve --indenter sphere --radius 1 --points 64,64 --size 4 --modulus 1 --pressure 1e-2");
    assert!(row(&bare, "largest pressure").unwrap().parse::<f64>().is_ok(), "{}", text(&bare.stdout));
    let area = row(&bare, "area of the contact").unwrap().split(',').next().unwrap();
    assert!(area.parse::<f64>().is_ok(), "{area}");
    let layer = folder.run("solve --indenter cylinder --radius 1mm --points 512 --size 4mm --modulus 1GPa --poisson 0.3 --layer 1mm --pressure 1MPa");
    assert!(row(&layer, "approach").unwrap().ends_with(" µm"), "{}{}", text(&layer.stdout), text(&layer.stderr));
}

/// Hertz: a = (3 F R / (4 E*))^(1/3), for a sphere alone and beside its images.
#[test]
fn the_radius_of_a_sphere_stands_beside_that_of_hertz() {
    let folder = Folder::new();
    let sphere =
        "solve --indenter sphere --radius 1mm --points 128,128 --size 100um --young 210GPa --poisson 0.3 --force 1N";
    let radius = (0.75 * 1e-3 / (210e9 / 0.91f64)).cbrt() * 1e6;
    for (boundary, words) in [("free", "exact"), ("periodic", "without neighbouring cells")] {
        let output = folder.run(&format!("{sphere} --boundary {boundary}"));
        let told = row(&output, "area of the contact").and_then(|row| row.split_once(", radius ")).unwrap().1;
        let (own, exact) = told.split_once(&format!("   {words} ")).unwrap();
        let [own, exact] = [own, exact].map(|it| it.strip_suffix(" µm").unwrap().parse::<f64>().unwrap());
        assert!((exact / radius - 1.0).abs() < 1e-3 && (own / radius - 1.0).abs() < 0.01, "{told}, not {radius}");
        let json = json(&folder.run(&format!("{sphere} --boundary {boundary} --json")));
        assert!((json["exact"]["contact_radius"].as_f64().unwrap() * 1e6 / radius - 1.0).abs() < 1e-9);
    }
    let rough = "solve --hurst 0.8 --rolloff 500um --short-cutoff 60um --rms-gradient 0.1 --points 64,64 --size 1mm --modulus 230GPa --pressure 500MPa";
    assert!(!row(&folder.run(rough), "area of the contact").unwrap().contains("radius"));
    let kappa_r = |hardness: &str| {
        text(&folder.run(&format!("{rough} {hardness}")).stdout).contains("before the surface is flattened")
    };
    assert!(kappa_r("--hardness 2GPa") && !kappa_r("--hardness 900GPa") && !kappa_r(""));
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
    let plasticity = &summary["plasticity"];
    assert_close(value("plastic_area"), number(plasticity, "area"), 1e-12, "plastic area");
    assert_close(value("plastic_load_share"), number(plasticity, "load_share"), 1e-12, "plastic share of the load");
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

/// A result from which an array was taken out is not drawn: one from which the digest was taken out as well is.
#[test]
fn a_result_that_was_changed_is_not_drawn() {
    let folder = Folder::new();
    assert!(folder.run(&format!("solve {ROUGH_LINE} --reduced-pressure 1e-2,1e-1 --out it.npz")).status.success());
    let without = |left_out: &[&str]| {
        let mut archive = ZipArchive::new(std::fs::File::open(folder.join("it.npz")).unwrap()).unwrap();
        let mut copy = ZipWriter::new(std::fs::File::create(folder.join("copy.npz")).unwrap());
        for number in 0..archive.len() {
            let file = archive.by_index_raw(number).unwrap();
            if !left_out.contains(&file.name()) {
                copy.raw_copy_file(file).unwrap();
            }
        }
        copy.finish().unwrap();
        folder.run("plot copy.npz --out copy.svg")
    };
    assert!(without(&[]).status.success());
    let changed = without(&["kappa_counted.npy"]);
    let said = text(&changed.stderr);
    assert_eq!(changed.status.code(), Some(2), "{said}");
    assert!(said.contains("copy.npz is not as it was written") && said.lines().count() == 1, "{said}");
    assert!(without(&["kappa_counted.npy", "digest.npy"]).status.success());
}
