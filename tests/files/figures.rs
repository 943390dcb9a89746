//! Figures: what is drawn, read back from the files, and the ticks of axes.

use asperity::error::FileError;
use asperity::plot::{
    Axis, Colour, Dot, FieldMap, Figure, FigureStyle, LegendPlace, Mark, Panel, Symbol, write_figure, write_png,
    write_svg,
};
use resvg::tiny_skia::Pixmap;
use std::path::Path;

const ODD: Colour = Colour([1, 2, 3]);

fn written(name: &str, figure: &Figure, write: fn(&Path, &Figure) -> Result<(), FileError>) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    write(&path, figure).unwrap();
    std::fs::read(path).unwrap()
}

fn svg(figure: &Figure) -> String {
    String::from_utf8(written("figure.svg", figure, write_svg)).unwrap()
}

/// Two panels with a series that has a name and one that has none.
fn figure() -> Figure {
    let panel = |title: &str| {
        let mut panel = Panel::new(title, Axis::log("p*", [1e-3, 1.0]), Axis::linear("κ_r", [0.0, 2.5]));
        let dots = [Dot { x: 1e-2, y: 1.75, spread: 0.1 }, Dot::at(0.1, 1.7)];
        panel.add("H = 0.8 < 1", Colour::BLUE, Mark::Joined { symbol: Symbol::Diamond, filled: false }, dots);
        panel.add("", Colour::BLACK, Mark::Dashed, dots);
        panel
    };
    Figure { title: "both".into(), panels: vec![panel("lines"), panel("surfaces")] }
}

/// The points of all lines and shapes of a colour, such as `#010203`.
fn shapes(text: &str, colour: &str) -> Vec<Vec<[f64; 2]>> {
    let number = |text: &str| text.parse::<f64>().unwrap();
    let point = |pair: &str| pair.split_once(',').map(|(x, y)| [number(x), number(y)]).unwrap();
    let lines = text.lines().filter(|line| line.contains(&format!("=\"{colour}\"")));
    lines.filter_map(|line| line.split('"').nth(1)).map(|points| points.split(' ').map(point).collect()).collect()
}

/// The shapes that a series without a name adds to a panel from 0 to 1 (linear) and from 1e-2 to 1 (logarithmic).
fn drawn(mark: Mark, dots: &[[f64; 3]]) -> Vec<Vec<[f64; 2]>> {
    let mut panel = Panel::new("", Axis::linear("x", [0.0, 1.0]), Axis::log("y", [1e-2, 1.0]));
    panel.add("", ODD, mark, dots.iter().map(|&[x, y, spread]| Dot { x, y, spread }));
    shapes(&svg(&Figure { title: String::new(), panels: vec![panel] }), "#010203")
}

/// The frame of that panel: left, right, top, bottom.
fn edges() -> [f64; 4] {
    let diagonal = drawn(Mark::Line, &[[0.0, 1e-2, 0.0], [1.0, 1.0, 0.0]]);
    let [[left, bottom], [right, top]] = diagonal[0][..] else { panic!("{diagonal:?}") };
    [left, right, top, bottom]
}

#[test]
fn an_svg_says_all_that_the_figure_says() {
    let text = svg(&figure());
    assert!(text.contains("width=\"1200\" height=\"520\" viewBox=\"0 0 1200 520\""), "{text}");
    for (words, times) in
        [("both", 1), ("lines", 1), ("surfaces", 1), ("p*", 2), ("κ_r", 2), ("10⁻³", 2), ("H = 0.8 &lt; 1", 2)]
    {
        assert_eq!(text.matches(&format!(">{words}</text>")).count(), times, "{words} in {text}");
    }
}

#[test]
fn a_png_has_two_pixels_per_unit_and_the_colours() {
    let pixels = Pixmap::decode_png(&written("figure.png", &figure(), write_png)).unwrap();
    assert_eq!([pixels.width(), pixels.height()], [2400, 1040]);
    let is = |pixel: &[u8], colour: Colour| pixel[..3] == colour.0 && pixel[3] == 255;
    let count = |colour: Colour| pixels.data().chunks_exact(4).filter(|pixel| is(pixel, colour)).count();
    assert!(is(&pixels.data()[..4], Colour([255; 3])));
    assert!(count(Colour::BLUE) > 500 && count(Colour::BLACK) > 500 && count(Colour::GREEN) == 0);
}

