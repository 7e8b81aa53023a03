#include "sim_server/wait_teller.hpp"

#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>

#include "core/suggestion.hpp"

namespace skein::sim {

void WaitTeller::send(const std::vector<std::string>& names, WaitNotice::Clock::time_point now) {
  told_ = now;
  const double waited_s = notice_.waited_s(now);
  const bool due = notice_.due(now).has_value();
  if (due) spdlog::info("waiting for {} {} ({:.0f} s)", joined(names), what_, waited_s);
  status_.send({{"type", "waiting_for"}, {"members", names}, {"what", what_}, {"seconds", waited_s}, {"due", due}});
}

}  // namespace skein::sim
