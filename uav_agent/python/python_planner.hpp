// Planners written in Python, which run inside the agent. Python itself is in a separate shared object, which is loaded
// for the first such planner: an agent without one neither links Python nor starts it
// (docs/decisions/0033-planners-in-python.md).
// Threads: one, for all planners of a process.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "uav_agent/api/planner.hpp"

namespace skein::agent {

/// Parameters of such a planner in addition to its AgentConfig.
struct PythonSurroundings {
  std::uint64_t seed = 0;                      ///< of the run
  std::vector<std::string> radio_topics = {};  ///< topics on which this UAV may send
  std::optional<double> debug_from_s = {};     ///< pdb uses this program's terminal from this simulated time on
};

/// @param spec  as in core/planners/python_spec.hpp. @returns nullptr if it names a planner of another kind.
/// @throws InputError if Python is not installed, and for errors in the file, the class and the parameters; for an
///   exception of the user's code, the text contains the traceback.
std::unique_ptr<Planner> make_python_planner(const std::string& spec, const AgentConfig& agent,
                                             const PythonSurroundings& surroundings);

}  // namespace skein::agent
