"""A rough metal is pressed up and down: once elastic, once with a hardness that limits the pressure.

With the hardness more area is needed for the same load, never less than the load over the hardness. On the way back the flattened peaks keep more
area than on the way up. The distribution of pressures ends at the hardness.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

HARDNESS, MODULUS = 1e9, 100e9
surface = asp.Surface.rough([256, 256], 100e-6, hurst=0.8, rolloff_wavelength=25e-6, short_cutoff=4e-6, rms_gradient=0.025, seed=1)
up = np.geomspace(1e-3, 0.2, 8)
loads = np.concatenate([up, up[-2::-1]])

elastic = asp.solve(surface, solid=MODULUS, reduced_pressure=up)
hard = asp.solve(surface, solid=MODULUS, reduced_pressure=loads, law={"hardness": HARDNESS})
mean = hard.measures["mean_pressure"]
area = hard.measures["relative_area"]
top = len(up) - 1
share = hard.measures["plastic_area"][top] * HARDNESS / mean[top]
print(f"largest pressure / hardness {hard[top].pressure.max() / HARDNESS:.6f}, elastic {elastic[top].pressure.max() / HARDNESS:.2f}")
print(f"largest load: plastic share of the load {share:.3f}, area / (mean pressure / hardness) {area[top] / (mean[top] / HARDNESS):.3f}")
print(f"at the third load the area is {area[2]:.4f} on the way up and {area[-3]:.4f} on the way down")

figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4), layout="constrained")
left.loglog(elastic.measures["mean_pressure"] / 1e6, elastic.measures["relative_area"], "k.-", label="elastic")
left.loglog(mean[: top + 1] / 1e6, area[: top + 1], "o-", color="tab:red", label="with hardness, up")
left.loglog(mean[top:] / 1e6, area[top:], "v--", color="tab:blue", label="with hardness, down")
left.loglog(mean / 1e6, mean / HARDNESS, ":", color="0.4", label="mean pressure / hardness")
left.set(xlabel=r"mean pressure $\bar p$ (MPa)", ylabel="relative contact area $A/A_0$")
left.legend()
for contact, style, name in ((elastic[top], "k-", "elastic"), (hard[top], "r-", "with hardness")):
    right.hist(contact.pressure[contact.contact] / 1e9, bins=80, range=(0, 5), histtype="step", color=style[0], label=name)
right.axvline(HARDNESS / 1e9, color="0.4", ls=":", label="hardness")
right.set(yscale="log", xlabel="pressure $p$ (GPa)", ylabel="nodes in contact", title=f"largest load, {mean[top] / 1e6:.0f} MPa")
right.legend()
figure.savefig("hardness.png", dpi=100)
