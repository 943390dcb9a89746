"""Contact patches from state to state."""

import numpy as np

import asperity as asp


def test_patches_keep_their_numbers() -> None:
    x = np.arange(256) / 128
    waves = 0.01 * np.cos(2 * np.pi * x) + 0.001 * np.cos(np.pi * x)
    loads = [1e-4, 1e-2, 0.2, 1e-2, 1e-4]
    curve = asp.solve(waves, 2.0, solid=1.0, mean_pressure=loads)
    patches, events = curve.patches(), curve.patch_events()
    assert events == [(1, "born", 2, None), (2, "merged", 2, 1), (3, "split", 3, 1), (4, "died", 3, None)]
    assert patches["state"].tolist() == [0, 1, 1, 2, 3, 3, 4]
    assert patches["patch"].tolist() == [1, 1, 2, 1, 1, 3, 1]
    for state, contact in enumerate(curve):
        rows = patches["state"] == state
        assert np.isclose(patches["load"][rows].sum(), 2.0 * loads[state])
        assert np.isclose(patches["load_share"][rows].sum(), 1.0)
        assert patches["nodes"][rows].sum() == np.count_nonzero(contact.pressure)
        assert (np.sort(contact.patches()["x"]) == np.sort(patches["x"][rows])).all()
    # the crests are at 0 and at the middle of the cell
    second = patches["patch"] == 2
    assert np.allclose(patches["x"][second], 1.0) and np.allclose(patches["y"], 0.0)
