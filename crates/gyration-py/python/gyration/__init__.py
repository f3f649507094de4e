"""Simulates bodies that move by homogeneous deformations, p = p0 + P (X - X0), and meet force fields of supports.

    >>> import gyration
    >>> scene = gyration.Scene.gallery("dice").edit({"body.die.velocity": [1, 0, 0]})
    >>> recording = scene.run()
    >>> recording.outcome
    'at_rest'

Lengths are in m, masses in kg, times in s, forces in N, angles in rad. Vectors have 3 entries, matrices 3 x 3, row by row.

==================  =====================================================================
:class:`Scene`       what to run: from a file, a dictionary or the gallery; edited by dotted key
:class:`Recording`   what a run left: arrays, xarray, pandas, pictures, a 3-D view
:class:`Simulation`  a run stepped by hand: look, apply forces, change drives
:class:`Batch`       many of them at once, their states in one array a quantity
:func:`run_many`     many scenes on all cores, and what they ended with
:func:`study`        thousands of runs over parameters, into one table; on many machines
:func:`modes`        rest states and the small motions about them, of bodies and of systems
:func:`bands`        waves through lattices: frequencies, decay rates, speeds, shapes
:func:`continuum`    a lattice as a continuum: matrices, moduli, where it ends
:func:`orbit`        a motion that repeats itself: period, start, multipliers
:func:`fields`       many bodies as a medium: density, momenta, stresses of a recording
:func:`spectrum`     the waves in which a ring moves: energies, frequencies, widths
:func:`resistance`   forces on a body in a viscous fluid
:func:`sensitivities` derivatives of what is recorded by any number of a scene
:func:`calibrate`    numbers of the laws from measurements, with their errors
==================  =====================================================================
"""

from gyration._errors import (
    ArgumentError,
    Diagnostic,
    Error,
    FileError,
    PlotError,
    RunError,
    SceneError,
    StudyError,
)
from gyration._gyration import (
    Batch,
    Fit,
    Picture,
    Recording,
    Runs,
    Scene,
    Simulation,
    Table,
    __version__,
    bands,
    calibrate,
    continuum,
    fields,
    modes,
    orbit,
    resistance,
    run_many,
    scenes,
    sensitivities,
    simulate,
    spectrum,
    studies,
)
from gyration._study import study

__all__ = [
    "ArgumentError",
    "Batch",
    "Diagnostic",
    "Error",
    "FileError",
    "Fit",
    "Picture",
    "PlotError",
    "Recording",
    "RunError",
    "Runs",
    "Scene",
    "SceneError",
    "Simulation",
    "StudyError",
    "Table",
    "__version__",
    "bands",
    "calibrate",
    "continuum",
    "fields",
    "modes",
    "orbit",
    "resistance",
    "run_many",
    "scenes",
    "sensitivities",
    "simulate",
    "spectrum",
    "studies",
    "study",
]
