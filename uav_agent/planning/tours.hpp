// Heuristics for the travelling salesman problem. The tour starts at node 0 and visits all other nodes once. The first
// solution is the nearest-neighbour tour. Then moves improve it: 2-opt and Or-opt if costs are symmetric; else moves
// that do not reverse a segment (Or-opt, and the exchange of adjacent segments, a 3-opt move). Then come a limited
// number of random double-bridge kicks, each followed by the same improvement; the best tour of all is the result.
// Pure and deterministic: kicks are drawn from a fixed stream, and effort is bounded by a count of evaluated moves.
// Source: Croes 1958 (2-opt), Or 1976, Lin 1965 (3-opt), Martin, Otto, Felten 1991 (kicks). KIOS (mTSP), STAR (ATSP).
#pragma once

#include <cstddef>
#include <vector>

namespace skein::agent {

/// Cost of going from one node to another; any unit, not negative.
class CostMatrix {
 public:
  explicit CostMatrix(std::size_t nodes, double cost = 0.0) : nodes_(nodes), costs_(nodes * nodes, cost) {}

  std::size_t nodes() const { return nodes_; }
  double& operator()(std::size_t from, std::size_t to) { return costs_[from * nodes_ + to]; }
  double operator()(std::size_t from, std::size_t to) const { return costs_[from * nodes_ + to]; }
  /// Whether costs are equal in both directions between all nodes from number `first` on.
  bool symmetric(std::size_t first = 0) const;

 private:
  std::size_t nodes_;
  std::vector<double> costs_;
};

struct TourConfig {
  bool closed = false;                    ///< whether the tour returns to node 0
  std::size_t max_evaluations = 200'000;  ///< most moves evaluated in all; chosen: bounds the CPU time
  int kicks = 20;                         ///< chosen
};

/// Nodes in the order of visit; begins with 0.
using Tour = std::vector<std::size_t>;

double tour_cost(const CostMatrix& costs, const Tour& tour, bool closed);

Tour nearest_neighbour_tour(const CostMatrix& costs);

/// Improves a tour until no move helps. If costs are not symmetric, it uses only moves that reverse no segment.
/// @param evaluations  moves that may be evaluated; counted down. At 0 the function ends, with the best tour so far.
void improve_tour(const CostMatrix& costs, bool symmetric, bool closed, std::size_t& evaluations, Tour& tour);

/// Nearest neighbour, improvement and kicks, as above. Costs may be asymmetric.
Tour solve_tour(const CostMatrix& costs, const TourConfig& config = {});

}  // namespace skein::agent
