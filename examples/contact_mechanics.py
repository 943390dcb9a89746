"""The steps of ContactMechanics (pip install ContactMechanics), taken from its callback, recorded and compared with the solution.

    python examples/contact_mechanics.py && asperity view contact_mechanics.rrd
"""
import subprocess
import numpy as np
from ContactMechanics import PeriodicFFTElasticHalfSpace
from ContactMechanics.Factory import make_system
from SurfaceTopography import Topography

n, modulus, load = 128, 1.0, 0.02
q = np.hypot(*np.meshgrid(*2 * [np.fft.fftfreq(n, 1 / n)]))
band = np.where((q >= 4) & (q <= 16), np.maximum(q, 1) ** -1.8, 0)
height = np.fft.ifft2(band * np.fft.fft2(np.random.default_rng(7).standard_normal((n, n)))).real
height *= 0.02 / height.std()

substrate = PeriodicFFTElasticHalfSpace((n, n), modulus, (1.0, 1.0))
system = make_system(substrate=substrate, surface=Topography(height, (1.0, 1.0), periodic=True))
forces = []
system.minimize_proxy(
    external_force=load, pentol=1e-10, callback=lambda iteration, force, numbers: forces.append(force.copy())
)

np.save("height.npy", height)
np.save("steps.npy", -np.array(forces) * n**2)  # its forces of nodes, negative in compression, are no pressures
subprocess.run(
    f"asperity inspect --height height.npy --size 1 --modulus {modulus} --mean-pressure {load} "
    "--record contact_mechanics.rrd steps.npy",
    shell=True,
)
