"""A naive projected gradient in numpy, recorded step by step: why does it crawl?

    python examples/projected_gradient.py && asperity view projected_gradient.rrd
"""
import subprocess
import numpy as np

n, modulus, load = 512, 1.0, 0.01
x = np.arange(n) / n
height = 0.01 * np.cos(2 * np.pi * x) + 0.002 * np.cos(2 * np.pi * 7 * x + 1)
q = 2 * np.pi * np.arange(n // 2 + 1)
compliance = np.divide(2, modulus * q, out=np.zeros_like(q), where=q > 0)


def displacement(pressure):
    return np.fft.irfft(compliance * np.fft.rfft(pressure), n)


def feasible(pressure):
    """The nearest pressure without tension that carries the load, by bisection."""
    low, high = pressure.min() - load, pressure.max()
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if np.maximum(pressure - middle, 0).mean() > load else (low, middle)
    return np.maximum(pressure - low, 0)


steps = [np.full(n, load)]
for _ in range(400):
    gradient = displacement(steps[-1]) - height
    steps.append(feasible(steps[-1] - gradient * np.pi * modulus / 2))

np.save("height.npy", height)
np.save("steps.npy", steps)
subprocess.run(
    f"asperity inspect --height height.npy --size 1 --modulus {modulus} --mean-pressure {load} "
    "--record projected_gradient.rrd steps.npy",
    shell=True,
)
