#include "cli/study/figures.hpp"

#include <algorithm>
#include <cmath>

#include "report/figures.hpp"
#include "results/losses.hpp"

namespace skein::cli {
namespace {

/// Mean of a figure over UAVs.
struct Mean {
  double sum = 0.0;
  int count = 0;
  void add(const Json& value) {
    if (!value.is_number()) return;
    sum += value.get<double>();
    ++count;
  }
  std::optional<double> value() const { return count > 0 ? std::optional(sum / count) : std::nullopt; }
};

void add_work(const Json& uav, FlightFigures& figures) {
  const auto figure = [&](const char* key) { return number_if_any(uav, key); };
  if (const auto frozen_s = figure("frozen_s")) {
    figures.frozen_uavs = figures.frozen_uavs.value_or(0) + (*frozen_s > 0.0 ? 1 : 0);
    figures.frozen_s = figures.frozen_s.value_or(0.0) + *frozen_s;
  }
  if (const auto excused_s = figure("excused_s")) {
    figures.waiting_uavs = figures.waiting_uavs.value_or(0) + (*excused_s > 0.0 ? 1 : 0);
  }
  if (const auto waited_s = figure("waited_s")) figures.waited_s = figures.waited_s.value_or(0.0) + *waited_s;
  if (const auto longest_s = figure("without_work_s")) {
    figures.without_work_s = std::max(figures.without_work_s.value_or(0.0), *longest_s);
  }
}

/// @param sorted  not empty. @param share  [0, 1]
double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

std::optional<double> decisive(const std::vector<double>& totals, Rank rank) {
  if (totals.empty()) return std::nullopt;
  const Spread spread = spread_of(totals);
  switch (rank) {
    case Rank::maximum:
      return spread.max;
    case Rank::median:
      return spread.median;
    case Rank::worst:
      return spread.min;
  }
  return std::nullopt;
}

std::optional<double> greatest_share(const std::vector<UavFigures>& uavs) {
  double all = 0.0, most = 0.0;
  for (const UavFigures& uav : uavs) {
    all += uav.score;
    most = std::max(most, uav.score);
  }
  return all > 0.0 ? std::optional(100.0 * most / all) : std::nullopt;
}

}  // namespace

FlightFigures figures_of(const Json& result) {
  FlightFigures figures;
  figures.score = number_in(result, "score");
  figures.points_detected = static_cast<int>(number_in(result, "points_detected"));
  figures.points_total = static_cast<int>(number_in(result, "points_total"));
  const double attainable = number_in(value_or(result, "attainable", Json::object()), "score");
  if (attainable > 0.0) {
    figures.attainable = attainable;
    figures.attainable_percent = 100.0 * figures.score / attainable;
  }
  if (figures.points_detected > 0) figures.mean_quality = figures.score / figures.points_detected;
  figures.collisions = static_cast<int>(value_or(result, "collisions", Json::array()).size());
  for (const Json& collision : value_or(result, "collisions", Json::array())) {
    figures.collisions_by_battery += text_in(collision, "cause") == "battery" ? 1 : 0;
  }
  const Json losses = value_or(result, "losses", Json::object());
  for (const auto& [cause, sum] : losses.items()) {
    figures.losses[cause] = number_in(sum, "score");
  }
  if (!figures.losses.empty()) {
    const auto parts = results::poor_parts(losses);
    for (std::size_t i = 0; i < parts.size(); ++i) figures.poor_parts[results::kPoorParts[i].key] = parts[i].score;
  }
  figures.real_time_factor = number_in(result, "real_time_factor");
  figures.mission_time_s = number_in(result, "mission_time_s");
  figures.status = text_in(result, "status");
  figures.digest = text_in(result, "digest");
  Mean explorers, photographers, cpu;
  const Json scores = value_or(result, "score_by_uav", Json::object());
  for (const Json& uav : value_or(result, "uavs", Json::array())) {
    (value_or(uav, "role", "") == "explorer" ? explorers : photographers).add(value_or(uav, "idle_s", nullptr));
    add_work(uav, figures);
    figures.distance_m += number_in(uav, "distance_m");
    cpu.add(value_or(uav, "planner_cpu_s", nullptr));
    const std::string name = text_in(uav, "name");
    figures.uavs.push_back({name, text_in(uav, "role"), number_in(scores, name.c_str()), number_in(uav, "distance_m"),
                            number_if_any(uav, "idle_s"), number_if_any(uav, "captures")});
  }
  figures.greatest_share = greatest_share(figures.uavs);
  const Json check = value_or(result, "flight_check", Json::object());
  figures.braking_hits = number_if_any(check, "braking_hits");
  figures.braking_meets = number_if_any(check, "braking_meets");
  figures.ways_meet = number_if_any(check, "ways_meet");
  figures.least_clearance_m = number_if_any(check, "least_clearance_m");
  figures.least_separation_m = number_if_any(check, "least_separation_m");
  figures.memory_mb = number_if_any(result, "memory_mb");
  figures.processors = report::processors_of(result);
  figures.idle_explorers_s = explorers.value();
  figures.idle_photographers_s = photographers.value();
  const double sim_time_s = number_in(result, "sim_time_s");
  if (cpu.value() && sim_time_s > 0.0) figures.planner_cpu_ms = 1e3 * *cpu.value() / sim_time_s;
  return figures;
}

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  return {values.size(),         values.front(),         quantile(values, 0.25),
          quantile(values, 0.5), quantile(values, 0.75), values.back()};
}

