#include "uav_agent/planning/tours.hpp"

#include <algorithm>
#include <cstdint>

namespace skein::agent {
namespace {

constexpr double kGain = 1e-9;         ///< a smaller gain is a rounding error
constexpr std::size_t kOrLongest = 3;  ///< most nodes that Or-opt moves together; chosen

/// The moves on one tour. Positions begin at 1: node 0 stays in front.
class Improver {
 public:
  Improver(const CostMatrix& costs, bool closed, std::size_t& evaluations, Tour& tour)
      : costs_(costs), closed_(closed), evaluations_(evaluations), tour_(tour) {}

  /// Reverses the part from i to j if that helps.
  bool two_opt() {
    for (std::size_t i = 1; i < tour_.size(); ++i) {
      for (std::size_t j = i + 1; j < tour_.size(); ++j) {
        if (!spend()) return false;
        const double before = leg(i - 1, i) + leg(j, j + 1);
        const double after = costs_(tour_[i - 1], tour_[j]) + to_next(tour_[i], j + 1);
        if (after >= before - kGain) continue;
        std::reverse(at(i), at(j + 1));
        return true;
      }
    }
    return false;
  }

  /// Exchanges the neighbouring parts [i, j) and [j, k) if that helps; `longest` bounds the shorter of the two.
  bool exchange(std::size_t longest) {
    const std::size_t n = tour_.size();
    for (std::size_t i = 1; i < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j) {
        const std::size_t last = j - i > longest ? std::min(n, j + longest) : n;
        for (std::size_t k = j + 1; k <= last; ++k) {
          if (!spend()) return false;
          const double before = leg(i - 1, i) + leg(j - 1, j) + leg(k - 1, k);
          const double after =
              costs_(tour_[i - 1], tour_[j]) + costs_(tour_[k - 1], tour_[i]) + to_next(tour_[j - 1], k);
          if (after >= before - kGain) continue;
          std::rotate(at(i), at(j), at(k));
          return true;
        }
      }
    }
    return false;
  }

 private:
  bool spend() {
    if (evaluations_ == 0) return false;
    --evaluations_;
    return true;
  }
  Tour::iterator at(std::size_t position) { return tour_.begin() + static_cast<std::ptrdiff_t>(position); }
  /// Cost from a node to the node at a position; behind the end, to node 0 if the tour is closed, else 0.
  double to_next(std::size_t node, std::size_t position) const {
    if (position < tour_.size()) return costs_(node, tour_[position]);
    return closed_ ? costs_(node, tour_.front()) : 0.0;
  }
  double leg(std::size_t from, std::size_t to) const { return to_next(tour_[from], to); }

  const CostMatrix& costs_;
  const bool closed_;
  std::size_t& evaluations_;
  Tour& tour_;
};

/// Double bridge: cuts the tour at three random places and exchanges the two middle parts. No 2-opt move undoes it.
void kick(std::uint64_t& random, Tour& tour) {
  const auto draw = [&random](std::size_t below) {
    // Numeric: the linear congruential generator of Knuth's MMIX.
    random = random * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::size_t>((random >> 33) % below);
  };
  std::size_t cuts[3];
  for (std::size_t& cut : cuts) cut = 1 + draw(tour.size());
  std::sort(cuts, cuts + 3);
  const auto at = [&tour](std::size_t i) { return tour.begin() + static_cast<std::ptrdiff_t>(i); };
  std::rotate(at(cuts[0]), at(cuts[1]), at(cuts[2]));
}

}  // namespace

bool CostMatrix::symmetric(std::size_t first) const {
  for (std::size_t i = first; i < nodes_; ++i) {
    for (std::size_t j = first; j < i; ++j) {
      if ((*this)(i, j) != (*this)(j, i)) return false;
    }
  }
  return true;
}

double tour_cost(const CostMatrix& costs, const Tour& tour, bool closed) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < tour.size(); ++i) sum += costs(tour[i], tour[i + 1]);
  if (closed && !tour.empty()) sum += costs(tour.back(), tour.front());
  return sum;
}

Tour nearest_neighbour_tour(const CostMatrix& costs) {
  Tour tour;
  if (costs.nodes() == 0) return tour;
  std::vector<bool> visited(costs.nodes(), false);
  tour.push_back(0);
  visited[0] = true;
  while (tour.size() < costs.nodes()) {
    std::size_t nearest = costs.nodes();
    for (std::size_t node = 0; node < costs.nodes(); ++node) {
      if (visited[node]) continue;
      if (nearest == costs.nodes() || costs(tour.back(), node) < costs(tour.back(), nearest)) nearest = node;
    }
    tour.push_back(nearest);
    visited[nearest] = true;
  }
  return tour;
}

void improve_tour(const CostMatrix& costs, bool symmetric, bool closed, std::size_t& evaluations, Tour& tour) {
  Improver improver(costs, closed, evaluations, tour);
  // Tries the cheap moves first, and the expensive ones only when no cheap move helps.
  while ((symmetric && improver.two_opt()) || improver.exchange(kOrLongest) ||
         (!symmetric && improver.exchange(tour.size()))) {
  }
}

Tour solve_tour(const CostMatrix& costs, const TourConfig& config) {
  Tour best = nearest_neighbour_tour(costs);
  if (best.size() < 3) return best;
  const bool symmetric = costs.symmetric();
  std::size_t evaluations = config.max_evaluations;
  improve_tour(costs, symmetric, config.closed, evaluations, best);
  double best_cost = tour_cost(costs, best, config.closed);
  std::uint64_t random = 1;
  for (int i = 0; i < config.kicks && evaluations > 0; ++i) {
    Tour other = best;
    kick(random, other);
    improve_tour(costs, symmetric, config.closed, evaluations, other);
    const double cost = tour_cost(costs, other, config.closed);
    if (cost >= best_cost - kGain) continue;
    best = std::move(other);
    best_cost = cost;
  }
  return best;
}

}  // namespace skein::agent
