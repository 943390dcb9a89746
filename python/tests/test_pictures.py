"""Figures: the rigid surface keeps its shape, the solid is pressed down, and curves and maps hold the numbers."""

import struct
from pathlib import Path

import numpy as np
import pytest

import asperity as asp

matplotlib = pytest.importorskip("matplotlib")

LENGTH, RADIUS = 1.0, 2.0
X = (np.arange(256) / 256 - 0.5) * LENGTH
CYLINDER = -X * X / (2 * RADIUS)
ROUGH = asp.Surface.rough((64, 128), (1.0, 2.0), hurst=0.8, rolloff_wavelength=0.5, short_cutoff=0.1, rms_gradient=0.1)


def drawn(load: float) -> tuple[asp.Contact, slice, dict[str, np.ndarray]]:
    """The contact of a cylinder, the nodes that its figure shows, and the bodies there, upwards."""
    contact = asp.solve(CYLINDER, LENGTH, solid=1.0, mean_pressure=load)
    lines = {line.get_label(): line for line in contact.plot().axes[0].lines}
    seen = np.isin(contact.x, lines["solid"].get_xdata())
    first, last = np.flatnonzero(seen)[[0, -1]]
    return contact, slice(first, last + 1), {name: np.asarray(line.get_ydata()) for name, line in lines.items()}


@pytest.mark.parametrize("load", [0.001, 0.01, 0.05])
def test_the_rigid_surface_has_the_shape_of_the_heights_peaks_down(load: float) -> None:
    contact, seen, bodies = drawn(load)
    height = np.asarray(contact.height[seen])
    rigid = bodies["rigid surface"]
    assert np.allclose(rigid - rigid.mean(), -(height - height.mean()), atol=1e-6 * np.ptp(CYLINDER))


def test_the_solid_is_lower_below_the_contact() -> None:
    contact, seen, bodies = drawn(0.01)
    touches = contact.contact[seen]
    solid = bodies["solid"]
    assert solid[touches].max() < solid[~touches].min()
    assert (bodies["rigid surface"] - solid).min() > -1e-9


def test_maps_hold_the_fields() -> None:
    contact = asp.solve(ROUGH, reduced_pressure=0.1)
    images = [image for axes in contact.plot().axes for image in axes.images]
    pressure, gap = (image.get_array() for image in images)
    assert np.array_equal(pressure.filled(0.0), np.where(contact.contact, contact.pressure, 0.0)) and np.array_equal(gap, contact.gap)
    (heights,) = [image for axes in ROUGH.plot().axes for image in axes.images]
    assert np.array_equal(heights.get_array(), ROUGH.height) and heights.get_extent() == [0.0, 2.0, 0.0, 1.0] and heights.origin == "lower"


def test_a_curve_is_drawn_over_the_reduced_pressure() -> None:
    curve = asp.solve(asp.Surface(CYLINDER, LENGTH), reduced_pressure=[0.1, 0.2, 0.4])
    area, kappa_r = (axes.lines[0] for axes in curve.plot().axes)
    assert np.array_equal(area.get_xdata(), curve.measures["reduced_pressure"])
    assert (np.diff(area.get_ydata()) > 0).all() and np.array_equal(kappa_r.get_ydata(), curve.measures["kappa_r"])
    gaps = asp.solve(asp.Surface(CYLINDER, LENGTH), mean_gap=[0.02, 0.01]).plot().axes[0].lines[0]
    assert np.allclose(gaps.get_xdata(), [0.02, 0.01])


def test_notebooks_show_a_picture_and_the_main_numbers() -> None:
    contact = asp.solve(ROUGH, reduced_pressure=0.1)
    html = contact._repr_html_()
    assert "data:image/png;base64," in html and "reduced pressure 0.1" in html and "multilevel: converged" in html
    assert f"{contact.mean_gap:.6g}" in html
    assert "rms gradient" in ROUGH._repr_html_() and "64 x 128" in ROUGH._repr_html_()