#[test]
fn words_stand_where_they_should() {
    let panel = Panel::new("", Axis::linear("", [0.0, 1.0]), Axis::linear("H", [0.0, 1.0]));
    let figure = Figure { title: "H".into(), panels: vec![panel] };
    let pixels = Pixmap::decode_png(&written("figure.png", &figure, write_png)).unwrap();
    let is_dark = |[x, y]: [u32; 2]| pixels.pixel(x, y).is_some_and(|pixel| pixel.red() < 128);
    // the title, and the name of the y axis, which runs upwards
    for (width, height, at) in [(1200, 80, [300.0, 24.0]), (60, 1040, [16.0, 257.5])] {
        let all = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
        let dark: Vec<[u32; 2]> = all.filter(|place| is_dark(*place)).collect();
        assert!(!dark.is_empty());
        let mean = |axis: usize| dark.iter().map(|place| f64::from(place[axis])).sum::<f64>() / dark.len() as f64;
        assert!((0..2).all(|axis| (mean(axis) / 2.0 - at[axis]).abs() < 0.8), "{} {}", mean(0), mean(1));
    }
}

#[test]
fn a_figure_is_the_same_bytes_every_time() {
    for (name, write) in [("figure.svg", write_svg as fn(&Path, &Figure) -> _), ("figure.png", write_png)] {
        assert_eq!(written(name, &figure(), write), written(name, &figure(), write), "{name}");
    }
}

#[test]
fn sheets_have_two_panels_in_a_row() {
    let panel = Panel::new("", Axis::linear("x", [0.0, 1.0]), Axis::linear("y", [0.0, 1.0]));
    for (title, panels, [width, height]) in
        [("", 0, [600, 480]), ("", 1, [600, 480]), ("", 2, [1200, 480]), ("", 3, [1200, 960]), ("title", 1, [600, 520])]
    {
        let text = svg(&Figure { title: title.into(), panels: vec![panel.clone(); panels] });
        assert!(text.contains(&format!("viewBox=\"0 0 {width} {height}\"")), "{title}: {panels}");
    }
}

#[test]
fn lines_are_cut_at_the_frame() {
    let [left, right, top, bottom] = edges();
    let across = drawn(Mark::Line, &[[-9.0, 0.1, 0.0], [9.0, 0.1, 0.0], [9.0, -1.0, 0.0], [0.5, 0.1, 0.0]]);
    let [line] = &across[..] else { panic!("{across:?}") };
    let middle = 0.5 * (top + bottom);
    for (point, expected) in line.iter().zip([[left, middle], [right, middle]]) {
        assert!((0..2).all(|i| (point[i] - expected[i]).abs() < 0.011), "{line:?}");
    }
    assert!(drawn(Mark::Dashed, &[[0.0, 2.0, 0.0], [1.0, 3.0, 0.0]]).is_empty());
    assert!(drawn(Mark::Dotted, &[[0.0, 0.1, 0.0], [1.0, 0.1, 0.0]]).len() > 50);
}

#[test]
fn lines_are_broken_by_dots_that_are_not_finite_and_cut_at_corners() {
    let [left, right, top, bottom] = edges();
    let [y, nan] = [0.1, f64::NAN];
    let dots = [[0.1, y, 0.0], [0.2, y, 0.0], [nan, y, 0.0], [0.3, y, 0.0], [0.4, y, 0.0], [0.5, 0.0, 0.0]];
    assert_eq!(drawn(Mark::Line, &dots).iter().map(Vec::len).collect::<Vec<_>>(), [2, 2]);
    let turns = drawn(Mark::Line, &[[-1.0, y, 0.0], [0.5, y, 0.0], [0.5, 1e2, 0.0], [2.0, 1e2, 0.0], [0.5, 1e-1, 0.0]]);
    let [x, middle] = [0.5 * (left + right), 0.5 * (top + bottom)];
    let near = |a: &[[f64; 2]], b: &[[f64; 2]]| {
        a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (0..2).all(|i| (a[i] - b[i]).abs() < 0.011))
    };
    assert!(near(&turns[0], &[[left, middle], [x, middle], [x, top]]), "{turns:?}");
    assert!(near(&turns[1], &[[right, top], [x, middle]]) && turns.len() == 2, "{turns:?}");
}

#[test]
fn dashes_go_around_corners() {
    let [left, right, _, bottom] = edges();
    let dashes = drawn(Mark::Dashed, &[[0.5, 1e-2, 0.0], [1.0, 1e-2, 0.0], [1.0, 1.0, 0.0]]);
    let long = |dash: &Vec<[f64; 2]>| {
        dash.windows(2).map(|pair| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1])).sum::<f64>()
    };
    let (last, whole) = dashes.split_last().unwrap();
    assert!(whole.iter().all(|dash| (long(dash) - 7.0).abs() < 0.05) && long(last) < 7.05);
    let x = 0.5 * (left + right);
    assert_eq!((dashes[0][0], dashes[1][0][0]), ([x, bottom], x + 11.5));
    let around: Vec<_> = dashes.iter().filter(|dash| dash.len() == 3).collect();
    assert!(around.iter().all(|dash| dash[1] == [right, bottom]) && around.len() == 1, "{around:?}");
}

