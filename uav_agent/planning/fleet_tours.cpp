#include "uav_agent/planning/fleet_tours.hpp"

#include <algorithm>
#include <limits>

namespace skein::agent {
namespace {

constexpr double kTourGain = 1e-9;  ///< a smaller gain is a rounding error
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Solver {
 public:
  Solver(const FleetTourProblem& problem, const FleetTourConfig& config)
      : problem_(problem),
        config_(config),
        symmetric_(problem.costs.symmetric(problem.agents)),
        evaluations_(config.max_evaluations),
        tours_(problem.agents),
        load_(problem.ahead) {
    load_.resize(problem.agents, 0.0);
  }

  std::vector<Tour> run() {
    insert_all();
    for (std::size_t agent = 0; agent < tours_.size(); ++agent) shorten(agent);
    while (evaluations_ > 0 && (relocate() || swap())) {
    }
    return std::move(tours_);
  }

 private:
  struct Place {
    double cost = kInfinity;
    std::size_t position = 0;
  };

  double service(std::size_t node) const {
    return problem_.service.empty() ? 0.0 : problem_.service[node - problem_.agents];
  }
  /// The node before a position of a tour; before the first task, the agent's own place.
  std::size_t before(std::size_t agent, std::size_t position) const {
    return position == 0 ? agent : tours_[agent][position - 1];
  }
  double way(std::size_t from, std::size_t agent, std::size_t position) const {
    return position < tours_[agent].size() ? problem_.costs(from, tours_[agent][position]) : 0.0;
  }
  double insertion(std::size_t node, std::size_t agent, std::size_t position) const {
    const std::size_t from = before(agent, position);
    return problem_.costs(from, node) + way(node, agent, position) - way(from, agent, position) + service(node);
  }
  Place best_place(std::size_t node, std::size_t agent) const {
    Place best;
    for (std::size_t position = 0; position <= tours_[agent].size(); ++position) {
      const double cost = insertion(node, agent, position);
      if (cost < best.cost) best = {cost, position};
    }
    return best;
  }
  /// By how much a tour becomes cheaper without one of its nodes.
  double removal(std::size_t agent, std::size_t position) const {
    const std::size_t from = before(agent, position), node = tours_[agent][position];
    const double skip = position + 1 < tours_[agent].size() ? problem_.costs(from, tours_[agent][position + 1]) : 0.0;
    return problem_.costs(from, node) + way(node, agent, position + 1) - skip + service(node);
  }

  void insert(std::size_t node, std::size_t agent, std::size_t position) {
    tours_[agent].insert(tours_[agent].begin() + static_cast<std::ptrdiff_t>(position), node);
  }
  void remove(std::size_t agent, std::size_t position) {
    tours_[agent].erase(tours_[agent].begin() + static_cast<std::ptrdiff_t>(position));
  }

  void insert_all() {
    std::vector<std::size_t> open;
    for (std::size_t node = problem_.agents; node < problem_.costs.nodes(); ++node) open.push_back(node);
    std::vector<std::vector<Place>> places(tours_.size(), std::vector<Place>(problem_.costs.nodes()));
    for (std::size_t agent = 0; agent < tours_.size(); ++agent) {
      for (const std::size_t node : open) places[agent][node] = best_place(node, agent);
    }
    while (!open.empty()) {
      const std::size_t agent = next_to_take(open, places);
      const auto chosen = std::ranges::min_element(
          open, [&](std::size_t a, std::size_t b) { return places[agent][a].cost < places[agent][b].cost; });
      const std::size_t node = *chosen;
      open.erase(chosen);
      const Place place = places[agent][node];
      insert(node, agent, place.position);
      load_[agent] += place.cost;
      for (const std::size_t other : open) update(places[agent][other], other, agent, place.position);
    }
  }

  /// The agent that takes the next task. For the longest tour: the one with the least load. For the sum: the one with
  /// the cheapest insertion; as long as some agents have no task, one of them.
  std::size_t next_to_take(const std::vector<std::size_t>& open, const std::vector<std::vector<Place>>& places) const {
    if (!for_total()) return static_cast<std::size_t>(std::ranges::min_element(load_) - load_.begin());
    const bool all_have_one = std::ranges::none_of(tours_, [](const Tour& tour) { return tour.empty(); });
    std::size_t taker = 0;
    double least = kInfinity;
    for (std::size_t agent = 0; agent < tours_.size(); ++agent) {
      if (!all_have_one && !tours_[agent].empty()) continue;
      for (const std::size_t node : open) {
        if (places[agent][node].cost >= least) continue;
        least = places[agent][node].cost;
        taker = agent;
      }
    }
    return taker;
  }

  /// Updates a node's best place after an insertion at `position`: only the two new gaps can be cheaper than before,
  /// and a full search is needed only if the best place was that very position.
  void update(Place& place, std::size_t node, std::size_t agent, std::size_t position) const {
    if (place.position == position) {
      place = best_place(node, agent);
      return;
    }
    if (place.position > position) ++place.position;
    for (const std::size_t fresh : {position, position + 1}) {
      const double cost = insertion(node, agent, fresh);
      if (cost < place.cost) place = {cost, fresh};
    }
  }

  /// Shortens one tour on its own, and updates load_.
  void shorten(std::size_t agent) {
    Tour& tour = tours_[agent];
    if (tour.size() < 2) return;
    CostMatrix costs(tour.size() + 1);
    Tour order = {0};
    const auto node = [&](std::size_t i) { return i == 0 ? agent : tour[i - 1]; };
    for (std::size_t i = 0; i <= tour.size(); ++i) {
      for (std::size_t j = 1; j <= tour.size(); ++j) costs(i, j) = problem_.costs(node(i), node(j));
      if (i > 0) order.push_back(i);
    }
    const double before_cost = tour_cost(costs, order, false);
    improve_tour(costs, symmetric_, false, evaluations_, order);
    Tour shorter;
    for (std::size_t i = 1; i < order.size(); ++i) shorter.push_back(node(order[i]));
    load_[agent] += tour_cost(costs, order, false) - before_cost;
    tour = std::move(shorter);
  }

  bool for_total() const { return config_.objective == FleetTourObjective::total; }

  /// Whether new loads of two agents are better. For the longest tour, the greater load counts, plus total_weight times
  /// the sum.
  bool better(std::size_t a, std::size_t b, double load_a, double load_b) const {
    if (for_total()) return load_a + load_b < load_[a] + load_[b] - kTourGain;
    const double now = std::max(load_[a], load_[b]) + config_.total_weight * (load_[a] + load_[b]);
    return std::max(load_a, load_b) + config_.total_weight * (load_a + load_b) < now - kTourGain;
  }

  /// Agents in descending order of load.
  std::vector<std::size_t> by_load() const {
    std::vector<std::size_t> agents(tours_.size());
    for (std::size_t i = 0; i < agents.size(); ++i) agents[i] = i;
    std::ranges::stable_sort(agents, [this](std::size_t a, std::size_t b) { return load_[a] > load_[b]; });
    return agents;
  }

  bool relocate() {
    for (const std::size_t from : by_load()) {
      if (for_total() && tours_[from].size() < 2) continue;  // keeps its only task
      for (std::size_t position = 0; position < tours_[from].size(); ++position) {
        const std::size_t node = tours_[from][position];
        const double gain = removal(from, position);
        for (std::size_t to = 0; to < tours_.size(); ++to) {
          if (to == from || !spend(tours_[to].size() + 1)) continue;
          const Place place = best_place(node, to);
          if (!better(from, to, load_[from] - gain, load_[to] + place.cost)) continue;
          remove(from, position);
          insert(node, to, place.position);
          load_[from] -= gain;
          load_[to] += place.cost;
          shorten(from);
          shorten(to);
          return true;
        }
      }
    }
    return false;
  }

  /// Exchanges a task of the longest tour (for the sum: of any tour) with a task of another tour.
  bool swap() {
    for (const std::size_t from : by_load()) {
      if (swap_of(from)) return true;
      if (!for_total() || evaluations_ == 0) return false;
    }
    return false;
  }

  bool swap_of(std::size_t from) {
    for (std::size_t i = 0; i < tours_[from].size(); ++i) {
      const std::size_t mine = tours_[from][i];
      const double gain = removal(from, i);
      for (std::size_t to = 0; to < tours_.size(); ++to) {
        for (std::size_t j = 0; to != from && j < tours_[to].size(); ++j) {
          if (!spend(tours_[from].size() + tours_[to].size())) return false;
          const std::size_t theirs = tours_[to][j];
          const double load_from = load_[from] - gain, load_to = load_[to] - removal(to, j);
          remove(from, i);
          remove(to, j);
          const Place here = best_place(theirs, from), there = best_place(mine, to);
          if (better(from, to, load_from + here.cost, load_to + there.cost)) {
            insert(theirs, from, here.position);
            insert(mine, to, there.position);
            load_[from] = load_from + here.cost;
            load_[to] = load_to + there.cost;
            return true;
          }
          insert(mine, from, i);
          insert(theirs, to, j);
        }
      }
    }
    return false;
  }

  bool spend(std::size_t count) {
    if (evaluations_ < count) {
      evaluations_ = 0;
      return false;
    }
    evaluations_ -= count;
    return true;
  }

  const FleetTourProblem& problem_;
  const FleetTourConfig config_;
  const bool symmetric_;
  std::size_t evaluations_;
  std::vector<Tour> tours_;
  std::vector<double> load_;
};

}  // namespace

FleetTours solve_fleet_tours(const FleetTourProblem& problem, const FleetTourConfig& config) {
  return measure_fleet_tours(problem, Solver(problem, config).run());
}

FleetTours measure_fleet_tours(const FleetTourProblem& problem, std::vector<Tour> tours) {
  FleetTours result{std::move(tours), 0.0, 0.0};
  for (std::size_t agent = 0; agent < result.tours.size(); ++agent) {
    double load = problem.ahead.empty() ? 0.0 : problem.ahead[agent];
    std::size_t at = agent;
    for (const std::size_t node : result.tours[agent]) {
      load += problem.costs(at, node) + (problem.service.empty() ? 0.0 : problem.service[node - problem.agents]);
      at = node;
    }
    result.longest = std::max(result.longest, load);
    result.total += load;
  }
  return result;
}

}  // namespace skein::agent
