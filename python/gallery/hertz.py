"""A rigid sphere of 1 mm radius is pressed on steel by 1 N, on a free boundary.

Left: the pressure along the middle row lies on the ellipse of Hertz. Right: the sphere comes from above, and the steel below is pressed down to its
shape. The printed lines are the errors of contact radius, approach and largest pressure against the closed form.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

RADIUS, FORCE = 1e-3, 1.0
sphere = asp.Surface.indenter("sphere", [257, 257], 160e-6, radius=RADIUS, boundary="free")
contact = asp.solve(sphere, solid={"young": "210 GPa", "poisson": 0.3}, force=f"{FORCE} N")

hertz = asp.theory.sphere(RADIUS, contact.problem.contact_modulus)
a = hertz.half_width(FORCE)
found = {
    "contact radius": (np.sqrt(contact.measures["relative_area"] * np.prod(sphere.size) / np.pi), a, "m"),
    "approach": (contact.approach, hertz.approach(a), "m"),
    "largest pressure": (contact.pressure.max(), hertz.pressure(a, 0.0), "Pa"),
}
for name, (solved, exact, unit) in found.items():
    print(f"{name}: {solved:.5g} {unit}, Hertz {exact:.5g} {unit}, error {abs(solved / exact - 1):.1e}")

row = np.unravel_index(sphere.height.argmax(), sphere.shape)[0]
x = contact.x - contact.x[row]
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
left.plot(x / a, contact.pressure[row] / 1e9, ".", label="solved, nodes")
left.plot(x / a, hertz.pressure(a, x) / 1e9, label="Hertz")
left.set(xlabel="$x/a$", ylabel="pressure $p$ (GPa)", xlim=(-2, 2), title="pressure")
left.legend()
right.plot(x / a, (contact.gap[row] - contact.displacement[row]) * 1e9, label="sphere")
right.plot(x / a, -contact.displacement[row] * 1e9, label="steel")
right.axvspan(-1, 1, color="0.9", label="contact of Hertz")
right.set(xlabel="$x/a$", ylabel="$z$ (nm)", xlim=(-2, 2), ylim=(-260, 200), title="surfaces")
right.legend(loc="upper center")
figure.savefig("hertz.png", dpi=100)