#[test]
fn symbols_outside_are_left_out() {
    let symbol = Mark::Symbol { symbol: Symbol::Circle, filled: true };
    let dots = [[0.5, 0.1, 0.0], [1.0, 1.0, 0.0], [1.1, 0.1, 0.0], [0.5, 1e-3, 0.0], [0.5, -1.0, 0.0]];
    assert_eq!(drawn(symbol, &dots).len(), 2);
    assert!(drawn(symbol, &[[f64::NAN, 0.1, 0.1], [0.5, f64::INFINITY, 0.1]]).is_empty());
}

#[test]
fn error_bars_are_cut_and_keep_the_caps_inside() {
    let [_, _, top, bottom] = edges();
    let symbol = Mark::Symbol { symbol: Symbol::Square, filled: false };
    assert_eq!(drawn(symbol, &[[0.5, 0.1, 0.05]]).len(), 1 + 3);
    let cut = drawn(symbol, &[[0.5, 0.1, 0.2]]);
    assert_eq!(cut.len(), 1 + 2);
    assert!(cut[0][0][1] == bottom && cut[0][1][1] > top, "{cut:?}");
    assert!(drawn(symbol, &[[2.0, 0.1, 0.05], [0.5, 3.0, 0.5]]).is_empty());
}

#[test]
fn a_legend_stands_in_a_corner_where_it_hides_nothing_or_is_smaller() {
    let [left, right, top, bottom] = edges();
    let legend = |curve: fn(f64) -> f64| {
        let mut panel = Panel::new("", Axis::linear("x", [0.0, 1.0]), Axis::log("y", [1e-2, 1.0]));
        (0..9).for_each(|i| panel.add(format!("curve number {i}"), ODD, Mark::Line, []));
        panel.add_curve("", ODD, Mark::Line, curve);
        let shapes = shapes(&svg(&Figure { title: String::new(), panels: vec![panel] }), "#ffffff");
        [shapes[0][0], shapes[0][2]]
    };
    let [corner, end] = legend(|_| 0.02);
    assert!((right - end[0] - 9.0).abs() < 0.02 && (corner[1] - top - 9.0).abs() < 0.02, "{corner:?} {end:?}");
    let [lower, lower_end] = legend(|_| 0.9);
    assert!((right - lower_end[0] - 9.0).abs() < 0.02 && (bottom - lower_end[1] - 9.0).abs() < 0.02, "{lower:?}");
    let [upper, _] = legend(|x| 10f64.powf(-20.0 * (x - 0.78)));
    assert!((upper[0] - left - 9.0).abs() < 0.02, "{upper:?}");
    let [small, small_end] = legend(|_| 0.1);
    assert!(small_end[0] - small[0] < 0.9 * (end[0] - corner[0]), "{small:?} {small_end:?}");
}

fn labels(axis: &Axis) -> Vec<String> {
    axis.ticks().into_iter().map(|(_, label)| label).collect()
}

#[test]
fn places_run_from_start_to_end() {
    let log = Axis::log("p*", [1e-4, 1.0]);
    assert!((log.place(1e-3) - 0.25).abs() < 1e-12 && (log.place(10.0) - 1.25).abs() < 1e-12);
    assert!([0.0, -1.0, f64::NAN].iter().all(|&value| !log.place(value).is_finite()));
    assert_eq!([4.0, 3.0, 0.0].map(|value| Axis::linear("t", [4.0, 0.0]).place(value)), [0.0, 0.25, 1.0]);
}

#[test]
fn long_logarithmic_axes_have_powers_of_ten() {
    let axis = Axis::log("p*", [0.5e-3, 1.0]);
    let expected = [(1e-3, "10⁻³"), (1e-2, "10⁻²"), (1e-1, "10⁻¹"), (1.0, "10⁰")];
    assert_eq!(axis.ticks(), expected.map(|(value, label)| (value, label.to_string())));
    let minor = axis.minor_ticks();
    assert!((minor[0] - 0.5e-3).abs() < 1e-15 && minor.len() == 5 + 3 * 9 + 1, "{minor:?}");
    assert_eq!(labels(&Axis::log("eta", [1e-14, 1e2])).len(), 9);
}

