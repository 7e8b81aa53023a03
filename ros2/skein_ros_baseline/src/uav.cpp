// CARIC's public baseline as an ordinary ROS 2 node: one for each UAV, under the UAV's namespace.
//
// Each UAV reports where it starts, the station (gcs.cpp) sends the list of all starts, and from this list each UAV
// computes the same teams. The explorer of a team flies to the next region and surveys the first layer of each
// photographer's section, cell by cell along the structure. A photographer begins to inspect its section when the
// explorer has surveyed it: in every third layer, it looks at the structure's faces from each cell beside them. The
// explorer inspects the last section itself. When all UAVs of the team have finished, or `patience_s` after the
// explorer has, the team flies to the next region, and after the last region home.
#include <algorithm>
#include <cmath>
#include <memory>

#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/point_cloud.hpp>
#include <sensor_msgs/msg/point_cloud2.hpp>
#include <sensor_msgs/point_cloud2_iterator.hpp>

#include "grid.hpp"
#include "plan.hpp"
#include "radio.hpp"
#include "vehicle.hpp"

namespace baseline {

/// Within this distance [m] of a box, UAVs enter only cells that a LiDAR beam has crossed.
constexpr double kDoubtM = 2.25;

enum class Stage { report, climb, go, survey, wait, inspect, gather, home };
constexpr const char* kStageNames[] = {"reports", "climbs",   "goes to the entry", "surveys",
                                       "waits",   "inspects", "gathers",           "goes home"};

class Uav : public rclcpp::Node {
 public:
  Uav();

 private:
  void hear_boxes(const sensor_msgs::msg::PointCloud& cloud);
  void hear_scan(const sensor_msgs::msg::PointCloud2& cloud);
  void hear_neighbours(const sensor_msgs::msg::PointCloud2& cloud);

  // Timers: fly() every 50 ms, plan() twice a second.
  void fly();
  void plan();
  void decide();
  void share();

  void report();
  void join_team(const std::map<std::string, Start>& fleet);
  void lead();
  void follow_leader();
  /// Continues the inspection of a layer. @returns false once it has no cell left that the UAV can reach
  bool work_at(int layer);
  /// Continues the inspection of a section: from layer_ on, of every `layer_step`th layer. @returns false at its end
  bool inspect(int section);
  bool go_to(const Grid::Test& is_goal);
  bool go_to_rim(int layer, bool only_new);
  void next_region(int region);
  void enter(Stage stage);
  bool must_go_home() const;

  /// Whether another UAV is in the cell, or has claimed it.
  bool is_taken(const Cell& cell, const std::vector<Cell>& claimed) const;
  bool leads() const { return team_.members.front() == radio_.name(); }
  const Region& region() const { return team_.regions[work_.region]; }
  std::vector<int> sections() const { return region().sections(static_cast<int>(team_.members.size())); }

