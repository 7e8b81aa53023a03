#include "sim_server/wait_teller.hpp"

#include <spdlog/spdlog.h>

#include "core/text/suggestion.hpp"
#include "process/status/status_lines.hpp"

namespace skein::sim {

void WaitTeller::send(const std::vector<AwaitedMember>& awaited, WaitNotice::Clock::time_point now) {
  told_ = now;
  std::vector<std::string> names, missing;
  for (const AwaitedMember& one : awaited) {
    names.push_back(one.name);
    missing.push_back(one.missing);
  }
  const double waited_s = notice_.waited_s(now);
  const bool due = notice_.due(now).has_value();
  if (due)
    spdlog::info("waiting for {} {} ({:.0f} s): {}", joined_first(names), what_, waited_s, joined_first(missing));
  status_.send(status::line_json(status::WaitingFor{
      .members = std::move(names), .missing = std::move(missing), .what = what_, .seconds = waited_s, .due = due}));
}

}  // namespace skein::sim
