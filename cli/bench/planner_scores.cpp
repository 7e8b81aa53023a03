#include "cli/bench/planner_scores.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <map>
#include <tuple>

#include "core/files/file_bytes.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

constexpr const char* kHeader = "scene,planner,score,points,collisions,frozen_uavs";

constexpr double kMost = 1e9;  ///< largest number in a table: it fits into an int

/// "wild" of "wild 3".
std::string kind_of(const std::string& scene) { return scene.substr(0, scene.find(' ')); }

/// Sums of a planner over the scenes of one kind.
struct Sum {
  int scenes = 0, only_before = 0, only_now = 0;  ///< in both tables, only in the old one, only in the new one
  double before = 0.0, now = 0.0;
  std::int64_t collisions_before = 0, collisions = 0, frozen_before = 0, frozen = 0;
};

std::string change_text(const Sum& sum) {
  if (sum.before <= 0.0) return "-";
  const double percent = 100.0 * (sum.now / sum.before - 1.0);
  return std::abs(percent) < 0.05 ? "0.0 %" : fmt::format("{:+.1f} %", percent);  // tables hold rounded scores
}

/// The planner and the scene of a score.
auto key_of(const PlannerScore& score) { return std::tie(score.scene, score.planner); }

}  // namespace

std::vector<PlannerScore> planner_scores(const Study& study) {
  std::vector<PlannerScore> scores;
  for (const FlightEntry& flight : study.flights) {
    if (!flight.figures) continue;
    scores.push_back({study.scenarios[flight.scenario], study.planners[flight.planner], flight.figures->score,
                      flight.figures->points_detected, flight.figures->collisions,
                      flight.figures->frozen_uavs.value_or(0)});
  }
  return scores;
}

std::string planner_scores_csv(const std::vector<PlannerScore>& scores) {
  std::string csv = std::string(kHeader) + "\n";
  for (const PlannerScore& s : scores) {
    csv += fmt::format("{},{},{:.3f},{},{},{}\n", s.scene, s.planner, s.score, s.points, s.collisions, s.frozen_uavs);
  }
  return csv;
}

std::vector<PlannerScore> read_planner_scores(const std::filesystem::path& file) {
  std::ifstream in = open_text(file);
  if (!in) throw InputError(file.string() + ": cannot be read");
  std::vector<PlannerScore> scores;
  std::string line;
  for (int number = 1; next_line(in, line, file); ++number) {
    const auto refuse = [&](const std::string& why) {
      throw InputError(fmt::format("{}: line {}: {}", file.string(), number, why));
    };
    if (number == 1) {
      if (line != kHeader) refuse("must be '" + std::string(kHeader) + "'");
      continue;
    }
    const std::vector<std::string> cells = split(line);
    std::vector<double> numbers;
    for (std::size_t i = 2; i < cells.size(); ++i) {
      const auto value = parse_number(cells[i]);
      if (value && *value >= 0.0 && *value <= kMost) numbers.push_back(*value);
    }
    if (cells.size() != 6 || numbers.size() != 4) {
      refuse("must be a scene, a planner and four numbers within [0, 1000000000]");
    }
    scores.push_back({cells[0], cells[1], numbers[0], static_cast<int>(numbers[1]), static_cast<int>(numbers[2]),
                      static_cast<int>(numbers[3])});
  }
  if (scores.empty()) throw InputError(file.string() + ": holds no scores");
  return scores;
}

void print_planner_scores(std::ostream& out, const std::vector<PlannerScore>& before,
                          const std::vector<PlannerScore>& now) {
  std::map<std::pair<std::string, std::string>, Sum> sums;
  for (const PlannerScore& score : now) {
    Sum& sum = sums[{kind_of(score.scene), score.planner}];
    const auto then = std::ranges::find(before, key_of(score), key_of);
    if (then == before.end()) {
      ++sum.only_now;
      continue;
    }
    ++sum.scenes;
    sum.before += then->score;
    sum.now += score.score;
    sum.collisions_before += then->collisions;
    sum.collisions += score.collisions;
    sum.frozen_before += then->frozen_uavs;
    sum.frozen += score.frozen_uavs;
  }
  for (const PlannerScore& score : before) {
    const bool is_gone = std::ranges::find(now, key_of(score), key_of) == now.end();
    if (is_gone) ++sums[{kind_of(score.scene), score.planner}].only_before;
  }
  out << fmt::format("{:<12}{:<14}{:>8}{:>12}{:>12}{:>10}{:>13}{:>11}\n", "scenes", "planner", "flights", "before",
                     "now", "change", "collisions", "frozen");
  for (const auto& [key, sum] : sums) {
    if (sum.scenes > 0) {
      out << fmt::format("{:<12}{:<14}{:>8}{:>12.1f}{:>12.1f}{:>10}{:>13}{:>11}\n", key.first, key.second, sum.scenes,
                         sum.before, sum.now, change_text(sum),
                         fmt::format("{} -> {}", sum.collisions_before, sum.collisions),
                         fmt::format("{} -> {}", sum.frozen_before, sum.frozen));
    }
    if (sum.only_now > 0) {
      out << fmt::format("{:<12}{:<14}{:>8}   not in the table before\n", key.first, key.second, sum.only_now);
    }
    if (sum.only_before > 0) {
      out << fmt::format("{:<12}{:<14}{:>8}   only in the table before\n", key.first, key.second, sum.only_before);
    }
  }
  out << "sums of scores; frozen: UAVs that did almost no work for a minute although there was work for them\n";
}

}  // namespace skein::cli
