#include "cli/study/pairs.hpp"

#include "core/text.hpp"

namespace skein::cli {
namespace {

/// Of one seed: in a scene, or in all of them together.
std::optional<double> score_of(const Study& study, std::size_t planner, std::optional<std::size_t> scenario,
                               std::uint64_t seed) {
  const auto score = [](const FlightFigures& figures) { return figures.score; };
  if (!scenario) return total_of(study, planner, seed, score);
  for (const FlightEntry* flight : study.cell(planner, *scenario)) {
    if (flight->seed == seed) return flight->figures->score;
  }
  return std::nullopt;
}

PlannerPair pair_of(const Study& study, std::size_t first, std::size_t second, std::optional<std::size_t> scenario) {
  PlannerPair pair{first, second, scenario, {}, {}, {}, {}};
  for (const std::uint64_t seed : study.seeds) {
    const auto a = score_of(study, first, scenario, seed), b = score_of(study, second, scenario, seed);
    if (a && b) pair.differences.emplace_back(seed, *a - *b);
  }
  const std::vector<double> values = pair.values();
  if (values.empty()) return pair;
  pair.median = spread_of(values).median;
  if (values.size() < kFewestPairs) return pair;
  pair.interval = median_interval(values, study.planners[first] + "\n" + study.planners[second] + "\n" +
                                              (scenario ? study.scenarios[*scenario] : ""));
  pair.test = signed_rank_test(values);
  return pair;
}

}  // namespace

std::vector<double> PlannerPair::values() const {
  std::vector<double> values;
  for (const auto& [seed, difference] : differences) values.push_back(difference);
  return values;
}

std::vector<PlannerPair> planner_pairs(const Study& study) {
  std::vector<std::optional<std::size_t>> where;
  for (std::size_t s = 0; s < study.scenarios.size(); ++s) where.emplace_back(s);
  if (study.scenarios.size() > 1) where.emplace_back(std::nullopt);
  std::vector<PlannerPair> pairs;
  for (const auto& scenario : where) {
    for (std::size_t first = 0; first < study.planners.size(); ++first) {
      for (std::size_t second = first + 1; second < study.planners.size(); ++second) {
        pairs.push_back(pair_of(study, first, second, scenario));
      }
    }
  }
  return pairs;
}

std::string p_text(const std::optional<SignedRank>& test) {
  if (!test) return "";
  return test->p < 0.001 ? "< 0.001" : fixed_at_most(test->p, test->p < 0.1 ? 4 : 3);
}

}  // namespace skein::cli
