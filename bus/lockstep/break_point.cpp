#include "bus/lockstep/break_point.hpp"

#include <csignal>
#include <optional>

#include "core/types.hpp"
#include "process/health/debugger_wait.hpp"

namespace skein::bus {
namespace {

struct BreakPoint {
  std::optional<double> seconds;
  std::optional<Tick> before;  ///< tick of the previous step: the scenario determines the length of a step
};

BreakPoint& the_one() {
  static BreakPoint point;
  return point;
}

}  // namespace

void set_break_at(double seconds) { the_one().seconds = seconds; }

void break_if_due(Tick tick) {
  BreakPoint& point = the_one();
  if (!point.seconds) return;
  const Tick next = tick + (tick - point.before.value_or(tick));
  point.before = tick;
  if (static_cast<double>(next) < *point.seconds * static_cast<double>(kTicksPerSecond)) return;
  point.seconds.reset();
  if (is_debugged()) std::raise(SIGTRAP);
}

}  // namespace skein::bus
