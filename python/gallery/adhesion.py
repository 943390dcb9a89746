"""A wavy surface that sticks is brought to a soft solid and taken away again.

It jumps into contact, and out of it at a larger distance: the area of the loop is the energy lost. Between the jumps it follows the solution of
Johnson (1995) for an attraction of zero range, up to the small range given here. A negative mean pressure is a pull.
"""

import warnings

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

warnings.simplefilter("ignore", asp.AsperityWarning)  # rubber, which is strained a lot where it lets go

MODULUS, WORK, PERIOD, AMPLITUDE = 1e6, 10e-3, 20e-6, 1e-6
sine = asp.Surface.indenter("sine", 1024, PERIOD, amplitude=AMPLITUDE)
history = asp.solve(
    sine,
    solid=MODULUS,
    mean_gap=1e-6,
    adhesion={"work": WORK, "range": 50e-9},
    path={"load": [1.6e-6, 0.6e-6, 1.6e-6], "steps": 20},
)
gap, pressure = history.numbers["mean_gap"], history.numbers["mean_pressure"]

# Johnson: the pressure without adhesion on the half-width a, less the tension that the work of adhesion allows at its edges
angle = np.linspace(0.02, 0.4 * np.pi, 400)
smooth = asp.theory.Westergaard(AMPLITUDE, PERIOD, MODULUS)
tension = np.sqrt(2 * MODULUS * WORK * np.tan(angle) / PERIOD)
without = smooth.full_pressure * np.sin(angle) ** 2
jkr_pressure = without - tension
jkr_gap = smooth.mean_gap(without) - 2 * PERIOD * tension / (np.pi * MODULUS) * np.log(np.sin(angle))
print(f"lowest mean pressure {pressure.min() / 1e3:.3f} kPa, Johnson {jkr_pressure.min() / 1e3:.3f} kPa")
for jump in history.adhesion["jumps"]:
    print(f"jump at a mean gap of {jump['mean_gap'][0] * 1e6:.3f} µm, energy {jump['energy'] * 1e3:.3f} mJ/m²")

figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
left.plot(jkr_gap * 1e6, jkr_pressure / 1e3, color="0.6", lw=3, label="Johnson (1995), zero range")
turn = int(gap.argmin())
left.plot(gap[: turn + 1] * 1e6, pressure[: turn + 1] / 1e3, "o-", ms=3, color="tab:blue", label="closing")
left.plot(gap[turn:] * 1e6, pressure[turn:] / 1e3, "v-", ms=3, color="tab:red", label="opening")
left.set(xlabel="mean gap (µm)", ylabel=r"mean pressure $\bar p$ (kPa)", xlim=(0.55, 1.65), ylim=(-12, 30))
left.legend()
last = max(number for number, state in enumerate(history) if state.contact.any())
state, x = history[last], history[last].x * 1e6
right.plot(x, (state.gap - state.displacement) * 1e6, color="0.3", label="wavy surface, rigid")
right.plot(x, -state.displacement * 1e6, color="tab:blue", label="solid, before it parts")
right.plot([], [], color="tab:green", ls=":", label="attraction, right axis")
right.set(xlabel="$x$ (µm)", ylabel="$z$ (µm)", xlim=(0, 20))
right.legend()
attraction = right.twinx()
attraction.plot(x, history.fields["attraction"][last] / 1e3, color="tab:green", ls=":")
attraction.set(ylabel=r"attraction $\sigma$ (kPa)", ylim=(0, 600))
figure.savefig("adhesion.png", dpi=100)
