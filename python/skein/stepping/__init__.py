"""Fleets that your program advances step by step: for learning, and for planners that search by simulation
(docs/how-to-python.md)."""

from . import spaces
from .fleet import Fleet
from .gym_env import GymEnv, gym_env
from .truth import Truth
from .vector import FleetVector, vector_env

__all__ = ["Fleet", "FleetVector", "GymEnv", "Truth", "gym_env", "spaces", "vector_env"]
