// The Python interpreter of this process, and the classes of skein.planner in it. It is started for the first planner
// and never ended, because objects of planners may be used until the process ends.
// Threads: the one that started it, which never releases Python's lock (GIL).
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace skein::agent::python {

namespace py = pybind11;

/// Classes of the module skein.planner.
struct Words {
  explicit Words(const py::module_& planner);

  py::object agent_config, beam_scan, camera, firing, fleet_member, flight_config, flight_state, gimbal_command,
      gimbal_state, goal, gone_error, hold, key_frame, link_quality, oriented_box, outcome, path, peer, planner_input,
      planner_output, radio_message, scan, setpoint, stake, state, tracking_state, trajectory_command, vehicle,
      waypoint;
};

struct Interpreter {
  py::module_ embedded;  ///< skein._embedded
  Words words;
};

/// Starts the interpreter at the first call. @param package_folder  see Order.
/// @throws InputError if the package `skein` or NumPy is missing, at the first call.
const Interpreter& interpreter(const std::filesystem::path& package_folder = {});

inline const Words& words() { return interpreter().words; }

/// The text of an exception, with the traceback of the user's code.
std::string explanation(py::error_already_set& error);
/// Whether it is a skein._embedded.Wrong: its text is complete without a traceback.
bool is_wrong_input(const py::error_already_set& error);

}  // namespace skein::agent::python
