"""What a type checker must understand; it is never run."""

from typing_extensions import assert_type

import numpy as np
from numpy.typing import NDArray

import asperity as asp

surface = asp.Surface.rough((64, 64), "1 mm", hurst=0.8, rolloff_wavelength="200 um", short_cutoff="100 um", rms_gradient=0.1)
contact = asp.solve(surface, solid={"young": "210 GPa", "poisson": 0.3}, mean_pressure="1 MPa", callback=lambda step: step.error > 1e-3)
assert_type(contact.pressure, NDArray[np.float64])
assert_type(contact.measures["kappa_r"], float)
assert_type(asp.theory.sphere(1.0).load(0.1), float)
assert_type(asp.theory.sphere(1.0).load(contact.pressure), NDArray[np.float64])
with asp.Recorder(contact.problem, "mine.rrd", stream=asp.notebook.Viewer()) as recorder:
    recorder.step(contact.pressure, seconds=1.0)
assert_type(recorder.contact, asp.Contact)
assert_type(asp.certify(contact.height, 1.0, gap=contact.gap).holds, bool)
assert_type(contact.contact, NDArray[np.bool_])
assert_type(contact.raise_if_not_converged(), asp.Contact)
assert_type(contact.problem.solve(tolerance=1e-6).gap, NDArray[np.float64])
curve = asp.solve(surface, reduced_pressure=[0.01, 0.1], solver="gfmd")
assert_type(curve, asp.History)
assert_type(curve[0], asp.Contact)
assert_type(curve.measures["kappa_r"], NDArray[np.float64])
assert_type(asp.Problem(surface, solid=1.0, mean_pressure=np.array([0.1, 0.2])).solve(), asp.History)
assert_type(asp.Problem(surface, solid="1 GPa", mean_pressure="1 MPa", friction={"coefficient": 0.5, "tangential": 1e3}).solve(), asp.Contact)
assert_type(asp.solve(surface, mean_gap="1 um", refine="auto", progress=True), asp.Contact)
assert_type(asp.solve(surface, mean_pressure=1e6, solid=1e9, viscoelastic={"creep": [9, 1]}, path={"time": 1}).fields["stored_strain"], NDArray[np.float64])
assert_type(asp.solve(surface, force=1.0, solid=1e9, friction={"coefficient": 0.3}, rolling={"creepage": 1e-4})[0], asp.Contact)
assert_type(asp.solve(surface, mean_gap="1 um", solid="1 MPa", adhesion={"work": 0.01, "range": "80 nm"}).claims, list[str])
assert_type(asp.Problem(surface, mean_gap=1e-6, solid=1e6, adhesion={"work": 0.01, "range": 1e-7}, path={"load": [1e-6, 0.0]}).solve(), asp.History)
assert_type(asp.load("run.npz"), "asp.Contact | asp.History")
assert_type(asp.solve(contact.height, 1.0, reduced_pressure=0.1, prepare="auto", flow={"leakage": True}).conductance("17 nohm*m"), float)
assert_type(asp.Surface(contact.height, 1.0, prepare={"detrend": "plane"}).preparation, list[str])
assert_type(surface.spectrum("profile"), tuple[NDArray[np.float64], NDArray[np.float64]])
assert_type(asp.solve(surface, mean_pressure=1e6, solid=1e9, viscoelastic={"creep": [9, 1]}, path="press.csv"), asp.History)
