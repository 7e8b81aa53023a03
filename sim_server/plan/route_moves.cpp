// Shortens routes without changing their views: reverses parts (2-opt), and moves a few stops elsewhere (or-opt).
#include <algorithm>

#include "sim_server/plan/routes.hpp"

namespace skein::sim {
namespace {

constexpr double kLeastSaved_s = 1e-6;
constexpr std::size_t kLongestMoved = 3;  ///< maximum number of stops that are moved together
constexpr int kMostMoves = 200;           ///< maximum number of changes of one route in one call

}  // namespace

void RouteSearch::shorten(std::size_t uav) {
  if (takeoff_s_[uav] >= kNever) return;
  for (int i = 0; i < kMostMoves; ++i) {
    if (!reverse_once(uav) && !move_once(uav)) break;
  }
  time_again(uav);
}

/// Reverses the order of stops i to j. Legs take the same time in both directions, so only the edges at the ends of the
/// part change. @returns whether the route has become shorter.
bool RouteSearch::reverse_once(std::size_t uav) {
  std::vector<std::size_t>& stops = routes_[uav].stops;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const std::size_t before = i == 0 ? legs_.start_of(UavIndex{uav}) : stops[i - 1];
    const double first_s = edge_s(uav, before, stops[i], true);
    for (std::size_t j = i + 1; j < stops.size(); ++j) {
      const std::size_t after = j + 1 == stops.size() ? views_.size() : stops[j + 1];
      const double had_s = first_s + edge_s(uav, stops[j], after, true) - kLeastSaved_s;
      if (legs_.least_leg_s(before, stops[j]) >= had_s) continue;
      if (edge_s(uav, before, stops[j], false) + edge_s(uav, stops[i], after, false) >= had_s) continue;
      if (edge_s(uav, before, stops[j], true) + edge_s(uav, stops[i], after, true) >= had_s) continue;
      std::reverse(stops.begin() + static_cast<std::ptrdiff_t>(i), stops.begin() + static_cast<std::ptrdiff_t>(j) + 1);
      return true;
    }
  }
  return false;
}

/// Moves up to three successive stops to another position of the route, reversed or not. @returns as reverse_once().
bool RouteSearch::move_once(std::size_t uav) {
  std::vector<std::size_t>& stops = routes_[uav].stops;
  const auto at = [&](const std::vector<std::size_t>& list, std::size_t i) {
    return i == 0 ? legs_.start_of(UavIndex{uav}) : i > list.size() ? views_.size() : list[i - 1];
  };
  for (std::size_t length = 1; length <= kLongestMoved; ++length) {
    for (std::size_t i = 0; i + length <= stops.size(); ++i) {
      const std::size_t head = stops[i], tail = stops[i + length - 1];
      const std::size_t before = at(stops, i), after = at(stops, i + length + 1);
      const double saved_s = edge_s(uav, before, head, true) + edge_s(uav, tail, after, true) -
                             edge_s(uav, before, after, true) - kLeastSaved_s;
      if (saved_s <= 0.0) continue;
      std::vector<std::size_t> rest = stops;
      const auto from = rest.begin() + static_cast<std::ptrdiff_t>(i);
      std::vector<std::size_t> part(from, from + static_cast<std::ptrdiff_t>(length));
      rest.erase(from, from + static_cast<std::ptrdiff_t>(length));
      for (std::size_t j = 0; j <= rest.size(); ++j) {
        if (j == i) continue;
        const std::size_t left = at(rest, j), right = at(rest, j + 1);
        const double joined_s = edge_s(uav, left, right, true);
        for (const bool turned : {false, true}) {
          const std::size_t first = turned ? tail : head, last = turned ? head : tail;
          const auto added_s = [&](bool exact) {
            return edge_s(uav, left, first, exact) + edge_s(uav, last, right, exact) - joined_s;
          };
          if (added_s(false) >= saved_s || added_s(true) >= saved_s) continue;
          if (turned) std::ranges::reverse(part);
          rest.insert(rest.begin() + static_cast<std::ptrdiff_t>(j), part.begin(), part.end());
          stops = std::move(rest);
          return true;
        }
      }
    }
  }
  return false;
}

}  // namespace skein::sim
