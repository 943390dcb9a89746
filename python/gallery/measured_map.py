"""A measured map, as an atomic force microscope exports it, is read, judged, prepared and pressed.

    python measured_map.py [map.txt]

Without an argument the script writes a synthetic scan in the text format of Gwyddion: a part of a larger rough surface, with tilt and noise. Raw,
its two sides differ by the tilt, and the contact is that of the cliff between them. Prepared, the tilt is gone and the map is mirrored, so that it
repeats without a cliff. On a grid that is fine enough the area has a small estimated error.
"""

import sys
import warnings

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp


def synthetic_scan(path):
    """Writes a part of a rough surface with tilt and noise as a map of 5 µm."""
    whole = asp.Surface.rough([256, 256], 10e-6, hurst=0.8, rolloff_wavelength=2e-6, short_cutoff=0.25e-6, rms_gradient=0.2, seed=3)
    part = whole.height[:128, :128] + np.linspace(0, 300e-9, 128) + 0.1e-9 * np.random.default_rng(1).standard_normal((128, 128))
    np.savetxt(path, part, fmt="%.5e", header="Channel: Height\nWidth: 5 µm\nHeight: 5 µm\nValue units: m", encoding="utf-8")
    return path


def press(surface, **more):
    """Presses a surface; its warnings are results here, and are returned as well."""
    with warnings.catch_warnings(record=True) as doubts:
        warnings.simplefilter("always")
        return asp.solve(surface, solid={"young": "3 GPa", "poisson": 0.4}, mean_pressure="10 MPa", **more), doubts


path = sys.argv[1] if len(sys.argv) > 1 else synthetic_scan("scan.txt")
contacts = {
    "raw": press(asp.Surface.read(path)),
    "prepared": press(asp.Surface.read(path, prepare="auto")),
    "prepared, refined": press(asp.Surface.read(path, prepare="auto"), refine="auto"),
}
for name, (contact, doubts) in contacts.items():
    numbers = contact.measures
    print(f"{name}: relative area {numbers['relative_area']:.4f}, estimated error {numbers['relative_area_error']:.1%}, {len(doubts)} warnings")

figure, axes = plt.subplots(1, 3, figsize=(11, 3.6), layout="constrained")
raw, best = asp.Surface.read(path), contacts["prepared, refined"][0]
images = {
    "raw: height (nm)": (raw.height * 1e9, raw, "viridis"),
    "raw: $p$ (MPa)": (contacts["raw"][0].pressure / 1e6, raw, "magma"),
    "prepared, refined: $p$ (MPa)": (best.pressure / 1e6, best.problem.surface, "magma"),
}
for plot, (title, (field, surface, colours)) in zip(axes, images.items()):
    ny, nx = surface.size
    image = plot.imshow(field, extent=(0, nx * 1e6, ny * 1e6, 0), cmap=colours)
    plot.set(xlabel="$x$ (µm)", ylabel="$y$ (µm)", title=title)
    figure.colorbar(image, ax=plot, shrink=0.75)
figure.savefig("measured_map.png", dpi=100)