#[test]
fn short_logarithmic_axes_have_more() {
    assert_eq!(labels(&Axis::log("p*", [2e-2, 0.6])), ["0.02", "0.05", "0.1", "0.2", "0.5"]);
    assert_eq!(labels(&Axis::log("p*", [2e-5, 2e-4])), ["2·10⁻⁵", "5·10⁻⁵", "10⁻⁴", "2·10⁻⁴"]);
    assert_eq!(labels(&Axis::log("p*", [3.0, 4.0])), ["3.0", "3.2", "3.4", "3.6", "3.8", "4.0"]);
}

#[test]
fn linear_axes_have_round_steps() {
    assert_eq!(labels(&Axis::linear("x", [-0.5, 1.1])), ["−0.5", "0", "0.5", "1.0"]);
    assert_eq!(labels(&Axis::linear("x", [100.0, 0.0])), ["0", "20", "40", "60", "80", "100"]);
    assert_eq!(labels(&Axis::linear("x", [0.0, 1.6e-6])), ["0", "0.5·10⁻⁶", "1.0·10⁻⁶", "1.5·10⁻⁶"]);
    let (value, label) = &Axis::linear("x", [0.0, 0.3]).ticks()[2];
    assert!((value - 0.1).abs() < 1e-15 && label == "0.10", "{value} {label}");
}

#[test]
fn a_range_that_is_empty_or_not_finite_has_no_ticks() {
    let ranges = [[1.0, 1.0], [f64::NAN, 1.0], [0.0, f64::INFINITY], [-1e308, 1e308], [0.0, 5e-324]];
    for [start, end] in ranges {
        assert!(Axis::linear("x", [start, end]).ticks().is_empty(), "{start} to {end}");
    }
    for [start, end] in [[0.0, 1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, f64::INFINITY]] {
        let axis = Axis::log("x", [start, end]);
        assert!(axis.ticks().is_empty() && axis.minor_ticks().is_empty(), "{start} to {end}");
    }
    assert!(!Axis::log("x", [1e-308, 1e308]).ticks().is_empty());
    assert!(Axis::linear("x", [1.0, 1.0 + 4.0 * f64::EPSILON]).ticks().len() < 20);
}

/// A figure in a style, by the ending of its name.
fn styled(name: &str, figure: &Figure, style: &FigureStyle) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    write_figure(&path, figure, style).unwrap();
    std::fs::read(path).unwrap()
}

/// The number behind a word of a text.
fn after(text: &str, word: &str) -> f64 {
    let rest = &text[text.find(word).unwrap_or_else(|| panic!("no {word} in {text}")) + word.len()..];
    rest[..rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap()].parse().unwrap()
}

#[test]
fn a_figure_has_its_size_on_paper_in_each_format() {
    let style = FigureStyle { width: Some(0.085), height: Some(0.06), font: Some(7.0), ..FigureStyle::default() };
    let text = String::from_utf8(styled("figure.svg", &figure(), &style)).unwrap();
    assert!((after(&text, "width=\"") - 85.0).abs() < 0.1 && (after(&text, "height=\"") - 60.0).abs() < 0.1, "{text}");
    assert!(text.contains("mm\" viewBox="));
    // a label of 15 units is 7 points high
    let unit = 85.0 / after(&text, "viewBox=\"0 0 ");
    assert!((15.0 * unit / 25.4 * 72.0 - 7.0).abs() < 0.02, "{unit}");
    for (dpi, width) in [(None, 1004.0), (Some(600.0), 2008.0)] {
        let pixels =
            Pixmap::decode_png(&styled("figure.png", &figure(), &FigureStyle { dpi, ..style.clone() })).unwrap();
        assert!((f64::from(pixels.width()) - width).abs() < 3.0, "{}", pixels.width());
    }
    for (dpi, per_metre) in [(300.0, 11811_u32), (600.0, 23622)] {
        let bytes = styled("figure.png", &figure(), &FigureStyle { dpi: Some(dpi), ..style.clone() });
        let place = bytes.windows(4).position(|it| it == b"pHYs").unwrap() + 4;
        assert_eq!(bytes[place..place + 9], [&per_metre.to_be_bytes()[..], &per_metre.to_be_bytes(), &[1]].concat());
    }
    let pdf = styled("figure.pdf", &figure(), &style);
    let head = String::from_utf8_lossy(&pdf);
    let size: Vec<f64> = head[head.find("/MediaBox [").unwrap() + 11..]
        .split([' ', ']'])
        .take(4)
        .map(|it| it.parse().unwrap())
        .collect();
    assert!((size[2] - 85.0 / 25.4 * 72.0).abs() < 0.4 && (size[3] - 60.0 / 25.4 * 72.0).abs() < 0.4, "{size:?}");
}

