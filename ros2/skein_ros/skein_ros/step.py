"""libskein_step.so, if this process has loaded it (skein_ros/step.h)."""
import ctypes
import os

_PLAN = ctypes.CFUNCTYPE(None, ctypes.c_void_p)
_kept = []  # callbacks that the library may call


def library():
    """Its functions; None: it is not loaded."""
    functions = ctypes.CDLL(None)
    try:
        functions.skein_ros_is_member.restype = ctypes.c_bool
    except AttributeError:
        return None
    functions.skein_ros_before_answer.argtypes = [_PLAN, ctypes.c_void_p]
    functions.skein_ros_sleep_until.argtypes = [ctypes.c_int64]
    functions.skein_ros_sleep_until.restype = ctypes.c_bool
    functions.skein_ros_fail.argtypes = [ctypes.c_char_p]
    return functions


def is_member():
    """Whether this process steps with a fleet."""
    functions = library()
    return functions is not None and functions.skein_ros_is_member()


def before_answer(plan):
    """`plan()` is called at the end of each step. An exception ends the process, and its text is in the log."""
    functions = library()

    def call(_):
        try:
            plan()
        except BaseException as error:  # pylint: disable=broad-except
            import traceback
            traceback.print_exc()
            functions.skein_ros_fail(f"the planner threw: {error}".encode())

    _kept.append(_PLAN(call))
    functions.skein_ros_before_answer(_kept[-1], None)


def sleep_until(until_ns):
    """Sleeps on simulated time."""
    return library().skein_ros_sleep_until(until_ns)


def uav():
    """The UAV that this program flies."""
    name = os.environ.get("SKEIN_UAV")
    if not name:
        raise RuntimeError("SKEIN_UAV is not set: start this planner with "
                           "skein run --planner UAV=ros:PACKAGE/EXECUTABLE")
    return name
