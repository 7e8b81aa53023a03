#include "cli/study/pairs.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <ostream>

#include <spdlog/fmt/fmt.h>

#include "cli/study/columns.hpp"
#include "core/text/text.hpp"
#include "report/html.hpp"

namespace skein::cli {
namespace {

constexpr const char* kScore = "score";
constexpr std::size_t kMostPrinted = 30;  ///< rows of print_pairs(), unless there are more pairs over all scenes
constexpr std::size_t kLongestPair = 48;  ///< of the planners and the scene of such a row, in characters
constexpr std::size_t kFewestForFive =
    6;  ///< pairs with which p can be below 0.05: with n of them, p is at least 2 / 2^n

/// A figure of one flight; nullopt: not known.
using Figure = std::function<std::optional<double>(const FlightEntry&)>;

/// Values by seed: in one scene, or sums over all scenes.
std::map<std::uint64_t, double> values_of(const Study& study, const Figure& figure, std::size_t planner,
                                          std::optional<std::size_t> scenario) {
  std::map<std::uint64_t, double> values;
  if (scenario) {
    for (const FlightEntry* flight : study.cell(planner, *scenario)) {
      if (const auto value = figure(*flight)) values.emplace(flight->seed, *value);
    }
  } else {
    for (const std::uint64_t seed : study.seeds) {
      if (const auto value = total_of(study, planner, seed, figure)) values.emplace(seed, *value);
    }
  }
  return values;
}

PlannerPair pair_of(const Study& study, const std::string& name, const Figure& figure, std::size_t first,
                    std::size_t second, std::optional<std::size_t> scenario) {
  PlannerPair pair{name, first, second, scenario, {}, {}, {}, {}, {}};
  const bool is_score = name == kScore;
  const double share = scenario || is_score ? 1.0 : 1.0 / static_cast<double>(study.scenarios.size());
  const auto of_first = values_of(study, figure, first, scenario),
             of_second = values_of(study, figure, second, scenario);
  for (const std::uint64_t seed : study.seeds) {
    const auto a = of_first.find(seed), b = of_second.find(seed);
    if (a == of_first.end() || b == of_second.end()) continue;
    pair.differences.emplace_back(seed, share * (a->second - b->second));
  }
  const std::vector<double> values = pair.values();
  if (values.empty()) return pair;
  pair.median = spread_of(values).median;
  if (values.size() < kFewestPairs) return pair;
  pair.interval = median_interval(values);
  pair.test = signed_rank_test(values);
  return pair;
}

/// Holm's correction. The tests of two planners in single scenes are one family; those over all scenes are another one.
void correct(std::vector<PlannerPair>& pairs) {
  std::map<std::optional<std::pair<std::size_t, std::size_t>>, std::vector<PlannerPair*>> families;
  for (PlannerPair& pair : pairs) {
    if (!pair.test) continue;
    const auto family = pair.scenario ? std::optional(std::pair(pair.first, pair.second)) : std::nullopt;
    families[family].push_back(&pair);
  }
  for (const auto& [family, tests] : families) {
    std::vector<double> p;
    for (const PlannerPair* pair : tests) p.push_back(pair->test->p);
    const std::vector<double> corrected = holm(p);
    for (std::size_t i = 0; i < tests.size(); ++i) tests[i]->p_holm = corrected[i];
  }
}

std::vector<PlannerPair> pairs_of(const Study& study, const std::string& name, const Figure& figure) {
  std::vector<std::optional<std::size_t>> where;
  for (std::size_t s = 0; s < study.scenarios.size(); ++s) where.emplace_back(s);
  if (study.scenarios.size() > 1) where.emplace_back(std::nullopt);
  std::vector<PlannerPair> pairs;
  for (const auto& scenario : where) {
    for (std::size_t first = 0; first < study.planners.size(); ++first) {
      for (std::size_t second = first + 1; second < study.planners.size(); ++second) {
        pairs.push_back(pair_of(study, name, figure, first, second, scenario));
      }
    }
  }
  correct(pairs);
  return pairs;
}

Figure of_column(const StudyColumn& column) {
  return [&column](const FlightEntry& flight) { return column.value(*flight.figures); };
}

/// The figure kDeviation. @param study  must outlive the result.
Figure deviation(const Study& study) {
  using Medians = std::map<std::pair<std::size_t, std::size_t>, double>;  // by planner and scene
  const auto medians = std::make_shared<Medians>();
  return [&study, medians](const FlightEntry& flight) -> std::optional<double> {
    const auto [known, is_new] = medians->try_emplace({flight.planner, flight.scenario});
    if (is_new) {
      const auto scores = column_values(study_column(kScore), study.cell(flight.planner, flight.scenario));
      known->second = spread_of(scores).median;
    }
    const double median = known->second;
    if (median <= 0.0) return std::nullopt;
    return 100.0 * std::abs(flight.figures->score - median) / median;
  };
}

}  // namespace

std::vector<double> PlannerPair::values() const {
  std::vector<double> values;
  for (const auto& [seed, difference] : differences) values.push_back(difference);
  return values;
}

std::vector<PlannerPair> planner_pairs(const Study& study) {
  return pairs_of(study, kScore, of_column(study_column(kScore)));
}

std::vector<PlannerPair> other_pairs(const Study& study) {
  std::vector<PlannerPair> pairs;
  const auto add = [&](const std::string& name, const Figure& figure) {
    std::ranges::move(pairs_of(study, name, figure), std::back_inserter(pairs));
  };
  for (const StudyColumn& column : study_columns()) {
    if (column.paired) add(column.name, of_column(column));
  }
  add(kDeviation, deviation(study));
  return pairs;
}

void print_pairs(std::ostream& out, const Study& study, const std::vector<PlannerPair>& pairs) {
  if (pairs.empty()) return;
  const bool only_totals = pairs.size() > kMostPrinted && study.scenarios.size() > 1;
  out << fmt::format("\n{:<50}{:>6}{:>10}{:>20}{:>10}{:>10}\n", "differences of scores with the same seed", "pairs",
                     "median", "95 % interval", "p", "p, Holm");
  std::size_t most = 0;
  for (const PlannerPair& pair : pairs) {
    most = std::max(most, pair.differences.size());
    if (only_totals && pair.scenario) continue;
    const std::string name = study.planners[pair.first] + " - " + study.planners[pair.second] + ", " +
                             (pair.scenario ? study.scenarios[*pair.scenario] : "all scenes");
    out << fmt::format("  {:<48}{:>6}{:>10}", report::shortened(name, kLongestPair), pair.differences.size(),
                       pair.median ? fixed(*pair.median, 1) : "-");
    if (!pair.interval) {
      out << fmt::format("{:>20}\n", "n too small");
      continue;
    }
    out << fmt::format("{:>20}{:>10}{:>10}\n", fixed(pair.interval->low, 1) + " to " + fixed(pair.interval->high, 1),
                       p_text(pair.test->p), p_text(pair.p_holm));
  }
  if (only_totals) out << "pairs.csv also has the differences in each scene\n";
  if (most > 0 && most < kFewestForFive) {
    out << fmt::format("with {} seed{}, no difference can be significant at the 5 % level; use 8 seeds or more\n", most,
                       most == 1 ? "" : "s");
  }
}

std::string p_text(const std::optional<double>& p) {
  if (!p) return "";
  return *p < 0.001 ? "< 0.001" : fixed_at_most(*p, *p < 0.1 ? 4 : 3);
}

}  // namespace skein::cli
