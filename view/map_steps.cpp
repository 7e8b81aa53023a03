#include "view/map_steps.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "process/json_text.hpp"
#include "view/look_order.hpp"

namespace skein::view {
namespace {

/// Cubes of the newest snapshot, and the time of the snapshot in which they appeared.
struct Living {
  CubeRun run;
  double since_s = 0.0;
};

auto place_of(const CubeRun& run) { return std::tuple(run.z, run.y, run.x); }

/// Cuts a run into pieces where other runs begin or end.
/// @param others  in order, without overlaps. @param at  index of the first one that may touch this run or a later one;
/// is moved on. @param use  called with each piece, and with whether one of the others covers it.
void cut(const CubeRun& run, std::span<const CubeRun> others, std::size_t& at, const auto& use) {
  const auto is_before = [&](const CubeRun& other) {
    const auto row = std::tuple(run.z, run.y), others_row = std::tuple(other.z, other.y);
    return others_row < row || (others_row == row && other.x + other.length <= run.x);
  };
  while (at < others.size() && is_before(others[at])) ++at;
  int x = run.x;
  const int end = run.x + run.length;
  for (std::size_t i = at; i < others.size() && x < end; ++i) {
    const CubeRun& other = others[i];
    if (other.z != run.z || other.y != run.y || other.x >= end) break;
    const int from = std::max(x, other.x), to = std::min(end, other.x + other.length);
    if (from > x) use(CubeRun{x, run.y, run.z, from - x}, false);
    if (to > from) use(CubeRun{from, run.y, run.z, to - from}, true);
    x = std::max(x, to);
  }
  if (x < end) use(CubeRun{x, run.y, run.z, end - x}, false);
}

/// Follows cubes from snapshot to snapshot.
class Lives {
 public:
  void add(const RunsAt& now) {
    std::vector<Living> next;
    std::size_t at = 0;
    for (const Living& one : living_) {
      cut(one.run, now.runs, at, [&](const CubeRun& piece, bool lives) {
        if (lives) {
          next.push_back({piece, one.since_s});
        } else {
          ended_[{one.since_s, now.time_s}].push_back(piece);
        }
      });
    }
    const std::size_t kept = next.size();
    std::vector<CubeRun> before;
    for (const Living& one : living_) before.push_back(one.run);
    at = 0;
    for (const CubeRun& run : now.runs) {
      cut(run, before, at, [&](const CubeRun& piece, bool lived) {
        if (!lived) next.push_back({piece, now.time_s});
      });
    }
    const auto born = next.begin() + static_cast<std::ptrdiff_t>(kept);
    std::ranges::inplace_merge(next, born, {}, [](const Living& one) { return place_of(one.run); });
    living_ = std::move(next);
  }

  std::vector<RunsStep> end() {
    for (const Living& one : living_) ended_[{one.since_s, kForever}].push_back(one.run);
    std::vector<RunsStep> steps;
    for (auto& [times, runs] : ended_) {
      const auto until_s = times.second == kForever ? std::nullopt : std::optional(times.second);
      steps.push_back({times.first, until_s, joined_runs(std::move(runs))});
    }
    return steps;
  }

 private:
  static constexpr double kForever = std::numeric_limits<double>::infinity();

  std::vector<Living> living_;  ///< in the order of (z, y, x)
  std::map<std::pair<double, double>, std::vector<CubeRun>> ended_;
};

std::size_t rows_of(const std::vector<RunsStep>& steps) {
  std::size_t rows = 0;
  for (const RunsStep& step : steps) rows += step.runs.size();
  return rows;
}

/// The lifetimes of cubes that are made larger until there are few enough runs. @param cell_m  is raised accordingly.
std::vector<RunsStep> bounded_lifetimes(std::vector<RunsAt> snapshots, double& cell_m, std::size_t most_runs,
                                        std::size_t most_in_time) {
  const auto enlarge = [&] {
    for (RunsAt& snapshot : snapshots) snapshot.runs = coarser_runs(snapshot.runs);
    cell_m *= 2.0;
  };
  // Eight cubes around the origin stay eight, however large they are made, so a lower limit could not be kept.
  constexpr std::size_t kLeast = 8;
  const auto too_long = [&](const RunsAt& snapshot) { return snapshot.runs.size() > std::max(most_runs, kLeast); };
  while (std::ranges::any_of(snapshots, too_long)) enlarge();
  std::vector<RunsStep> steps = lifetimes(snapshots);
  while (rows_of(steps) > std::max(most_in_time, kLeast * snapshots.size())) {
    enlarge();
    steps = lifetimes(snapshots);
  }
  return steps;
}

Json steps_json(const std::vector<RunsStep>& steps) {
  Json json = Json::array();
  for (const RunsStep& step : steps) {
    json.push_back({{"t", step.time_s}, {"runs", packed(step.runs)}});
    if (step.until_s) json.back()["until"] = *step.until_s;
  }
  return json;
}

}  // namespace

std::vector<RunsStep> lifetimes(std::span<const RunsAt> snapshots) {
  Lives lives;
  for (const RunsAt& snapshot : snapshots) lives.add(snapshot);
  return lives.end();
}

MapInTime map_in_time(std::vector<RunsAt> occupied, std::vector<RunsAt> free, double cell_m, std::size_t most_runs,
                      std::size_t most_in_time) {
  MapInTime map{.cell_m = cell_m, .slice_cell_m = cell_m};
  for (const RunsAt& snapshot : occupied) map.times_s.push_back(snapshot.time_s);
  map.occupied = bounded_lifetimes(std::move(occupied), map.cell_m, most_runs, most_in_time);
  map.free = bounded_lifetimes(std::move(free), map.slice_cell_m, most_runs, most_in_time);
  return map;
}

std::string map_text(const std::string& uav, const MapInTime& map, const std::string& kind) {
  const Json json = {{"n", map_cloud(uav)},
                     {"t", map.times_s.empty() ? 0.0 : map.times_s.back()},
                     {"kind", kind},
                     {"times", map.times_s},
                     {"cell", map.cell_m},
                     {"steps", steps_json(map.occupied)},
                     {"freeCell", map.slice_cell_m},
                     {"freeSteps", steps_json(map.free)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace skein::view
