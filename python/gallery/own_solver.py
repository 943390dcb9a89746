"""A solver of one's own, a projected gradient in numpy, is recorded step by step, and the diagnosis says why it is slow.

Left: its certificate falls slowly, while conjugate gradients and the multilevel solver need few steps for the same problem. Right: the pressure of
two steps beside the solution. The printed diagnosis names the waves that are last to converge.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

N, LOAD, STEPS = 512, 0.01, 300
surface = asp.Surface.rough(N, 1.0, hurst=0.8, rolloff_wavelength=0.25, short_cutoff=0.02, rms_gradient=0.1, seed=1)
problem = asp.Problem(surface, solid=1.0, mean_pressure=LOAD)


def projected_gradient(height):
    """Yields the pressure of each step; one step length, 0.9 of the stiffness of the longest wave, serves all waves."""
    q = 2 * np.pi * np.fft.rfftfreq(N, 1 / N)
    compliance = np.divide(2.0, q, out=np.zeros_like(q), where=q > 0)
    pressure = np.full(N, LOAD)
    for _ in range(STEPS):
        yield pressure
        gap = np.fft.irfft(compliance * np.fft.rfft(pressure), N) - height
        pressure = np.maximum(pressure - 0.9 * np.pi * (gap - gap[pressure > 0].mean()), 0)
        pressure *= LOAD / pressure.mean()


kept = {}
with asp.Recorder(problem, name="projected gradient") as recorder:
    for number, pressure in enumerate(projected_gradient(surface.height)):
        recorder.step(pressure)
        kept[number] = pressure
print(recorder.diagnosis)

figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
left.semilogy(recorder.distances["step"], recorder.distances["certificate"], label="projected gradient")
print(f"projected gradient: certificate {recorder.distances['certificate'][-1]:.1e} after {STEPS} steps")
for solver in ("polonsky-keer", "multilevel"):
    errors = []
    solution = problem.solve(solver=solver, callback=lambda step: errors.append(step.error))
    print(f"{solver}: certificate {solution.certificate.eta:.1e} after {len(errors)} steps")
    known = np.flatnonzero(np.isfinite(errors))  # multilevel does not certify each step
    left.semilogy(known, np.take(errors, known), ".-", ms=4, label=solver + ", coarse grids first" * (solver == "multilevel"))
left.set(xlabel="step", ylabel=r"certificate $\eta$")
left.legend()
for number in (10, 50):
    right.plot(solution.x, kept[number], label=f"projected gradient, step {number}")
right.plot(solution.x, solution.pressure, "k:", label="solution")
right.set(xlabel="$x/L$", ylabel="pressure $p/E^*$", xlim=(0.3, 0.7))
right.legend()
figure.savefig("own_solver.png", dpi=100)
