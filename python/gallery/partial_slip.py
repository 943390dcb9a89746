"""A cylinder is pressed on a solid and pulled sideways by less than friction allows.

The middle of the contact sticks and its two rims slip. In the rims the traction is the coefficient of friction times the pressure; the stick zone
shrinks while the pull grows, as Cattaneo (1938) and Mindlin (1949) found. Both bodies are of one material.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

RADIUS, FORCE, FRICTION = 10e-3, 100e3, 0.3
SHARES = [0.1, 0.3, 0.5, 0.7, 0.9]
cylinder = asp.Surface.indenter("cylinder", 4096, 2e-3, radius=RADIUS, boundary="free")
history = asp.solve(
    cylinder,
    solid={"young": ["210 GPa", "210 GPa"], "poisson": [0.3, 0.3]},
    force=f"{FORCE} N/m",
    friction={"coefficient": FRICTION},
    path={"tangential": [share * FRICTION * FORCE for share in SHARES]},
)

hertz = asp.theory.cylinder(RADIUS, history[0].problem.contact_modulus)
a = hertz.half_width(FORCE)
x = history[0].x - cylinder.size[0] / 2
p0 = hertz.pressure(a, 0.0)
stick_widths = history.numbers["stick_share"]
errors = []
figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4), layout="constrained")
left.plot(x / a, history[0].pressure / p0, color="0.6", ls="--", label=r"limit $\mu p$")
for share, traction, stick in zip(SHARES, history.fields["traction"], stick_widths):
    exact = FRICTION * (hertz.pressure(a, x) - hertz.pressure(a * np.sqrt(1 - share), x))
    errors.append(abs(traction - exact).max() / (FRICTION * p0))
    print(f"Q/(mu P) = {share}: stick width {stick:.4f}, exact {np.sqrt(1 - share):.4f}, largest error of the traction {errors[-1]:.1e} of mu p0")
    if share in (0.3, 0.7, 0.9):
        (line,) = left.plot(x / a, exact / (FRICTION * p0), label=f"$Q/(\\mu P)$ = {share}")
        left.plot((x / a)[::16], (traction / (FRICTION * p0))[::16], ".", color=line.get_color())
left.set(xlabel="$x/a$", ylabel=r"traction $q/(\mu p_0)$, dots: solved", xlim=(-1.2, 1.2), ylim=(0, 1.5))
left.legend(loc="upper center", ncols=2, title="lines: Cattaneo, Mindlin")
share = np.linspace(0, 1)
right.plot(share, np.sqrt(1 - share), label=r"Cattaneo, Mindlin, $\sqrt{1-Q/(\mu P)}$")
right.plot(SHARES, stick_widths, "o", label="solved")
right.set(xlabel=r"tangential load $Q/(\mu P)$", ylabel="width of the stick zone $c/a$", xlim=(0, 1), ylim=(0, 1.05))
right.legend()
figure.savefig("partial_slip.png", dpi=100)