def test_a_loop_with_jumps_is_drawn() -> None:
    sine = asp.Surface.indenter(shape="sine", points=512, size="20 um", amplitude="1 um")
    loop = asp.solve(
        sine, solid="1 MPa", mean_gap="1 um", path={"load": ["1.6 um", "0.4 um", "1.6 um"], "steps": 8}, adhesion={"work": 0.01, "range": "80 nm"}
    )
    assert isinstance(loop, asp.History) and loop.adhesion is not None
    left, right = loop.plot().axes
    (line,) = left.lines
    assert np.array_equal(line.get_xdata(), loop.numbers["mean_gap"]) and np.array_equal(line.get_ydata(), loop.numbers["mean_pressure"])
    assert len(left.texts) == len(loop.adhesion["jumps"]) == 2 and len(left.patches) == 1
    for arrow, jump in zip(left.texts, loop.adhesion["jumps"]):
        assert arrow.xy == (jump["mean_gap"][1], jump["mean_pressure"][1])
    labels = (left.get_xlabel(), left.get_ylabel(), right.get_ylabel())
    assert labels == ("mean gap / unit of length", "mean pressure / unit of pressure", "relative area")
    scaled, _ = loop.plot(length_unit="um", pressure_unit="kPa").axes
    assert (scaled.get_xlabel(), scaled.get_ylabel()) == ("mean gap / µm", "mean pressure / kPa")
    assert np.allclose(scaled.lines[0].get_xdata(), 1e6 * loop.numbers["mean_gap"])


@pytest.mark.parametrize(
    ("keys", "labels"),
    [
        ({"viscoelastic": {"creep": [9.0, 1.0]}, "path": {"time": 2.0, "steps": 3}}, ["time", "relative area", "mean gap / unit of length"]),
        ({"viscoelastic": {"creep": [9.0, 1.0]}, "sliding": {"speed": [0.01, 0.1]}}, ["speed", "friction coefficient", "relative area"]),
        ({"friction": {"coefficient": 0.5}, "path": {"tangential": [0.005, -0.005]}}, ["shift / unit of length", "mean traction / unit of pressure", "share that sticks"]),
        ({"friction": {"coefficient": 0.5}, "rolling": {"creepage": [1e-4, 2e-4]}}, ["creepage", "friction coefficient", "share that sticks"]),
    ],
)
def test_each_process_has_its_charts(keys: dict[str, dict[str, object]], labels: list[str]) -> None:
    rough = asp.Surface.rough(256, 1.0, hurst=0.8, rolloff_wavelength=0.25, short_cutoff=0.05, rms_gradient=0.1)
    history = asp.solve(rough, solid=1.0, mean_pressure=0.02, **keys)
    axes = history.plot().axes
    assert [axes[0].get_xlabel(), *(it.get_ylabel() for it in axes)] == labels
    assert all(np.isfinite(it.lines[0].get_ydata()).any() for it in axes)


def test_notebooks_show_curves_histories_and_tables(tmp_path: Path) -> None:
    curve = asp.solve(ROUGH, reduced_pressure=[0.1, 0.2])
    assert "data:image/png;base64," in curve._repr_html_() and "<td>2</td>" in curve._repr_html_()
    history = asp.solve(ROUGH, reduced_pressure=0.02, viscoelastic={"creep": [9.0, 1.0]}, path={"time": 1.0, "steps": 2})
    assert "data:image/png;base64," in history._repr_html_() and "creep" in history._repr_html_()
    assert asp.show(history).axes
    table = asp.study(
        asp.Study(
            surface={"indenter": {"shape": "sine", "amplitude": 0.01}}, grid={"points": 64, "size": 1.0},
            load={"reduced_pressure": [0.01 * (i + 1) for i in range(12)]},
        )
    )
    assert "Table of 12 rows" in table._repr_html_() and "10 of 12 rows" in table._repr_html_()
    for it in (curve, history):
        it.save(tmp_path / "it.png")
        assert (tmp_path / "it.png").read_bytes().startswith(b"\x89PNG")


def test_an_empty_cell_is_drawn_as_a_whole() -> None:
    contact = asp.solve(CYLINDER, LENGTH, solid=1.0, mean_pressure=0.01, callback=lambda step: False)
    assert contact.plot() is not None


