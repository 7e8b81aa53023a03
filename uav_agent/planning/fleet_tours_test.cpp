#include "uav_agent/planning/fleet_tours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

FleetTourProblem random_problem(std::size_t agents, std::size_t tasks, std::uint64_t seed) {
  RandomStream random(seed, "fleet tours", 0);
  std::vector<double> x, y;
  FleetTourProblem problem;
  problem.agents = agents;
  problem.costs = CostMatrix(agents + tasks);
  for (std::size_t i = 0; i < agents + tasks; ++i) {
    x.push_back(random.uniform());
    y.push_back(random.uniform());
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < x.size(); ++j) problem.costs(i, j) = std::hypot(x[i] - x[j], y[i] - y[j]);
  }
  for (std::size_t i = 0; i < tasks; ++i) problem.service.push_back(0.1 * random.uniform());
  return problem;
}

/// Cheapest way for each agent to visit each set of tasks (Held and Karp), then the best partition.
double fleet_optimum(const FleetTourProblem& p) {
  const std::size_t n = p.costs.nodes() - p.agents, sets = std::size_t{1} << n;
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> longest(sets, infinity);
  longest[0] = 0.0;
  for (std::size_t agent = 0; agent < p.agents; ++agent) {
    std::vector<double> best(sets * n, infinity), alone(sets, infinity);
    alone[0] = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      best[(std::size_t{1} << i) * n + i] = p.costs(agent, p.agents + i) + p.service[i];
    }
    for (std::size_t set = 1; set < sets; ++set) {
      for (std::size_t last = 0; last < n; ++last) {
        const double so_far = best[set * n + last];
        alone[set] = std::min(alone[set], so_far);
        for (std::size_t next = 0; next < n && so_far < infinity; ++next) {
          if (set >> next & 1) continue;
          double& entry = best[(set | std::size_t{1} << next) * n + next];
          entry = std::min(entry, so_far + p.costs(p.agents + last, p.agents + next) + p.service[next]);
        }
      }
    }
    std::vector<double> with(sets, infinity);
    for (std::size_t set = 0; set < sets; ++set) {
      for (std::size_t part = set;; part = (part - 1) & set) {
        with[set] = std::min(with[set], std::max(longest[set ^ part], alone[part]));
        if (part == 0) break;
      }
    }
    longest = with;
  }
  return longest[sets - 1];
}

void expect_partition(const FleetTours& tours, std::size_t agents, std::size_t nodes) {
  std::vector<int> visits(nodes, 0);
  for (const Tour& tour : tours.tours) {
    for (const std::size_t node : tour) ++visits.at(node);
  }
  for (std::size_t node = agents; node < nodes; ++node) EXPECT_EQ(visits[node], 1);
  EXPECT_EQ(tours.tours.size(), agents);
}

/// The least sum of all tours in which each agent has a task if there are enough. Tries all ways to deal tasks out.
double least_total(const FleetTourProblem& p) {
  const std::size_t n = p.costs.nodes() - p.agents;
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = p.agents + i;
  double least = std::numeric_limits<double>::infinity();
  do {  // each order, cut into a stretch for each agent: cuts as the digits of a number
    for (std::size_t code = 0; code < static_cast<std::size_t>(std::pow(n + 1, p.agents - 1)); ++code) {
      std::vector<std::size_t> cuts = {0};
      for (std::size_t rest = code, i = 1; i < p.agents; ++i, rest /= n + 1) cuts.push_back(rest % (n + 1));
      cuts.push_back(n);
      if (!std::ranges::is_sorted(cuts)) continue;
      if (n >= p.agents && std::ranges::adjacent_find(cuts) != cuts.end()) continue;
      std::vector<Tour> tours(p.agents);
      for (std::size_t agent = 0; agent < p.agents; ++agent) {
        tours[agent].assign(order.begin() + static_cast<std::ptrdiff_t>(cuts[agent]),
                            order.begin() + static_cast<std::ptrdiff_t>(cuts[agent + 1]));
      }
      least = std::min(least, measure_fleet_tours(p, std::move(tours)).total);
    }
  } while (std::ranges::next_permutation(order).found);
  return least;
}

