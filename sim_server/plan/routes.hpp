// Assigns views to UAVs, and sets their order: a team orienteering problem with a score that saturates. The solver is a
// local search, so its score is a lower bound of the optimum.
// Units: SI.
#pragma once

#include <cstddef>
#include <vector>

#include "sim_server/plan/legs.hpp"

namespace skein::sim {

/// Route of one UAV.
struct Route {
  std::vector<std::size_t> stops;  ///< views, in the order in which the UAV takes them
  std::vector<double> edges_s;     ///< times to each stop, and from the last one to where the pictures are delivered
  double time_s = 0.0;             ///< when the last picture has been delivered
};

/// Not thread-safe.
class RouteSearch {
 public:
  /// @param points  number of points in the scene.   @param time_s  deadline for the delivery of the last picture.
  RouteSearch(Legs& legs, const Scenario& scenario, const Team& team, const std::vector<View>& views,
              std::size_t points, double time_s);

  /// Fills the routes greedily, by gain per second. Then, `rounds` times, removes a part of the stops, fills the routes
  /// again, and keeps the result if it is better. @returns a route for each UAV, in fleet order.
  std::vector<Route> search(const PlanConfig& config);

 private:
  struct Insertion;
  struct Later;

  double edge_s(std::size_t uav, std::size_t from, std::size_t to, bool exact);
  double added_s(std::size_t uav, std::size_t position, std::size_t view, bool exact);
  void offer_places(std::size_t uav, std::size_t view, Insertion& best);
  Insertion best_insertion(std::size_t view);
  void insert(std::size_t view, const Insertion& where);
  void fill();
  void push_near(std::size_t view, std::vector<Later>& heap);
  void time_again(std::size_t uav);
  void count_again();
  double score() const;
  double time() const;
  void drop_cheap(double share);
  void drop_about(std::size_t view, double radius);
  void drop(const std::vector<std::uint8_t>& dropped);
  std::vector<double> losses() const;
  void shorten(std::size_t uav);
  bool reverse_once(std::size_t uav);
  bool move_once(std::size_t uav);

  Legs& legs_;
  const std::vector<View>& views_;
  const std::vector<std::size_t>& kind_of_;
  double time_s_;
  std::vector<Route> routes_;
  std::vector<std::uint8_t> used_;  ///< by view
  std::vector<float> best_;         ///< by point: best quality in the views that are used
  std::vector<double> takeoff_s_;   ///< by UAV
};

}  // namespace skein::sim