#[test]
fn narrow_figures_have_their_panels_below_each_other() {
    let text = |width| {
        let style = FigureStyle { width: Some(width), ..FigureStyle::default() };
        String::from_utf8(styled("figure.svg", &figure(), &style)).unwrap()
    };
    let over = |text: &str| after(text, "height=\"") / after(text, "width=\"");
    assert!(over(&text(0.085)) > 1.5 && over(&text(0.17)) < 0.6);
}

#[test]
fn titles_limits_and_legends_are_those_of_the_style() {
    let style = FigureStyle {
        title: Some("another".into()),
        x: Some([1e-2, 1e2]),
        y: vec![[-1.0, 1.0], [-3.0, 0.0]],
        legend: LegendPlace::None,
        ..FigureStyle::default()
    };
    let text = String::from_utf8(styled("figure.svg", &figure(), &style)).unwrap();
    for (words, times) in
        [("another", 1), ("both", 0), ("10²", 2), ("10⁻³", 0), ("−1.0", 2), ("−3.0", 1), ("H = 0.8 &lt; 1", 0)]
    {
        assert_eq!(text.matches(&format!(">{words}</text>")).count(), times, "{words} in {text}");
    }
    // limits that a logarithmic axis cannot have are left out
    let text = styled("figure.svg", &figure(), &FigureStyle { x: Some([-1.0, 1.0]), ..style });
    assert!(String::from_utf8(text).unwrap().contains(">10⁻³</text>"));
    for wrong in [
        FigureStyle { width: Some(85.0), ..FigureStyle::default() },
        FigureStyle { font: Some(0.0), ..FigureStyle::default() },
        FigureStyle { dpi: Some(f64::NAN), ..FigureStyle::default() },
        FigureStyle { x: Some([1.0, 0.0]), ..FigureStyle::default() },
    ] {
        assert!(wrong.check().is_err(), "{wrong:?}");
    }
}

/// A field whose values are their places along x, so that each colour stands where it belongs.
#[test]
fn a_map_has_the_colours_of_its_bar_and_the_proportions_of_its_axes() {
    let scale = Axis::linear("pressure / MPa", [0.0, 1.0]);
    let values = (0..8)
        .flat_map(|row| (0..16).map(move |column| if row == 0 { f64::NAN } else { (f64::from(column) + 0.5) / 16.0 }));
    let map = FieldMap { shape: [8, 16], values: values.collect(), scale };
    let panel =
        Panel { map: Some(map), ..Panel::new("", Axis::linear("x", [0.0, 2.0]), Axis::linear("y", [0.0, 1.0])) };
    let figure = Figure { title: String::new(), panels: vec![panel] };
    let text = svg(&figure);
    assert_eq!(text.matches("<image ").count(), 2);
    assert!(text.contains(">pressure / MPa</text>"));
    let image = &text[text.find("<image ").unwrap()..];
    let [x, y, width, height] = [" x=\"", " y=\"", " width=\"", " height=\""].map(|word| after(image, word));
    assert!((width / height - 2.0).abs() < 0.01, "{width} {height}");
    let pixels = Pixmap::decode_png(&written("figure.png", &figure, write_png)).unwrap();
    let at = |right: f64, up: f64| {
        let [column, row] = [2.0 * (x + right * width), 2.0 * (y + (1.0 - up) * height)].map(|it| it as u32);
        let pixel = pixels.pixel(column, row).unwrap();
        [pixel.red(), pixel.green(), pixel.blue()]
    };
    assert_eq!(at(0.5, 0.03), [255, 255, 255], "the first row is below, and its values are not numbers");
    let (low, high) = (at(0.02, 0.6), at(0.98, 0.6));
    assert!(low[2] > low[0] && low[1] < 40 && high[0] > 200 && high[1] > 200 && high[2] < 80, "{low:?} {high:?}");
    let bar = &text[text.rfind("<image ").unwrap()..];
    let [left, top, high] = [" x=\"", " y=\"", " height=\""].map(|word| after(bar, word));
    let of_bar = |share: f64| {
        let pixel = pixels.pixel((2.0 * (left + 6.0)) as u32, (2.0 * (top + (1.0 - share) * high)) as u32).unwrap();
        [pixel.red(), pixel.green(), pixel.blue()]
    };
    for share in [0.09375, 0.46875, 0.90625] {
        let apart = at(share, 0.6).into_iter().zip(of_bar(share)).map(|(a, b)| a.abs_diff(b)).max();
        assert!(apart < Some(12), "{share}: {:?} {:?}", at(share, 0.6), of_bar(share));
    }
}
