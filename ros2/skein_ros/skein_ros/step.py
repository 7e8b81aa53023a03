"""Calls the functions of libskein_step.so (skein_ros/step.h), if this process has loaded it."""
import ctypes
import os

_PLAN = ctypes.CFUNCTYPE(None, ctypes.c_void_p)
_kept = []  # callbacks that the library may call


def library():
    """The functions of the library; None: it is not loaded."""
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
    """Whether this process is a member of the lock-step."""
    functions = library()
    return functions is not None and functions.skein_ros_is_member()


def before_answer(plan):
    """Calls `plan()` at the end of each step from now on. An exception ends the process; the log has its text."""
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
    """Sleeps until a simulated time [ns]. Returns whether the run goes on then."""
    return library().skein_ros_sleep_until(until_ns)


def uav():
    """The name of the UAV that this program flies."""
    name = os.environ.get("SKEIN_UAV")
    if not name:
        raise RuntimeError("SKEIN_UAV is not set: start this planner with "
                           "skein run --planner UAV=ros:PACKAGE/EXECUTABLE")
    return name
