#include "sim_server/plan/routes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/math/random_stream.hpp"

namespace skein::sim {
namespace {

constexpr double kLeastGain = 0.02;     ///< views with a smaller gain get no stop
constexpr double kLeastAdded_s = 0.05;  ///< lower limit of an added time, so that the gain per second is finite
constexpr double kNearStop = 6.0;       ///< a new stop may shorten the detours to views within this distance [m]
constexpr std::size_t kEdgesTried = 2;  ///< insertion positions of a route that are checked with exact times

}  // namespace

/// The best position to insert a view, with its cost in time and its gain.
struct RouteSearch::Insertion {
  std::size_t uav = 0, position = 0;
  double added_s = kNever;
  double gain = 0.0;
  double rate() const { return added_s < kNever ? gain / std::max(added_s, kLeastAdded_s) : 0.0; }
};

/// An entry of the heap of candidate views: the view with its gain per second at the time when it was pushed.
struct RouteSearch::Later {
  double rate;
  std::size_t view;
  bool operator<(const Later& other) const { return rate != other.rate ? rate < other.rate : view > other.view; }
};

RouteSearch::RouteSearch(Legs& legs, const Scenario& scenario, const Team& team, const std::vector<View>& views,
                         std::size_t points, double time_s)
    : legs_(legs),
      views_(views),
      kind_of_(team.kind_of),
      time_s_(time_s),
      routes_(scenario.fleet.size()),
      used_(views.size(), 0),
      best_(points, 0.0F) {
  for (const UavIndex uav : scenario.uavs()) takeoff_s_.push_back(legs.takeoff_s(uav));
}

/// Time from one stop to the next. @param to  if no view has this number: to where the pictures are delivered.
/// @param exact  false: a cheap lower bound.
double RouteSearch::edge_s(std::size_t uav, std::size_t from, std::size_t to, bool exact) {
  const std::size_t start = legs_.start_of(UavIndex{uav});
  if (to >= views_.size()) return from == start ? 0.0 : legs_.tail_s(from);
  return exact ? legs_.leg_s(from, to) : legs_.least_leg_s(from, to);
}

double RouteSearch::added_s(std::size_t uav, std::size_t position, std::size_t view, bool exact) {
  const std::vector<std::size_t>& stops = routes_[uav].stops;
  const std::size_t before = position == 0 ? legs_.start_of(UavIndex{uav}) : stops[position - 1];
  const std::size_t after = position == stops.size() ? views_.size() : stops[position];
  return edge_s(uav, before, view, exact) + edge_s(uav, view, after, exact) - routes_[uav].edges_s[position];
}

/// Finds the best positions by the lower bounds of times, and checks only these with exact times.
void RouteSearch::offer_places(std::size_t uav, std::size_t view, Insertion& best) {
  std::array<std::pair<double, std::size_t>, kEdgesTried> hopeful;
  hopeful.fill({kNever, 0});
  for (std::size_t position = 0; position <= routes_[uav].stops.size(); ++position) {
    std::pair<double, std::size_t> here{added_s(uav, position, view, false), position};
    for (auto& one : hopeful) {
      if (here < one) std::swap(here, one);
    }
  }
  for (const auto& [least_s, position] : hopeful) {
    if (least_s >= best.added_s) continue;
    const double exact_s = added_s(uav, position, view, true);
    if (exact_s >= best.added_s || routes_[uav].time_s + exact_s > time_s_) continue;
    best.uav = uav;
    best.position = position;
    best.added_s = exact_s;
  }
}

RouteSearch::Insertion RouteSearch::best_insertion(std::size_t view) {
  Insertion best;
  best.gain = gain_of(views_[view], best_);
  if (used_[view] != 0 || best.gain < kLeastGain) return best;
  for (std::size_t uav = 0; uav < routes_.size(); ++uav) {
    if (kind_of_[uav] == views_[view].kind && takeoff_s_[uav] < kNever) offer_places(uav, view, best);
  }
  return best;
}

void RouteSearch::insert(std::size_t view, const Insertion& where) {
  Route& route = routes_[where.uav];
  route.stops.insert(route.stops.begin() + static_cast<std::ptrdiff_t>(where.position), view);
  used_[view] = 1;
  for (const Sight& sight : views_[view].sights) best_[sight.point] = std::max(best_[sight.point], sight.q);
  time_again(where.uav);
}

void RouteSearch::push_near(std::size_t view, std::vector<Later>& heap) {
  for (std::size_t other = 0; other < views_.size(); ++other) {
    if (used_[other] != 0 || (views_[other].p_WB - views_[view].p_WB).squaredNorm() > kNearStop * kNearStop) continue;
    const double rate = best_insertion(other).rate();
    if (rate <= 0.0) continue;
    heap.push_back({rate, other});
    std::push_heap(heap.begin(), heap.end());
  }
}

/// Lazy greedy: inserting views only lowers the gains of others. So a view that is still first in the heap after its
/// entry has been updated is the best one.
void RouteSearch::fill() {
  std::vector<Later> heap;
  for (std::size_t view = 0; view < views_.size(); ++view) {
    if (const double rate = best_insertion(view).rate(); rate > 0.0) heap.push_back({rate, view});
  }
  std::make_heap(heap.begin(), heap.end());
  while (!heap.empty()) {
    const Later first = heap.front();
    std::pop_heap(heap.begin(), heap.end());
    heap.pop_back();
    if (used_[first.view] != 0) continue;
    const Insertion where = best_insertion(first.view);
    if (where.rate() <= 0.0) continue;
    if (!heap.empty() && where.rate() < 0.999 * heap.front().rate) {
      heap.push_back({where.rate(), first.view});
      std::push_heap(heap.begin(), heap.end());
      continue;
    }
    insert(first.view, where);
    push_near(first.view, heap);
  }
}

void RouteSearch::time_again(std::size_t uav) {
  Route& route = routes_[uav];
  route.edges_s.clear();
  std::size_t at = legs_.start_of(UavIndex{uav});
  for (const std::size_t stop : route.stops) {
    route.edges_s.push_back(edge_s(uav, at, stop, true));
    at = stop;
  }
  route.edges_s.push_back(edge_s(uav, at, views_.size(), true));
  route.time_s = std::accumulate(route.edges_s.begin(), route.edges_s.end(), takeoff_s_[uav]);
}

void RouteSearch::count_again() {
  std::ranges::fill(best_, 0.0F);
  std::ranges::fill(used_, std::uint8_t{0});
  for (const Route& route : routes_) {
    for (const std::size_t stop : route.stops) {
      used_[stop] = 1;
      for (const Sight& sight : views_[stop].sights) best_[sight.point] = std::max(best_[sight.point], sight.q);
    }
  }
}

double RouteSearch::score() const { return std::accumulate(best_.begin(), best_.end(), 0.0); }

double RouteSearch::time() const {
  double sum = 0.0;
  for (const Route& route : routes_) sum += route.stops.empty() ? 0.0 : route.time_s;
  return sum;
}

void RouteSearch::drop(const std::vector<std::uint8_t>& dropped) {
  for (std::size_t uav = 0; uav < routes_.size(); ++uav) {
    std::erase_if(routes_[uav].stops, [&](std::size_t stop) { return dropped[stop] != 0; });
    time_again(uav);
  }
  count_again();
}

/// By view: the loss of score if this view alone were removed.
std::vector<double> RouteSearch::losses() const {
  std::vector<float> second(best_.size(), 0.0F);
  std::vector<std::size_t> owner(best_.size(), views_.size());
  for (const Route& route : routes_) {
    for (const std::size_t stop : route.stops) {
      for (const Sight& sight : views_[stop].sights) {
        if (sight.q == best_[sight.point] && owner[sight.point] == views_.size()) {
          owner[sight.point] = stop;
        } else {
          second[sight.point] = std::max(second[sight.point], sight.q);
        }
      }
    }
  }
  std::vector<double> losses(views_.size(), 0.0);
  for (std::size_t point = 0; point < owner.size(); ++point) {
    if (owner[point] < views_.size()) losses[owner[point]] += best_[point] - second[point];
  }
  return losses;
}

/// Removes the stops with the least score per second. @param share  of all stops, [0, 1].
void RouteSearch::drop_cheap(double share) {
  const std::vector<double> lost = losses();
  std::vector<std::pair<double, std::size_t>> rates;
  for (std::size_t uav = 0; uav < routes_.size(); ++uav) {
    const std::vector<std::size_t>& stops = routes_[uav].stops;
    for (std::size_t i = 0; i < stops.size(); ++i) {
      const std::size_t before = i == 0 ? legs_.start_of(UavIndex{uav}) : stops[i - 1];
      const std::size_t after = i + 1 == stops.size() ? views_.size() : stops[i + 1];
      const double spent_s =
          edge_s(uav, before, stops[i], true) + edge_s(uav, stops[i], after, true) - edge_s(uav, before, after, false);
      rates.emplace_back(lost[stops[i]] / std::max(spent_s, kLeastAdded_s), stops[i]);
    }
  }
  std::ranges::sort(rates);
  std::vector<std::uint8_t> dropped(views_.size(), 0);
  const auto count = static_cast<std::size_t>(share * static_cast<double>(rates.size()));
  for (std::size_t i = 0; i < rates.size(); ++i) {
    if (i < count || lost[rates[i].second] < kLeastGain) dropped[rates[i].second] = 1;
  }
  drop(dropped);
}

void RouteSearch::drop_about(std::size_t view, double radius) {
  std::vector<std::uint8_t> dropped(views_.size(), 0);
  for (std::size_t i = 0; i < views_.size(); ++i) {
    dropped[i] = (views_[i].p_WB - views_[view].p_WB).norm() < radius ? 1 : 0;
  }
  drop(dropped);
}

std::vector<Route> RouteSearch::search(const PlanConfig& config) {
  for (std::size_t uav = 0; uav < routes_.size(); ++uav) time_again(uav);
  fill();
  RandomStream random(config.seed, "oracle_plan", std::uint64_t{0});
  for (std::size_t round = 0; round < config.rounds; ++round) {
    const std::vector<Route> kept = routes_;
    const double kept_score = score(), kept_time = time();
    if (round % 2 == 0) {
      drop_cheap(random.uniform(0.05, 0.25));
    } else {
      const auto about = static_cast<std::size_t>(random.uniform() * static_cast<double>(views_.size()));
      drop_about(std::min(about, views_.size() - 1), random.uniform(5.0, 20.0));
    }
    for (std::size_t uav = 0; uav < routes_.size(); ++uav) shorten(uav);
    fill();
    for (std::size_t uav = 0; uav < routes_.size(); ++uav) shorten(uav);
    const double change = score() - kept_score;
    if (change > 1e-9 || (change > -1e-9 && time() < kept_time)) continue;
    routes_ = kept;
    count_again();
  }
  return routes_;
}

}  // namespace skein::sim
