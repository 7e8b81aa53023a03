#include <algorithm>
#include <string_view>

#include "report/figures.hpp"

namespace skein::report {
namespace {

/// The kind of an activity: the first entry with which its words begin. The words are those of Skein's on-board
/// software (uav_agent/onboard/activity.cpp).
constexpr std::pair<std::string_view, TimeUse> kBegins[] = {{"on the ground", TimeUse::takes_off},
                                                            {"takes off", TimeUse::takes_off},
                                                            {"waits to be shown", TimeUse::waits},
                                                            {"flies to a goal", TimeUse::flies},
                                                            {"flies along", TimeUse::flies},
                                                            {"flies to a set-point", TimeUse::flies},
                                                            {"sends commands", TimeUse::flies},
                                                            {"rests at its goal", TimeUse::rests},
                                                            {"holds its place", TimeUse::rests},
                                                            {"has no goal", TimeUse::rests},
                                                            {"shows ", TimeUse::shows},
                                                            {"looks ", TimeUse::recovers},
                                                            {"flies nearer", TimeUse::recovers},
                                                            {"tries ", TimeUse::recovers},
                                                            {"climbs to see more", TimeUse::recovers},
                                                            {"flies back", TimeUse::recovers},
                                                            {"makes room", TimeUse::recovers},
                                                            {"stands: ", TimeUse::stands},
                                                            {"returns", TimeUse::homing},
                                                            {"delivers", TimeUse::homing},
                                                            {"waits for a link", TimeUse::homing},
                                                            {"stays ", TimeUse::homing},
                                                            {"flies to its landing", TimeUse::homing}};

TimeUse use_of(const Activity& activity) {
  if (!activity.waits_for.empty()) return TimeUse::waits;
  for (const auto& [words, use] : kBegins) {
    if (activity.mode.starts_with(words)) return use;
  }
  return TimeUse::other;
}

double common_s(const Spans& spans, double from_s, double until_s) {
  double sum_s = 0.0;
  for (const Span& span : spans) {
    sum_s += std::max(0.0, std::min(span.until_s, until_s) - std::max(span.from_s, from_s));
  }
  return sum_s;
}

}  // namespace

std::vector<std::optional<TimeBudget>> time_budgets(const results::RunRecord& run, const std::vector<Lane>& lanes) {
  std::vector<std::optional<TimeBudget>> budgets(run.uavs.size());
  const auto activities = run.by_uav(run.activities);
  for (std::size_t uav = 0; uav < budgets.size(); ++uav) {
    const std::vector<const results::ActivityRow*>& said = activities[uav];
    if (said.empty()) continue;
    TimeBudget& budget = budgets[uav].emplace();
    for (std::size_t i = 0; i < said.size(); ++i) {
      const double until_s = i + 1 < said.size() ? said[i + 1]->time_s : run.end_s;
      const auto use = static_cast<std::size_t>(use_of(said[i]->activity));
      budget[use] += common_s(lanes[uav].taking_part, said[i]->time_s, until_s);
    }
  }
  return budgets;
}

}  // namespace skein::report
