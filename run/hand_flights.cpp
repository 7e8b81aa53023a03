#include "run/hand_flights.hpp"

#include <algorithm>

#include "core/messages/hand_command.hpp"
#include "core/planners/hand_spec.hpp"
#include "core/text/suggestion.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

/// The planner that executes the commands of the program that steps the fleet (uav_agent/planners/learner/learner.cpp).
constexpr const char* kLearner = "learner";

UavPlanner hand_repeated(const UavPlanner& planner, const std::filesystem::path& file) {
  std::vector<std::string> parameters = *hand_parameters(planner.spec);
  UavPlanner again = planner;
  again.spec = std::string(kHandPlanner) + ":";
  if (!parameters.empty() || file.string().find('=') != std::string::npos) again.spec += "file=";
  again.spec += file.string();
  for (const std::string& parameter : parameters) again.spec += "," + parameter;
  return again;
}

}  // namespace

std::vector<std::string> flown_by_hand(const std::vector<UavPlanner>& planners) {
  std::vector<std::string> uavs;
  for (const UavPlanner& planner : planners) {
    if (wants_hands(planner.spec)) uavs.push_back(planner.uav);
  }
  return uavs;
}

void check_hands(const std::vector<UavPlanner>& planners, bool watched, bool stepped) {
  const auto learner = std::ranges::find_if(
      planners, [](const UavPlanner& planner) { return planner.spec.substr(0, planner.spec.find(':')) == kLearner; });
  if (learner != planners.end() && !stepped) {
    throw InputError("--planner " + learner->uav + "=" + kLearner + ": a program must step the fleet and say what " +
                     learner->uav + " does, as skein.Fleet does in Python (docs/how-to-python.md)");
  }
  const std::vector<std::string> uavs = flown_by_hand(planners);
  if (uavs.empty() || watched) return;
  const std::string& uav = uavs.front();
  throw InputError(
      "--planner " + uav + "=" + kHandPlanner + ": a person must fly " + joined(uavs) +
      " on the page of `skein run --view`; to repeat an earlier flight by hand, name the file of that run: "
      "--planner " +
      uav + "=" + kHandPlanner + ":RUN/hand-" + uav + ".csv");
}

std::string planners_repeated(const std::string& text, const std::vector<std::string>& fleet,
                              const std::function<std::filesystem::path(const std::string& uav)>& file_of) {
  return planners_rewritten(text, fleet, [&](const UavPlanner& planner) {
    return wants_hands(planner.spec) ? hand_repeated(planner, file_of(planner.uav)) : planner;
  });
}

}  // namespace skein::cli
