#include "uav_agent/planning/tours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

/// Euclidean in a unit square; `wind` makes ways in +x dearer than back.
CostMatrix random_costs(std::size_t nodes, std::uint64_t seed, double wind) {
  RandomStream random(seed, "costs", 0);
  std::vector<double> x, y;
  for (std::size_t i = 0; i < nodes; ++i) {
    x.push_back(random.uniform());
    y.push_back(random.uniform());
  }
  CostMatrix costs(nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    for (std::size_t j = 0; j < nodes; ++j) {
      if (i != j) costs(i, j) = std::hypot(x[i] - x[j], y[i] - y[j]) + wind * std::max(0.0, x[j] - x[i]);
    }
  }
  return costs;
}

/// Exact, by dynamic programming over subsets (Held and Karp).
double optimum(const CostMatrix& costs, bool closed) {
  const std::size_t n = costs.nodes() - 1, sets = std::size_t{1} << n;
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> best(sets * n, infinity);
  for (std::size_t i = 0; i < n; ++i) best[(std::size_t{1} << i) * n + i] = costs(0, i + 1);
  for (std::size_t set = 1; set < sets; ++set) {
    for (std::size_t last = 0; last < n; ++last) {
      const double so_far = best[set * n + last];
      if (so_far == infinity) continue;
      for (std::size_t next = 0; next < n; ++next) {
        if (set >> next & 1) continue;
        double& entry = best[(set | std::size_t{1} << next) * n + next];
        entry = std::min(entry, so_far + costs(last + 1, next + 1));
      }
    }
  }
  double result = infinity;
  for (std::size_t last = 0; last < n; ++last) {
    result = std::min(result, best[(sets - 1) * n + last] + (closed ? costs(last + 1, 0) : 0.0));
  }
  return result;
}

bool visits_all_once(const Tour& tour, std::size_t nodes) {
  Tour sorted = tour;
  std::ranges::sort(sorted);
  for (std::size_t i = 0; i < nodes; ++i) {
    if (sorted.size() != nodes || sorted[i] != i) return false;
  }
  return tour.empty() || tour.front() == 0;
}

struct TourKind {
  const char* name;
  double wind;
  bool closed;
};

class SmallTours : public testing::TestWithParam<TourKind> {};

TEST_P(SmallTours, AreNearlyOptimal) {
  double gaps = 0.0, worst = 0.0;
  constexpr int kInstances = 60;
  for (int i = 0; i < kInstances; ++i) {
    const std::size_t nodes = 6 + static_cast<std::size_t>(i % 6);
    const CostMatrix costs = random_costs(nodes, static_cast<std::uint64_t>(i), GetParam().wind);
    const Tour tour = solve_tour(costs, {.closed = GetParam().closed});
    ASSERT_TRUE(visits_all_once(tour, costs.nodes()));
    const double gap = tour_cost(costs, tour, GetParam().closed) / optimum(costs, GetParam().closed) - 1.0;
    EXPECT_GE(gap, -1e-9);
    gaps += gap;
    worst = std::max(worst, gap);
  }
  RecordProperty("mean_gap", std::to_string(gaps / kInstances));
  EXPECT_LT(gaps / kInstances, 0.005) << "mean";
  EXPECT_LT(worst, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SmallTours,
                         testing::Values(TourKind{"open", 0.0, false}, TourKind{"closed", 0.0, true},
                                         TourKind{"open_directed", 0.8, false}, TourKind{"closed_directed", 0.8, true}),
                         [](const auto& kind) { return kind.param.name; });

TEST(Tours, ImprovementNeverMakesATourWorseHoweverMuchEffortItHas) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const CostMatrix costs = random_costs(60, seed, seed % 2 == 0 ? 0.0 : 0.5);
    Tour tour = nearest_neighbour_tour(costs);
    double cost = tour_cost(costs, tour, false);
    for (const std::size_t effort : {100U, 1000U, 10'000U, 100'000U}) {
      std::size_t evaluations = effort;
      improve_tour(costs, seed % 2 == 0, false, evaluations, tour);
      EXPECT_TRUE(visits_all_once(tour, 60));
      EXPECT_LE(tour_cost(costs, tour, false), cost + 1e-9);
      cost = tour_cost(costs, tour, false);
    }
  }
}

TEST(Tours, AHundredNodesAreMuchBetterThanNearestNeighbour) {
  double nearest = 0.0, solved = 0.0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const CostMatrix costs = random_costs(100, seed, 0.0);
    nearest += tour_cost(costs, nearest_neighbour_tour(costs), true);
    solved += tour_cost(costs, solve_tour(costs, {.closed = true}), true);
  }
  EXPECT_LT(solved, 0.87 * nearest);
}

TEST(Tours, UpToTwoNodesAreVisitedInTheirOrder) {
  EXPECT_TRUE(solve_tour(CostMatrix(0)).empty());
  EXPECT_EQ(solve_tour(CostMatrix(1)), Tour{0});
  EXPECT_EQ(solve_tour(CostMatrix(2)), (Tour{0, 1}));
}

TEST(Tours, AreRepeatable) {
  const CostMatrix costs = random_costs(70, 3, 0.4);
  EXPECT_EQ(solve_tour(costs), solve_tour(costs));
}

}  // namespace
}  // namespace skein::agent
