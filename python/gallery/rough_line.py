"""A self-affine rough line is pressed on an elastic half-space.

The rough surface above touches the solid below at its highest peaks only. There the pressure is many times the mean pressure, and the solid stands up
between them. The printed area is above that of Persson's theory, and the certificate bounds the error of the solution.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

surface = asp.Surface.rough(8192, "160 um", hurst=0.8, rolloff_wavelength="20 um", short_cutoff="0.5 um", rms_gradient=0.05, seed=1)
contact = asp.solve(surface, solid={"young": "3 GPa", "poisson": 0.4}, reduced_pressure=0.05)

area, persson = contact.measures["relative_area"], asp.theory.persson_relative_area(0.05)
print(f"relative area {area:.4f}, Persson {persson:.4f}, kappa_r {contact.measures['kappa_r']:.3f}")
print(f"mean pressure {contact.mean_pressure / 1e6:.2f} MPa, largest {contact.pressure.max() / 1e6:.0f} MPa, {contact.measures['patches']:g} patches")
print(f"certificate {contact.certificate.eta:.1e}, error of the pressure below {contact.certificate.pressure_error_bound:.1e}")

x = contact.x * 1e6
figure, (above, below) = plt.subplots(2, 1, figsize=(9, 5), sharex=True, layout="constrained")
solid, rough = -contact.displacement * 1e6, (contact.gap - contact.displacement) * 1e6
above.fill_between(x, rough, rough.max() + 0.12, color="0.75", label="rough surface, rigid")
above.fill_between(x, solid.min() - 0.05, solid, color="tab:blue", alpha=0.4, label="elastic solid")
above.plot(x[contact.contact], solid[contact.contact], ".", ms=4, color="tab:red", label="contact")
above.set(ylabel="$z$ (µm)", title="surfaces, heights enlarged")
above.legend(loc="upper right", ncols=3)
below.semilogy(x, np.where(contact.contact, contact.pressure, np.nan) / 1e6, ".", ms=3, color="tab:red", label="pressure in contact")
below.axhline(contact.mean_pressure / 1e6, color="0.3", ls="--", label="mean pressure")
below.set(xlabel="$x$ (µm)", ylabel="$p$ (MPa)", xlim=(0, 160))
below.legend(loc="lower right", ncols=2)
figure.savefig("rough_line.png", dpi=100)
