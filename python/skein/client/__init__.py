"""Your own programs in a fleet: in place of a UAV's software (`--planner UAV=exec:'python3 my_uav.py'`), at the ground
station (`gcs=exec:...`), or only as a listener.

    from skein.client import Client

    with Client() as uav:
        for step in uav:
            uav.fly_to([0, 0, 5])

It uses the lock-step client of Skein's own programs, with either DDS vendor (docs/how-to-python.md, docs/lockstep.md).
"""

from .listener import FlyingFleet, Heard, Listener, flying_fleet
from .member import Client, LostError
from .messages import Message, decode, define, encode, new
from .step import Step
from .words import Neighbour

__all__ = ["Client", "FlyingFleet", "Heard", "Listener", "LostError", "Message", "Neighbour", "Step", "decode",
           "define", "encode", "flying_fleet", "new"]
