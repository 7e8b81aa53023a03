// Planners written in Python, flown inside the agent. Python itself is in a shared object of its own, which is loaded
// for the first of them: an agent that flies none neither links Python nor starts it
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

/// Parameters of such a planner beside its AgentConfig.
struct PythonSurroundings {
  std::uint64_t seed = 0;                      ///< of the run
  std::vector<std::string> radio_topics = {};  ///< that this UAV may send on
  std::optional<double> debug_from_s = {};     ///< pdb has this program's terminal, from that simulated time on
};

/// @param spec  as core/planners/python_spec.hpp has it. @returns nullptr: it names a planner of another kind.
/// @throws InputError when Python is not installed, and for all that is wrong in file, class and parameters: an
///   exception of the user's code is one, with its traceback.
std::unique_ptr<Planner> make_python_planner(const std::string& spec, const AgentConfig& agent,
                                             const PythonSurroundings& surroundings);

}  // namespace skein::agent
