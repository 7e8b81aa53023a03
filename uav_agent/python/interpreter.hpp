// The interpreter of this process, and the words of skein.planner in it. It is started for the first planner and never
// ended: what planners leave behind may be asked for until the process ends.
// Threads: the one that started it, which holds Python's lock for good.
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace skein::agent::python {

namespace py = pybind11;

/// Classes of the package.
struct Words {
  explicit Words(const py::module_& planner);

  py::object agent_config, beam_scan, camera, firing, fleet_member, flight_config, flight_state, gimbal_command,
      gimbal_state, goal, gone_error, hold, key_frame, link_quality, oriented_box, outcome, path, peer, planner_input,
      planner_output, radio_message, scan, setpoint, state, tracking_state, trajectory_command, vehicle, waypoint;
};

struct Interpreter {
  py::module_ embedded;  ///< skein._embedded
  Words words;
};

/// @param package_folder  see Order. @throws InputError when the package or NumPy is not there, at the first call.
const Interpreter& interpreter(const std::filesystem::path& package_folder = {});

inline const Words& words() { return interpreter().words; }

/// The exception that is being handled, with the user's traceback.
std::string explanation(py::error_already_set& error);
/// skein._embedded.Wrong: its text says all. @returns whether it is one
bool is_wrong_input(const py::error_already_set& error);

}  // namespace skein::agent::python
