"""Solve a contact, or go through a history, with another code: the name of the code, and a task as JSON, are the arguments.

The task holds its kind, the file of the heights, the file for the answer, and the tolerance. The cell has the length 1, and the contact modulus is 1
unless another is told. A contact also has a mean pressure and whether its boundary is free. A solid that creeps has the relaxed contact modulus, the
modulus and the time of an element that relaxes, and the duration and the number of the steps under a mean pressure. An attraction has the work of
adhesion, the range and a list of mean gaps. Friction has its coefficient, Poisson's ratio, and a list of mean pressures and pulls along x.

The answer is the pressure, less an attraction, at the end; of a contact with friction, the traction along x. What is printed is JSON: the version
and the seconds of the solve, or why there is none.
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


def adhesion_loop(height, work, reach, gaps, tolerance):
    adhesion, topography = import_module("Adhesion.System"), import_module("SurfaceTopography")
    substrate = import_module("ContactMechanics").PeriodicFFTElasticHalfSpace(height.shape, 1.0, (1.0, 1.0))
    attraction = import_module("Adhesion.Interactions").Exponential(work, reach)
    system = adhesion.BoundedSmoothContactSystem(substrate, attraction, topography.Topography(height, (1.0, 1.0)))
    # of the solvers behind this package, the one that is fastest here
    solve = import_module("NuMPI.Optimization").CCGWithoutRestart.constrained_conjugate_gradients
    force = tolerance * work / reach / height.size
    gap = (-height).clip(-height.max())
    for mean in gaps:
        start = (gap - gap.mean() + mean).clip(0.0)
        result = solve(
            system.primal_objective(0.0, gradient=True),
            system.primal_hessian_product,
            (start * (mean / start.mean())).ravel(),
            mean_val=mean,
            gtol=force,
            maxiter=100_000,
        )
        if not result.success:
            raise RuntimeError(f"at the mean gap {mean:g}: {result.message}")
        gap = result.x.reshape(height.shape)
    # the pressure but for its mean, which follows where nothing touches: there it is the attraction
    elastic = -substrate.evaluate_force(gap + height) * height.size
    attracted = -work / reach * import_module("numpy").exp(-gap / reach)
    is_open = gap > 0.0
    return elastic + (attracted - elastic)[is_open].mean()


def aspher_slip(height, friction, poisson, path, tolerance):
    code = import_module("aspher")
    solver = code.FrictionSolver(
        grid_size=height.shape[0], E_star=1.0, nu=poisson, model=code.CoulombFriction(mu=friction)
    )
    solver.set_gap(-height)
    for pressure, pull in path:
        step = solver.step(
            p_bar=pressure, q_bar=(pull, 0.0), tol_normal=tolerance, tol_tangential=max(tolerance, 1e-5), max_iter=100_000
        )
        if not step.converged:
            raise RuntimeError(f"at the mean pressure {pressure:g} and the pull {pull:g}: {step.status_reason}")
    return step.qx


CODES = {
    "contact": {
        "tamaas": ("tamaas", tamaas),
        "contact-mechanics": ("ContactMechanics", contact_mechanics),
        "aspher": ("aspher", aspher),
        "aspher-mixed": ("aspher", aspher_mixed),
    },
    "creep": {"tamaas": ("tamaas", tamaas_creep)},
    "adhesion": {"adhesion": ("Adhesion", adhesion_loop)},
    "slip": {"aspher": ("aspher", aspher_slip)},
}


def answer():
    files = [TASK.pop(name) for name in ("height", "out")]
    package, solve = CODES[TASK.pop("kind")][NAME]
    try:
        np = import_module("numpy")
        version = metadata.version(package)
        import_module(package)
        height = np.ascontiguousarray(np.load(files[0]))
        start = time.perf_counter()
        traction = solve(height, **TASK)
        seconds = time.perf_counter() - start
        np.save(files[1], np.asarray(traction, dtype=float).reshape(height.shape))
        return {"version": version, "seconds": seconds}
    except metadata.PackageNotFoundError:
        return {"skipped": f"{package} is not installed"}
    except ModuleNotFoundError as error:
        return {"skipped": f"{error.name} is not installed"}
    except Exception as error:
        return {"skipped": " ".join(str(error).split()) or type(error).__name__}


print("\n" + json.dumps(answer()))
