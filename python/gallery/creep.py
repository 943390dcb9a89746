"""A rough surface rests on rubber that creeps under a constant load.

The contact grows from a few patches to more than a third of the cell. Lee and Radok (1960) show that at each time it is the contact of an elastic
solid under the load P J(t), where J is the creep compliance; the crosses are such elastic solutions.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

LOAD, RATIO, TIME = 0.02, 9.0, 9e-3
surface = asp.Surface.rough([128, 128], 100e-6, hurst=0.8, rolloff_wavelength=25e-6, short_cutoff=6e-6, rms_gradient=0.05, seed=2)
rubber = {"young": "10 MPa", "poisson": 0.5}
history = asp.solve(
    surface, solid=rubber, reduced_pressure=LOAD, viscoelastic={"creep": [RATIO, TIME]}, path={"time": 5 * TIME, "steps": 20}
)

time, area = history.numbers["time"], history.numbers["relative_area"]
compliance = 1 + RATIO * (1 - np.exp(-time / TIME))
elastic = asp.solve(surface, solid=rubber, reduced_pressure=list(LOAD * compliance))
error = abs(area / elastic.measures["relative_area"] - 1).max()
print(f"relative area {area[0]:.4f} at once, {area[-1]:.4f} after {time[-1] * 1e3:.0f} ms")
print(f"largest difference to elastic contacts under P J(t): {error:.1e} of the area")

figure, axes = plt.subplot_mosaic([["area", "first", "last"]], figsize=(11, 3.7), width_ratios=[1.3, 1, 1], layout="constrained")
axes["area"].plot(time * 1e3, area, label="rubber under a constant load")
axes["area"].plot(time * 1e3, elastic.measures["relative_area"], "k+", label="elastic solid under $P\\,J(t)$")
axes["area"].set(xlabel="time (ms)", ylabel="relative contact area $A/A_0$", ylim=(0, None))
axes["area"].legend()
for name, number in (("first", 0), ("last", -1)):
    field = np.where(history[number].contact, history[number].pressure / 1e6, np.nan)
    image = axes[name].imshow(field, extent=(0, 100, 100, 0), norm="log", vmin=0.01, vmax=1, cmap="plasma")
    axes[name].set(xlabel="$x$ (µm)", ylabel="$y$ (µm)", title=f"contact after {time[number] * 1e3:.0f} ms")
figure.colorbar(image, ax=[axes["first"], axes["last"]], label="pressure $p$ (MPa)", shrink=0.8, extend="min")
figure.savefig("creep.png", dpi=100)
