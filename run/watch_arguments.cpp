#include "run/watch_arguments.hpp"

#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "run/hand_flights.hpp"
#include "view/time_order.hpp"

namespace skein::cli {

std::vector<std::string> watch_arguments(const FleetPlan& plan) {
  const std::vector<std::string> by_hand = flown_by_hand(plan.planners);
  const double speed = by_hand.empty() ? view::kUsualSpeed : view::kHandSpeed;
  std::vector<std::string> arguments = {"--watch", plan.options.view.speed.value_or(shortest(speed))};
  if (const auto& pause_at_s = plan.options.view.pause_at_s) {
    arguments.insert(arguments.end(), {"--watch-pause-at", shortest(*pause_at_s)});
  }
  if (plan.options.attainable) arguments.emplace_back("--watch-losses");
  if (!by_hand.empty()) arguments.insert(arguments.end(), {"--by-hand", joined(by_hand, ",")});
  return arguments;
}

std::vector<std::string> view_arguments(const FleetPlan& plan) {
  const auto& [listener, key, script] = *plan.watched;
  return {"--view-fd",     std::to_string(kViewFd),
          "--view-key",    key,
          "--view-script", script,
          "--view-title",  plan.scenario.name + " by " + plan.options.planner};
}

}  // namespace skein::cli