  Grid grid_;
  Vehicle vehicle_;
  Radio radio_;
  const int layer_step_;
  const double patience_s_, return_s_;
  bool is_explorer_ = false;
  std::vector<Region> boxes_;
  std::vector<Vector> others_W_;  ///< positions of the UAVs in line of sight
  Stage stage_ = Stage::report;
  Team team_;
  Cell home_;
  Work work_;
  int section_ = 0;  ///< the section that this UAV inspects: the last one if it leads
  int layer_ = 0;    ///< the layer that it inspects
  int misses_ = 0;   ///< successive searches that found no path
  double stage_since_s_ = 0.0, starts_at_s_ = 0.0;
  double decides_at_s_ = 0.0;  ///< next decision; after a failed search half a second later
  std::vector<rclcpp::SubscriptionBase::SharedPtr> heard_;
  std::vector<rclcpp::TimerBase::SharedPtr> timers_;
};

Uav::Uav()
    : Node("baseline_uav"),
      vehicle_(*this),
      radio_(*this, grid_),
      layer_step_(static_cast<int>(declare_parameter("layer_step", 3))),
      patience_s_(declare_parameter("patience_s", 60.0)),
      return_s_(declare_parameter("return_s", 20.0)) {
  heard_.push_back(create_subscription<sensor_msgs::msg::PointCloud>(
      "/gcs/bounding_box_vertices", rclcpp::QoS(1).transient_local(),
      [this](const sensor_msgs::msg::PointCloud& m) { hear_boxes(m); }));
  heard_.push_back(create_subscription<sensor_msgs::msg::PointCloud2>(
      "cloud_inW", 8, [this](const sensor_msgs::msg::PointCloud2& m) { hear_scan(m); }));
  heard_.push_back(create_subscription<sensor_msgs::msg::PointCloud2>(
      "nbr_odom_cloud", 8, [this](const sensor_msgs::msg::PointCloud2& m) { hear_neighbours(m); }));
  timers_.push_back(create_wall_timer(std::chrono::milliseconds(50), [this] { fly(); }));
  timers_.push_back(create_wall_timer(std::chrono::milliseconds(500), [this] { plan(); }));
}

void Uav::hear_boxes(const sensor_msgs::msg::PointCloud& cloud) {
  boxes_.clear();
  for (std::size_t i = 0; i + 8 <= cloud.points.size(); i += 8) {
    std::vector<Vector> vertices;
    for (std::size_t j = i; j < i + 8; ++j) {
      vertices.emplace_back(cloud.points[j].x, cloud.points[j].y, cloud.points[j].z);
    }
    boxes_.push_back(box_of(vertices));
  }
  grid_.doubt([&](const Cell& cell) {
    return std::any_of(boxes_.begin(), boxes_.end(),
                       [p_W = middle_of(cell)](const Region& box) { return box.distance(p_W) < kDoubtM; });
  });
}

void Uav::hear_scan(const sensor_msgs::msg::PointCloud2& cloud) {
  is_explorer_ = true;
  sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x"), y(cloud, "y"), z(cloud, "z");
  const Vector lidar_W = vehicle_.p_WB() + Vector(0.0, 0.0, 0.2);
  for (; x != x.end(); ++x, ++y, ++z) {
    const Vector p_W(*x, *y, *z);
    const double distance_m = (p_W - lidar_W).norm();
    for (double m = 0.0; m < distance_m - 0.5 * kCellM; m += 0.5 * kCellM) {
      radio_.found(cell_at(lidar_W + m / distance_m * (p_W - lidar_W)), false);
    }
    const bool is_uav = std::any_of(others_W_.begin(), others_W_.end(),
                                    [&](const Vector& other) { return (other - p_W).norm() < 1.5; });
    if (p_W.z() < 0.3 || is_uav) continue;  // the ground, or another UAV
    radio_.found(cell_at(p_W), true);
  }
}

void Uav::hear_neighbours(const sensor_msgs::msg::PointCloud2& cloud) {
  others_W_.clear();
  sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x"), y(cloud, "y"), z(cloud, "z"), node(cloud, "intensity");
  for (; x != x.end(); ++x, ++y, ++z, ++node) {
    if (*node > 0.0F) others_W_.emplace_back(*x, *y, *z);  // 0 is the station
  }
}

bool Uav::is_taken(const Cell& cell, const std::vector<Cell>& claimed) const {
  if (std::find(claimed.begin(), claimed.end(), cell) != claimed.end()) return true;
  return std::any_of(others_W_.begin(), others_W_.end(),
                     [&](const Vector& other) { return (other - middle_of(cell)).norm() < 0.95 * kCellM; });
}

void Uav::fly() {
  if (stage_ == Stage::report || now().seconds() < starts_at_s_) return;
  vehicle_.fly([this](const Cell& cell) {
    return stage_ != Stage::climb && (!grid_.is_open(cell) || is_taken(cell, radio_.claimed()));
  });
  if (vehicle_.has_arrived() && vehicle_.has_looked() && now().seconds() >= decides_at_s_) decide();
}

void Uav::plan() {
  if (!vehicle_.has_state()) return;
  if (stage_ == Stage::report) return report();
  if (stage_ != Stage::climb && stage_ != Stage::home && must_go_home()) {
    enter(Stage::home);
    vehicle_.stop();
  }
  share();
}

void Uav::decide() {
  if (stage_ == Stage::climb) {
    next_region(0);
  } else if (stage_ == Stage::home) {
    go_to([this](const Cell& cell) { return cell == home_; });
  } else {
    leads() ? lead() : follow_leader();
  }
}

void Uav::report() {
  const double now_s = now().seconds();
  if (stage_since_s_ == 0.0) stage_since_s_ = now_s;
  if (now_s > stage_since_s_ + 1.0)
    radio_.say_start({is_explorer_, vehicle_.p_WB()});  // an explorer has received a scan by then
  const auto fleet = radio_.fleet();
  if (fleet && !boxes_.empty()) join_team(*fleet);
}

void Uav::join_team(const std::map<std::string, Start>& fleet) {
  // UAVs take off in this order, and a UAV gives way to those before it: explorers first, each role by name.
  std::map<std::string, int> ranks;
  for (const bool explorers : {true, false}) {
    for (const auto& [name, start] : fleet) {
      if (start.explorer == explorers) ranks.emplace(name, static_cast<int>(ranks.size()));
    }
  }
  for (const Team& team : make_teams(fleet, boxes_)) {
    const auto self = std::find(team.members.begin(), team.members.end(), radio_.name());
    if (self == team.members.end()) continue;
    team_ = team;
    section_ = static_cast<int>(self - team.members.begin()) - 1;
    if (section_ < 0) section_ = static_cast<int>(team.members.size()) - 1;
  }
  const int rank = ranks.at(radio_.name());
  radio_.set_rank(std::move(ranks));
  const Cell start = cell_at(vehicle_.p_WB());
  std::vector<Cell> up;
  for (int z = 1; z <= 1 + rank; ++z) up.push_back({start.x, start.y, z});
  home_ = up.back();
  vehicle_.follow(up);
  starts_at_s_ = now().seconds() + 2.0 * rank;
  enter(Stage::climb);
}

void Uav::next_region(int region) {
  work_ = {region, 0, false, 0.0};
  misses_ = 0;
  stage_since_s_ = now().seconds();
  enter(region < static_cast<int>(team_.regions.size()) ? Stage::go : Stage::home);
}

void Uav::enter(Stage stage) {
  stage_ = stage;
  RCLCPP_INFO(get_logger(), "%.1f s: %s, region %d of %zu", now().seconds(), kStageNames[static_cast<int>(stage)],
              work_.region + 1, team_.regions.size());
}

bool Uav::must_go_home() const {
  const double way_m = (middle_of(home_) - vehicle_.p_WB()).lpNorm<1>();
  return vehicle_.time_left_s() && *vehicle_.time_left_s() < way_m / vehicle_.speed_mps() + return_s_;
}

void Uav::lead() {
  const std::vector<int> first = sections();
  const int last = static_cast<int>(team_.members.size()) - 1;
  if (stage_ == Stage::go) {
    if (go_to_rim(0, false)) enter(Stage::survey);
  } else if (stage_ == Stage::survey) {
    if (work_.surveyed < last && work_at(first[work_.surveyed])) return;
    if (work_.surveyed < last) {
      ++work_.surveyed;
    } else {
      layer_ = first[last];
      enter(Stage::inspect);
    }
  } else if (stage_ == Stage::inspect) {
    if (inspect(section_)) return;
    stage_since_s_ = now().seconds();
    enter(Stage::gather);
  } else if (stage_ == Stage::gather) {
    const bool all_done = std::all_of(team_.members.begin() + 1, team_.members.end(), [&](const std::string& name) {
      const Work* work = radio_.work_of(name);
      return work != nullptr && work->region == work_.region && work->done;
    });
    if (all_done || now().seconds() > stage_since_s_ + patience_s_) next_region(work_.region + 1);
  }
}

void Uav::follow_leader() {
  const Work* leader = radio_.work_of(team_.members.front());
  const double now_s = now().seconds();
  if (leader != nullptr && leader->region > work_.region) return next_region(leader->region);
  if (stage_ == Stage::go) {
    if (go_to_rim(0, false)) enter(Stage::wait);
  } else if (stage_ == Stage::wait) {
    const bool surveyed = leader != nullptr && leader->region == work_.region && leader->surveyed > section_;
    const bool silent = now_s > std::max(leader == nullptr ? 0.0 : leader->heard_s, stage_since_s_) + patience_s_;
    if (!surveyed && !silent) return;
    layer_ = sections()[section_];
    enter(Stage::inspect);
  } else if (stage_ == Stage::inspect) {
    if (inspect(section_)) return;
    work_.done = true;
    enter(Stage::gather);
  } else if (stage_ == Stage::gather) {
    go_to_rim(0, false);
  }
}

bool Uav::inspect(int section) {
  const std::vector<int> first = sections();
  if (layer_ < first[section + 1] && !work_at(layer_)) layer_ += layer_step_;
  return layer_ < first[section + 1];
}

bool Uav::work_at(int layer) {
  const Cell here = vehicle_.cell();
  bool empty = true;
  const auto is_next = [&](const Cell& cell) {
    if (region().layer_of(middle_of(cell)) != layer || !grid_.touches_structure(cell)) return false;
    empty = false;
    return !grid_.is_visited(cell);
  };
  if (is_next(here) && vehicle_.has_arrived()) {
    grid_.visit(here);
    vehicle_.look_around(grid_);
    return true;
  }
  if (go_to(is_next) || (empty && go_to_rim(layer, true))) {
    misses_ = 0;
    return true;
  }
  // Other UAVs may be in the way for a moment.
  if (++misses_ < 4) return true;
  misses_ = 0;
  return false;
}

bool Uav::go_to_rim(int layer, bool only_new) {
  const auto is_rim = [&](const Cell& cell) {
    const double beside = region().distance_beside(middle_of(cell));
    return region().layer_of(middle_of(cell)) == layer && beside > 0.5 * kCellM && beside < 2.0 * kCellM &&
           !(only_new && grid_.is_visited(cell));
  };
  const bool found = go_to(is_rim);
  if (found && only_new) grid_.visit(vehicle_.way().empty() ? vehicle_.cell() : vehicle_.way().back());
  return found;
}

bool Uav::go_to(const Grid::Test& is_goal) {
  const std::vector<Cell> claimed = radio_.claimed();
  std::vector<Cell> way;
  if (!grid_.find_way(
          vehicle_.cell(), is_goal, [&](const Cell& cell) { return is_taken(cell, claimed); }, way)) {
    decides_at_s_ = now().seconds() + 0.5;
    return false;
  }
  if (!way.empty()) vehicle_.follow(way);
  return true;
}

void Uav::share() {
  std::vector<Cell> cells = {vehicle_.cell()};
  for (std::size_t i = 0; i < 2 && i < vehicle_.way().size(); ++i) cells.push_back(vehicle_.way()[i]);
  radio_.say_at(cells);
  radio_.say_work(work_);
  radio_.say_map();
}

}  // namespace baseline

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<baseline::Uav>());
  rclcpp::shutdown();
}