FlightList::FlightList(std::initializer_list<FlightEntry> flights) {
  for (const FlightEntry& flight : flights) push_back(flight);
}

FlightEntry& FlightList::push_back(FlightEntry flight) {
  by_scenario_[{flight.planner, flight.scenario}].push_back(flights_.size());
  by_seed_[{flight.planner, flight.seed}].push_back(flights_.size());
  return flights_.emplace_back(std::move(flight));
}

const std::vector<std::size_t>& FlightList::in_scenario(std::size_t planner, std::size_t scenario) const {
  return places_in(by_scenario_, planner, scenario);
}

const std::vector<std::size_t>& FlightList::with_seed(std::size_t planner, std::uint64_t seed) const {
  return places_in(by_seed_, planner, seed);
}

const std::vector<std::size_t>& FlightList::places_in(const Places& all, std::size_t planner, std::uint64_t other) {
  static const std::vector<std::size_t> kNone;
  const auto found = all.find({planner, other});
  return found == all.end() ? kNone : found->second;
}

std::vector<const FlightEntry*> Study::cell(std::size_t planner, std::size_t scenario) const {
  std::vector<const FlightEntry*> entries;
  for (const std::size_t i : flights.in_scenario(planner, scenario)) {
    if (flights[i].figures) entries.push_back(&flights[i]);
  }
  return entries;
}

const FlightEntry* Study::best(std::size_t planner, std::size_t scenario) const {
  const FlightEntry* best = nullptr;
  for (const FlightEntry* flight : cell(planner, scenario)) {
    if (best == nullptr || flight->figures->score > best->figures->score) best = flight;
  }
  return best;
}

bool Study::any_problem() const {
  return std::any_of(flights.begin(), flights.end(), [](const FlightEntry& f) { return !f.problem.empty(); });
}

bool Study::compares_by_share() const {
  return !contest && scenarios.size() > 1 && std::ranges::all_of(flights, [](const FlightEntry& flight) {
    return !flight.figures || flight.figures->attainable_percent;
  });
}

std::optional<double> total_of(const Study& study, std::size_t planner, std::uint64_t seed,
                               const std::function<std::optional<double>(const FlightEntry&)>& value) {
  double total = 0.0;
  std::size_t scenes = 0;
  for (const std::size_t i : study.flights.with_seed(planner, seed)) {
    const FlightEntry& flight = study.flights[i];
    if (!flight.figures) continue;
    const std::optional<double> of_flight = value(flight);
    if (!of_flight) continue;
    total += *of_flight;
    ++scenes;
  }
  return scenes == study.scenarios.size() ? std::optional(total) : std::nullopt;
}

std::vector<Standing> standings(const Study& study) {
  std::vector<Standing> all;
  for (std::size_t p = 0; p < study.planners.size(); ++p) {
    Standing standing{p, {}, {}, 0};
    for (const std::uint64_t seed : study.seeds) {
      standing.totals.push_back(
          total_of(study, p, seed, [](const FlightEntry& flight) { return flight.figures->score; }));
    }
    standing.decides = decisive(complete_totals(standing), study.rank);
    all.push_back(std::move(standing));
  }
  std::stable_sort(all.begin(), all.end(), [](const Standing& a, const Standing& b) { return a.decides > b.decides; });
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool equal = i > 0 && all[i].decides == all[i - 1].decides;
    all[i].place = equal ? all[i - 1].place : static_cast<int>(i) + 1;
  }
  return all;
}

std::vector<double> complete_totals(const Standing& standing) {
  std::vector<double> totals;
  for (const std::optional<double>& total : standing.totals) {
    if (total) totals.push_back(*total);
  }
  return totals;
}

std::string rank_name(Rank rank) {
  switch (rank) {
    case Rank::maximum:
      return "max";
    case Rank::median:
      return "median";
    case Rank::worst:
      return "worst";
  }
  return "";
}

}  // namespace skein::cli
