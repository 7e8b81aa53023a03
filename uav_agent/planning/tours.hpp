// Orders of visit: travelling-salesman heuristics for one traveller. Node 0 is where the tour begins; it visits all
// other nodes once. Nearest neighbour, then improvement: in both directions (2-opt and Or-opt) where the way back
// costs what the way there does, in one direction only (Or-opt and the exchange of neighbouring segments, a 3-opt move
// without reversal) where it does not; then a counted number of double-bridge kicks, of which the better ones stay.
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
  /// Whether every way back costs what the way there does, among the nodes from `first` on.
  bool symmetric(std::size_t first = 0) const;

 private:
  std::size_t nodes_;
  std::vector<double> costs_;
};

struct TourConfig {
  bool closed = false;                    ///< true: back to node 0 in the end
  std::size_t max_evaluations = 200'000;  ///< of moves, in all
  int kicks = 20;
};

/// Nodes in the order of visit; begins with 0.
using Tour = std::vector<std::size_t>;

double tour_cost(const CostMatrix& costs, const Tour& tour, bool closed);

Tour nearest_neighbour_tour(const CostMatrix& costs);

/// Shortens a tour as far as its moves go. With costs that differ by direction, it only uses moves that keep it.
/// @param evaluations  is counted down; at 0 the tour stays as good as it got.
void improve_tour(const CostMatrix& costs, bool symmetric, bool closed, std::size_t& evaluations, Tour& tour);

/// All of the above. Costs may differ by direction.
Tour solve_tour(const CostMatrix& costs, const TourConfig& config = {});

}  // namespace skein::agent
