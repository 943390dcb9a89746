"""A fluid leaks through the gap of a rough seal.

Left: close to the load that seals, nearly all of the fluid passes a few constrictions, which are bright. Right: the gap of two parallel plates that
leak as much falls steeply with the area, and the seal is tight where no open path is left. No seal leaks more than its mean cube of the gap allows.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

surface = asp.Surface.rough([256, 256], 100e-6, hurst=0.8, rolloff_wavelength=25e-6, short_cutoff=4e-6, rms_gradient=0.1, seed=1)
problem = asp.Problem(surface, solid="10 MPa", reduced_pressure=0.02)
seal = problem.solve().sealing_load("x")
tight = seal["sealed"]
print(f"seals at a mean pressure of {tight['mean_pressure'] / 1e3:.0f} kPa, relative area {tight['relative_area']:.3f}")

loads = tight["reduced_pressure"] * np.array([0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95])
contacts = list(problem.with_load(reduced_pressure=list(loads)).solve())
flows = [contact.leakage("x") for contact in contacts]
areas = [contact.measures["relative_area"] for contact in contacts]
plates = [flow["hydraulic_gap"] for flow in flows]
cubes = [np.mean(contact.gap**3) ** (1 / 3) for contact in contacts]
print(f"as between plates {plates[0] * 1e9:.1f} nm apart at the lightest load, {plates[-1] * 1e9:.2f} nm at the last one")
print(f"largest ratio to the bound by the mean cube: {max(np.divide(plates, cubes)):.3f}")
print(f"largest distance of the two bounds of the leakage: {max(flow['upper'] / flow['lower'] - 1 for flow in flows):.1e}")

figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
flux = np.where(contacts[-1].contact, np.nan, flows[-1]["flux"])
with np.errstate(divide="ignore"):
    image = left.imshow(np.log10(flux), extent=(0, 100, 100, 0), vmin=-3, vmax=2, cmap="inferno")
left.set_facecolor("0.8")
left.set(xlabel="$x$ (µm), from inlet to outlet", ylabel="$y$ (µm)", title="95 % of the sealing load, contact grey")
figure.colorbar(image, ax=left, label=r"$\log_{10}$ of the flux over its mean")
right.semilogy(areas, np.array(cubes) * 1e9, "--", color="0.5", label=r"bound, $\langle g^3\rangle^{1/3}$")
right.semilogy(areas, np.array([contact.mean_gap for contact in contacts]) * 1e9, "s-", mfc="none", color="0.3", label="mean gap")
right.semilogy(areas, np.array(plates) * 1e9, "o-", label=r"plates that leak as much, $\sigma^{1/3}$")
right.axvline(tight["relative_area"], color="tab:red", ls=":", label="seals")
right.set(xlabel="relative contact area $A/A_0$", ylabel="gap (nm)", xlim=(0, 0.45))
right.legend()
figure.savefig("leakage.png", dpi=100)
