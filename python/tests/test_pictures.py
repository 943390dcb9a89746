"""Pictures of contacts: the rigid surface keeps its shape, and the solid is pressed down."""

import numpy as np
import pytest

import asperity as asp

pytest.importorskip("matplotlib")

LENGTH, RADIUS = 1.0, 2.0
X = (np.arange(256) / 256 - 0.5) * LENGTH
CYLINDER = -X * X / (2 * RADIUS)


def drawn(load: float) -> tuple[asp.Contact, slice, dict[str, np.ndarray]]:
    """The contact of a cylinder, the nodes that its picture shows, and the bodies there, upwards."""
    contact = asp.solve(CYLINDER, LENGTH, solid=1.0, mean_pressure=load)
    lines = {line.get_label(): line for line in contact.plot().axes[0].lines}
    seen = np.isin(contact.problem.surface.x, lines["solid"].get_xdata())
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
    touches = np.asarray(contact.pressure[seen]) > 0
    solid = bodies["solid"]
    assert solid[touches].max() < solid[~touches].min()
    assert (bodies["rigid surface"] - solid).min() > -1e-9
