"""The pressure of another code is certified, right and with four everyday mistakes.

The other code is a solver by conjugate gradients in numpy. The certificate of the right pressure is small. Those of the others are large, and the
printed sentences say what is wrong with them. The map shows how far apart the pressures of both codes are.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

N, LOAD = 128, 0.01


def displacement(pressure):
    q = 2 * np.pi * np.hypot(np.fft.fftfreq(N, 1 / N)[:, None], np.fft.rfftfreq(N, 1 / N))
    compliance = np.divide(2.0, q, out=np.zeros_like(q), where=q > 0)
    return np.fft.irfft2(compliance * np.fft.rfft2(pressure), (N, N))


def conjugate_gradients(height, steps=200):
    """The pressure by the method of Polonsky and Keer (1999)."""
    pressure, direction, before, fresh = np.full((N, N), LOAD), np.zeros((N, N)), 1.0, True
    for _ in range(steps):
        touching = pressure > 0
        gap = displacement(pressure) - height
        gap -= gap[touching].mean()
        square = (gap[touching] ** 2).sum()
        direction = np.where(touching, gap + (0 if fresh else square / before) * direction, 0)
        moved = displacement(direction)
        moved -= moved[touching].mean()
        step = (gap * direction).sum() / (moved * direction).sum()
        pressure = np.maximum(pressure - step * direction, 0)
        outside = (pressure == 0) & (gap < 0)
        pressure[outside] -= step * gap[outside]
        before, fresh = square, outside.any()
        pressure *= LOAD / pressure.mean()
    return pressure


surface = asp.Surface.rough([N, N], 1.0, hurst=0.8, rolloff_wavelength=0.5, short_cutoff=0.06, rms_gradient=0.1, seed=4)
theirs = conjugate_gradients(surface.height)
results = {
    "as it is": theirs,
    "wrong sign": -theirs,
    "forces of nodes": theirs / N**2,
    "transposed": theirs.T,
    "half a cell off": np.fft.fftshift(theirs),
}
etas = {}
for mistake, pressure in results.items():
    certification = asp.certify(surface, solid=1.0, mean_pressure=LOAD, pressure=pressure)
    etas[mistake] = certification.certificate.eta
    print(f"{mistake}: certificate {etas[mistake]:.1e}, {certification.mistakes or 'no mistake'}")

ours = asp.solve(surface, solid=1.0, mean_pressure=LOAD, tolerance=1e-12)
difference = abs(theirs - ours.pressure).max() / ours.pressure.max()
print(f"largest difference of the pressures: {difference:.1e} of the largest pressure")
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.8), layout="constrained")
left.barh(list(etas), np.minimum(list(etas.values()), 1e2), color=["tab:green"] + 4 * ["tab:red"])
left.axvline(1e-8, color="0.3", ls="--", label="tolerance")
left.set(xscale="log", xlabel=r"certificate $\eta$", title="pressure of the other code", xlim=(1e-16, 1e2))
left.invert_yaxis()
left.legend()
with np.errstate(divide="ignore"):
    image = right.imshow(np.log10(abs(theirs - ours.pressure) / ours.pressure.max()), extent=(0, 1, 1, 0), vmin=-16, vmax=-4)
right.set(xlabel="$x/L$", ylabel="$y/L$", title="difference of both codes, none where white")
figure.colorbar(image, ax=right, label=r"$\log_{10}|\Delta p|/p_{\max}$")
figure.savefig("certify_another_code.png", dpi=100)
