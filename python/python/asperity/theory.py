"""Closed forms to compare with: Hertz, Westergaard, Persson, Greenwood and Williamson.

Compression is positive, and lengths and moduli are in any one set of units. Numbers or arrays go in and come out.
"""

from asperity._asperity import (
    PowerLaw,
    Westergaard,
    counting_excess,
    cylinder,
    exact,
    greenwood_williamson,
    persson_pressure_density,
    persson_relative_area,
    sphere,
)

__all__ = [
    "PowerLaw",
    "Westergaard",
    "counting_excess",
    "cylinder",
    "exact",
    "greenwood_williamson",
    "persson_pressure_density",
    "persson_relative_area",
    "sphere",
]
