"""The main function of a planner in Python."""
import os
import sys

import rclpy
from rclpy.clock import Clock
from rclpy.executors import ExternalShutdownException

from skein_ros import step

_ENTERED = "SKEIN_STEP_ENTERED"


def _step_library():
    for prefix in os.environ.get("AMENT_PREFIX_PATH", "").split(":"):
        path = os.path.join(prefix, "lib", "libskein_step.so")
        if os.path.exists(path):
            return path
    raise RuntimeError("AMENT_PREFIX_PATH has no package skein_ros")


def enter_step():
    """Starts this program again with libskein_step.so, if the launcher has not loaded it. From then on, a sleep on a
    clock of ROS takes simulated time."""
    if step.library() is None and os.environ.get("SKEIN_UAV"):
        if os.environ.get(_ENTERED):
            sys.exit(f"cannot load {_step_library()} by LD_PRELOAD")
        os.environ["LD_PRELOAD"] = " ".join(filter(None, [_step_library(), os.environ.get("LD_PRELOAD")]))
        os.environ[_ENTERED] = "1"
        os.execv(sys.executable, [sys.executable, *sys.orig_argv[1:]])
    if step.is_member():
        Clock.sleep_until = lambda _self, until, context=None: step.sleep_until(until.nanoseconds)


def run(make, args=None):
    """Spins the node that `make()` returns, until the run is over."""
    enter_step()
    rclpy.init(args=args)
    node = make()
    try:
        rclpy.spin(node)
    except (ExternalShutdownException, KeyboardInterrupt):
        pass
    except Exception:  # pylint: disable=broad-except
        if rclpy.ok():  # otherwise the run has ended during a call of rclpy
            raise
    node.destroy_node()
    rclpy.try_shutdown()
