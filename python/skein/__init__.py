"""Experiments with Skein from Python: fly fleets, read their results as arrays, plot them for papers, and step fleets
from a program.

    import skein

    run = skein.run("towers", planner="kios", seed=3, one_process=True)
    run.score, run.captures["q_blur"], run.frame("losses")

docs/how-to-python.md is the guide. The package needs only NumPy; `frame()` also needs pandas, `skein.plots` matplotlib.
"""

from . import plots
from .columns import RUN_TABLES, STUDY_TABLES, Column, Table
from .errors import (CheckError, DamagedError, DependencyError, Error, InputError, Interrupted, MissingError,
                     ProcessError)
from .launch import find_launcher
from .run import Run, run
from .stepping import Fleet, FleetVector, GymEnv, Truth, gym_env, spaces, vector_env
from .study import Study, compare, contest

__all__ = [
    "CheckError", "Column", "DamagedError", "DependencyError", "Error", "Fleet", "FleetVector", "GymEnv", "InputError",
    "Interrupted", "MissingError", "ProcessError", "RUN_TABLES", "Run", "STUDY_TABLES", "Study", "Table", "Truth",
    "compare", "contest", "find_launcher", "gym_env", "plots", "run", "spaces", "vector_env"]