def test_a_notebook_shows_a_picture_without_pyplot() -> None:
    pytest.importorskip("matplotlib")
    contact = asp.solve(asp.Surface.rough(256, 1.0, hurst=0.8, rolloff_wavelength=0.3, short_cutoff=0.05, rms_gradient=0.1), reduced_pressure=0.1)
    assert contact.plot()._repr_png_().startswith(b"\x89PNG")


def test_a_single_peak_does_not_set_the_scale_of_a_map() -> None:
    pytest.importorskip("matplotlib")
    surface = asp.Surface.rough((64, 64), 1.0, hurst=0.8, rolloff_wavelength=0.3, short_cutoff=0.1, rms_gradient=0.1)
    contact = asp.solve(surface, reduced_pressure=0.1)
    image = contact.plot().axes[0].images[0]
    assert 0.5 * contact.pressure.max() < image.get_clim()[1] < contact.pressure.max()
    assert (np.ma.getmaskarray(image.get_array()) == ~contact.contact).all()


def test_a_recording_is_shown_as_a_picture_without_a_viewer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("asperity.notebook.has_viewer", lambda: False)
    surface = asp.Surface.rough(256, 1.0, hurst=0.8, rolloff_wavelength=0.3, short_cutoff=0.1, rms_gradient=0.1)
    contact = asp.solve(surface, reduced_pressure=0.1, record=tmp_path / "run.rrd")
    shown = asp.show(tmp_path / "run.rrd").axes[1].lines[0].get_ydata()
    assert np.array_equal(shown, contact.plot().axes[1].lines[0].get_ydata())
    asp.solve(asp.Surface(np.array(surface.height), 1.0), reduced_pressure=0.1, record=tmp_path / "array.rrd")
    assert asp.show(tmp_path / "array.rrd") == str(tmp_path / "array.rrd")


def test_axes_have_units() -> None:
    line = asp.solve(asp.Surface(1e-6 * CYLINDER, 1e-3), solid=1e9, mean_pressure=1e3)
    left, right = line.plot(length_unit="um", pressure_unit="MPa").axes
    assert (left.get_xlabel(), left.get_ylabel(), right.get_ylabel()) == ("x / µm", "z / µm", "pressure / MPa")
    assert np.isclose(max(right.lines[0].get_ydata()), 1e-6 * line.pressure.max())
    assert line.plot().axes[1].get_ylabel() == "pressure / unit of pressure"
    contact = asp.solve(ROUGH, reduced_pressure=0.1)
    maps = contact.plot(length_unit="mm").axes
    assert [axes.get_ylabel() for axes in maps] == ["y / mm", "y / mm", "pressure / unit of pressure", "gap / mm"]
    curve = asp.solve(ROUGH, solid=1.0, mean_pressure=[0.01, 0.02])
    area = curve.plot(pressure_unit="kPa").axes[0]
    assert area.get_xlabel() == "mean pressure / kPa" and np.allclose(area.lines[0].get_xdata(), [1e-5, 2e-5])
    with pytest.raises(asp.AsperityError, match="length_unit is 'inch': give one of m, mm, um"):
        contact.plot(length_unit="inch")


def test_labels_have_room() -> None:
    figure = asp.solve(ROUGH, reduced_pressure=[0.001, 0.01, 0.1]).plot()
    agg = pytest.importorskip("matplotlib.backends.backend_agg")
    agg.FigureCanvasAgg(figure).draw()
    boxes = [axes.get_tightbbox() for axes in figure.axes]
    assert all(one.x1 <= other.x0 for one, other in zip(boxes, boxes[1:]))
    assert boxes[0].x0 >= 0 and boxes[-1].x1 <= figure.bbox.width


def test_a_figure_takes_the_size_and_the_font_of_a_page(tmp_path: Path) -> None:
    with matplotlib.rc_context({"font.size": 7}):
        figure = asp.solve(ROUGH, reduced_pressure=0.1).plot(length_unit="um")
    figure.set_size_inches(6.7, 2.8)
    figure.savefig(tmp_path / "map.png", dpi=300)
    width, height = struct.unpack(">II", (tmp_path / "map.png").read_bytes()[16:24])
    assert (width, height) == (2010, 840) and figure.axes[0].xaxis.label.get_size() == 7
