"""A cylinder is pressed on an elastic layer that slides without friction on a rigid base, or is bonded to it.

On a thick layer the half-width is that of Hertz. On a thin one the base carries the load, and the contact is narrower: it follows the closed form of
an elastic foundation (Johnson 1985, section 5.8). A bonded layer cannot move aside, and is stiffer still.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

RADIUS, SIZE, MODULUS, POISSON, LOAD = 10e-3, 1e-3, 10e6, 0.3, 0.5
cylinder = asp.Surface.indenter("cylinder", 8192, SIZE, radius=RADIUS)
thickness = np.geomspace(1e-6, 1e-3, 13)


def pressed(**layer):
    return asp.solve(cylinder, solid={"contact_modulus": MODULUS, "poisson": POISSON, **layer}, mean_pressure=LOAD / SIZE)


def half_width(contact):
    return contact.measures["relative_area"] * SIZE / 2


# a foundation of modulus K under a parabola: a^3 = 3 P R t / (2 K)
stiffness = {"sliding": MODULUS, "bonded": MODULUS * (1 - POISSON) ** 2 / (1 - 2 * POISSON)}
hertz = asp.theory.cylinder(RADIUS, MODULUS).half_width(LOAD)
figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4), layout="constrained")
for base, colour in (("sliding", "tab:blue"), ("bonded", "tab:red")):
    found = np.array([half_width(pressed(layer=t, base=base)) for t in thickness])
    foundation = np.cbrt(1.5 * LOAD * RADIUS * thickness / stiffness[base])
    print(f"{base}: error of the half-width against the foundation {abs(found[0] / foundation[0] - 1):.1e} on the thinnest layer,", end=" ")
    print(f"against Hertz {abs(found[-1] / hertz - 1):.1e} on the thickest")
    left.loglog(thickness * 1e6, found * 1e6, "o", color=colour, label=f"solved, {base}")
    left.loglog(thickness[:8] * 1e6, foundation[:8] * 1e6, color=colour, label=f"elastic foundation, {base}")
left.axhline(hertz * 1e6, color="0.3", ls="--", label="Hertz, half-space")
left.set(xlabel="thickness of the layer $t$ (µm)", ylabel="half-width of the contact $a$ (µm)")
left.set_yticks([10, 15, 20, 30], ["10", "15", "20", "30"])
left.tick_params(axis="y", which="minor", labelleft=False)
left.legend()
for t in thickness[[0, 6, -1]]:
    contact = pressed(layer=t, base="sliding")
    right.plot((contact.x - SIZE / 2) * 1e6, contact.pressure / 1e3, label=f"$t$ = {t * 1e6:.0f} µm")
right.set(xlabel="$x$ (µm)", ylabel="pressure $p$ (kPa)", xlim=(-40, 40), title="sliding on the base")
right.legend()
figure.savefig("layer.png", dpi=100)
