"""Four doors, one number: what a drive gives in memory, in its contacts, in its table and in its archive is the same to the bit."""

import asperity as asp
import numpy as np
import pytest


DRIVES = {
    "creep": dict(surface="rough", load={"reduced-pressure": 0.05}, viscoelastic={"creep": [9, 1]}, path={"time": [0, 1], "steps": 3}),
    "sliding": dict(surface="rough", load={"reduced-pressure": 0.05}, viscoelastic={"creep": [9, 1]}, sliding={"speed": [1e-3, 1e-1]}),
    "slip": dict(surface="cylinder", load={"force": 0.01}, friction={"coefficient": 0.3}, path={"tangential": [1e-3, 2e-3, -2e-3]}),
    "rolling": dict(surface="cylinder", load={"force": 0.01}, friction={"coefficient": 0.3}, rolling={"tangential": [1e-3, 2e-3]}),
    "adhesion": dict(surface="sine", load={"mean-gap": 0.02}, adhesion={"work": 4e-4, "range": 5e-3}, path={"load": [0.02, 0.005, 0.03], "steps": 6}),
    "plastic": dict(surface="steel", load={"mean-pressure": [1e-3, 1.5e-3]}),
    "loads": dict(surface="rough", load={"reduced-pressure": [0.02, 0.05]}),
}

SURFACES = {
    "rough": """
surface = { spectrum = { hurst = 0.8, rolloff-wavelength = 0.125, short-cutoff = 0.02, rms-gradient = 0.1 }, seed = 0 }
grid = { points = 256, size = 1.0 }
solid = { contact-modulus = 1.0 }
""",
    "cylinder": """
surface = { indenter = { shape = "cylinder", radius = 1.0 } }
grid = { points = 128, size = 0.5, boundary = "free" }
solid = { contact-modulus = 1.0 }
""",
    "steel": """
surface = { indenter = { shape = "cylinder", radius = 1.0 } }
grid = { points = 128, size = 1.0 }
solid = { young = 1.0, poisson = 0.3, yield-stress = 0.005, hardening-modulus = 0.05 }
""",
    "sine": """
surface = { indenter = { shape = "sine", amplitude = 0.01 } }
grid = { points = 256, size = 1.0 }
solid = { contact-modulus = 1.0 }
""",
}


def toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(item)}" for key, item in value.items()) + " }"
    return repr(value)


def solved(name):
    drive = dict(DRIVES[name])
    text = SURFACES[drive.pop("surface")] + "\n".join(f"{key} = {toml(value)}" for key, value in drive.items())
    return asp.Setup.from_toml(text).solve()


@pytest.mark.parametrize("name", DRIVES)
@pytest.mark.filterwarnings("ignore::asperity.AsperityWarning")
def test_each_drive_gives_the_same_numbers_through_each_door(name, tmp_path):
    states = solved(name)
    numbers = states.measures if name == "loads" else states.numbers
    states.save(tmp_path / "states.npz")
    archive = np.load(tmp_path / "states.npz")
    states.save(tmp_path / "states.csv")
    table = np.genfromtxt(tmp_path / "states.csv", delimiter=",", names=True, dtype=None, encoding="utf-8", deletechars="")
    assert len(numbers) > 20
    compared = 0
    for quantity, values in numbers.items():
        of_contacts = [contact.measures.get(quantity, np.nan) for contact in states]
        np.testing.assert_array_equal(values, of_contacts, err_msg=quantity)
        for door in (archive, table):
            named = door.files if door is archive else door.dtype.names
            if quantity in named:
                # a column without a value is read as one of flags
                is_empty = door is table and door[quantity].dtype == bool
                found = np.full(len(values), np.nan) if is_empty else np.asarray(door[quantity], dtype=float)
                if door is table and door[quantity].dtype.kind == "i":
                    # an empty cell of a column of whole numbers is read as -1
                    found[found == -1] = np.nan
                np.testing.assert_array_equal(found, values, err_msg=quantity)
                compared += 1
    assert compared > 40
    again = asp.load(tmp_path / "states.npz")
    others = again.measures if name == "loads" else again.numbers
    for quantity in ("mean_pressure", "relative_area", "mean_gap", "max_pressure", "reduced_pressure"):
        np.testing.assert_allclose(others[quantity], numbers[quantity], rtol=1e-12, err_msg=quantity)