TEST(FleetTours, TheSumOfAllIsNearlyLeastAndNoUavStaysWithoutATask) {
  double gaps = 0.0;
  constexpr int kInstances = 40;
  for (int i = 0; i < kInstances; ++i) {
    const std::size_t agents = 1 + static_cast<std::size_t>(i % 3), tasks = 1 + static_cast<std::size_t>(i % 6);
    const FleetTourProblem problem = random_problem(agents, tasks, 100 + static_cast<std::uint64_t>(i));
    const FleetTours tours = solve_fleet_tours(problem, {.objective = FleetTourObjective::total});
    expect_partition(tours, agents, agents + tasks);
    if (tasks >= agents) {
      EXPECT_TRUE(std::ranges::none_of(tours.tours, [](const Tour& tour) { return tour.empty(); })) << "instance " << i;
    }
    const double gap = tours.total / least_total(problem) - 1.0;
    EXPECT_GE(gap, -1e-9) << "instance " << i;
    EXPECT_LT(gap, 0.25) << "instance " << i;
    gaps += gap;
  }
  EXPECT_LT(gaps / kInstances, 0.03);
}

TEST(FleetTours, WithFewTasksTheyAreNearlyOptimal) {
  double gaps = 0.0, worst = 0.0;
  constexpr int kInstances = 40;
  for (int i = 0; i < kInstances; ++i) {
    const std::size_t agents = 1 + static_cast<std::size_t>(i % 3), tasks = 5 + static_cast<std::size_t>(i % 5);
    const FleetTourProblem problem = random_problem(agents, tasks, static_cast<std::uint64_t>(i));
    const FleetTours tours = solve_fleet_tours(problem);
    expect_partition(tours, agents, agents + tasks);
    const double gap = tours.longest / fleet_optimum(problem) - 1.0;
    EXPECT_GE(gap, -1e-9);
    gaps += gap;
    worst = std::max(worst, gap);
  }
  RecordProperty("mean_gap", std::to_string(gaps / kInstances));
  EXPECT_LT(gaps / kInstances, 0.05) << "mean";
  EXPECT_LT(worst, 0.35);
}

TEST(FleetTours, LoadIsShared) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const FleetTourProblem problem = random_problem(5, 120, seed);
    const FleetTours tours = solve_fleet_tours(problem);
    expect_partition(tours, 5, 125);
    EXPECT_LT(tours.longest, 1.15 * tours.total / 5.0);
  }
}

TEST(FleetTours, AUavThatHasWorkAheadGetsLess) {
  FleetTourProblem problem = random_problem(2, 40, 3);
  problem.ahead = {100.0, 0.0};
  const FleetTours tours = solve_fleet_tours(problem);
  EXPECT_TRUE(tours.tours[0].empty());
  EXPECT_EQ(tours.tours[1].size(), 40U);
}

TEST(FleetTours, VisitEachTaskOnceIfThereAreFewerTasksThanAgentsOrNone) {
  const FleetTours few = solve_fleet_tours(random_problem(6, 2, 1));
  expect_partition(few, 6, 8);
  expect_partition(solve_fleet_tours(random_problem(3, 0, 1)), 3, 3);
}

TEST(FleetTours, AreRepeatableAndAsLongAsTheyState) {
  const FleetTourProblem problem = random_problem(4, 60, 9);
  const FleetTours once = solve_fleet_tours(problem), again = solve_fleet_tours(problem);
  EXPECT_EQ(once.tours, again.tours);
  EXPECT_DOUBLE_EQ(measure_fleet_tours(problem, once.tours).longest, once.longest);
}

}  // namespace
}  // namespace skein::agent
