#include "results/uav_state.hpp"

namespace skein::results {

std::string uav_state(const Json& uav, const Json& faults) {
  const Json alive = value_or(uav, "alive", nullptr);
  if (!alive.is_boolean()) return "-";
  if (!alive.get<bool>()) return "collided";
  if (value_or(uav, "program_lost", false).get<bool>()) return "lost";
  if (!faults.is_array()) return "alive";
  for (const Json& fault : faults) {
    if (text_in(fault, "target") != text_in(uav, "name")) continue;
    const bool acts =
        value_or(fault, "began_step", nullptr).is_number() && !value_or(fault, "ended_step", nullptr).is_number();
    if (acts && text_in(fault, "kind") == "kill") return "killed";
    if (acts && text_in(fault, "kind") == "pause") return "paused";
  }
  return "alive";
}

}  // namespace skein::results
