"""Solve a contact with another code: the name of the code, and a task as JSON, are the arguments.

The task holds the file of the heights, the file for the pressures, the mean pressure, whether the boundary is free, and the tolerance.
The cell has the length 1 and the contact modulus 1. Of a solid that creeps it also holds the relaxed contact modulus, the modulus and the time of an
element that relaxes, and the duration and the number of the steps. The answer is JSON: the version and the seconds of the solve, or why there is none.
"""

import json
import sys
import time
from importlib import import_module, metadata

NAME, TASK = sys.argv[1], json.loads(sys.argv[2])


def tamaas(height, pressure, free, tolerance):
    tm = import_module("tamaas")
    if free:
        raise NotImplementedError("it has periodic boundaries only")
    model = tm.ModelFactory.createModel(tm.model_type.basic_2d, [1.0, 1.0], list(height.shape))
    model.E, model.nu = 1.0, 0.0
    solver = tm.PolonskyKeerRey(model, height, tolerance)
    solver.max_iter = 100_000
    solver.solve(pressure)
    return model.traction


def contact_mechanics(height, pressure, free, tolerance):
    cm = import_module("ContactMechanics")
    topography = import_module("SurfaceTopography")
    kind = cm.FreeFFTElasticHalfSpace if free else cm.PeriodicFFTElasticHalfSpace
    system = cm.make_system(
        interface="hardwall",
        substrate=kind(height.shape, 1.0, (1.0, 1.0)),
        surface=topography.Topography(height, (1.0, 1.0)),
    )
    result = system.minimize_proxy(external_force=pressure, pentol=tolerance * height.std(), maxiter=100_000)
    ny, nx = height.shape
    return result.jac[:ny, :nx] * height.size


def aspher(height, pressure, free, tolerance, precision="double"):
    return import_module("aspher").solve_nested(
        grid_size=height.shape[0],
        gap=-height,
        p_nominal=pressure,
        coarsest=64,
        backend="h2" if free else "periodic",
        tol=tolerance,
        active_set=free,
        precision=precision,
    ).pressure


def aspher_mixed(height, pressure, free, tolerance):
    if free:
        raise NotImplementedError("it has no mixed precision at free boundaries")
    return aspher(height, pressure, free, tolerance, precision="float_then_double")


def tamaas_creep(height, pressure, tolerance, relaxed, element, time, duration, steps):
    tm = import_module("tamaas")
    model = tm.ModelFactory.createModel(tm.model_type.basic_2d, [1.0, 1.0], list(height.shape))
    model.E, model.nu = relaxed, 0.0
    # of contact moduli, the shear moduli are a half, as Poisson's ratio is 0
    solver = tm.MaxwellViscoelastic(model, height, tolerance, duration / steps, [element / 2], [time])
    solver.max_iter = 100_000
    for _ in range(steps):
        solver.solve(pressure)
    return model.traction


CREEP = {"tamaas": ("tamaas", tamaas_creep)}
CODES = {
    "tamaas": ("tamaas", tamaas),
    "contact-mechanics": ("ContactMechanics", contact_mechanics),
    "aspher": ("aspher", aspher),
    "aspher-mixed": ("aspher", aspher_mixed),
}


def answer():
    files = [TASK.pop(name) for name in ("height", "out")]
    package, solve = (CREEP if "steps" in TASK else CODES)[NAME]
    try:
        np = import_module("numpy")
        version = metadata.version(package)
        import_module(package)
        height = np.ascontiguousarray(np.load(files[0]))
        start = time.perf_counter()
        pressure = solve(height, **TASK)
        seconds = time.perf_counter() - start
        np.save(files[1], np.asarray(pressure, dtype=float).reshape(height.shape))
        return {"version": version, "seconds": seconds}
    except metadata.PackageNotFoundError:
        return {"skipped": f"{package} is not installed"}
    except ModuleNotFoundError as error:
        return {"skipped": f"{error.name} is not installed"}
    except Exception as error:
        return {"skipped": " ".join(str(error).split()) or type(error).__name__}


print("\n" + json.dumps(answer()))
