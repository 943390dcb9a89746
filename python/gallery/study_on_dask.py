"""A study of thirty seeds, two Hurst exponents and five loads runs on the workers of Dask.

Each point is a mean over the seeds, and the bars are standard deviations. The area over the load falls slowly while the load grows, and lies above
Persson's theory until the contact is nearly full. The table is the same to the last bit for any number of workers.
"""

import warnings

import matplotlib.pyplot as plt
import numpy as np
from distributed import Client, LocalCluster

import asperity as asp

warnings.simplefilter("ignore", asp.AsperityWarning)  # the largest load strains the solid a lot

LOADS = [0.01, 0.03, 0.1, 0.3, 1.0]
STUDY = asp.Study(
    surface={"spectrum": {"hurst": [0.3, 0.8], "rolloff_wavelength": 0.25, "short_cutoff": 0.01, "rms_gradient": 0.1}, "seed": "1-30"},
    grid={"points": 4096, "size": 1.0},
    load={"reduced_pressure": LOADS},
)


def draw(table):
    figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    for hurst, marker in ((0.3, "o"), (0.8, "s")):
        rows = [(table["hurst"] == hurst) & (table["load.reduced-pressure"] == load) for load in LOADS]
        means, spreads = [np.array([each(table["kappa"][row]) for row in rows]) for each in (np.mean, np.std)]
        axes.errorbar(LOADS, means, spreads, fmt=marker, mfc="none", capsize=3, label=f"Hurst exponent {hurst}, 30 seeds")
        print(f"Hurst exponent {hurst}: area over load at p* = 0.01 is {means[0]:.3f} ± {spreads[0]:.3f}")
    loads = np.geomspace(LOADS[0], LOADS[-1])
    axes.plot(loads, asp.theory.persson_relative_area(loads) / loads, color="0.3", label=r"Persson, $\mathrm{erf}(\sqrt{2}\,p^*)/p^*$")
    axes.set(xscale="log", xlabel=r"reduced pressure $p^* = \bar p/(E^* \bar g)$", ylabel=r"area over load $\kappa = (A/A_0)/p^*$")
    axes.legend()
    figure.savefig("study_on_dask.png", dpi=100)


if __name__ == "__main__":
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        table = asp.study(STUDY, client=client)
    print(f"{len(table)} rows, {np.sum(table['status'] == 'converged')} converged")
    draw(table)
