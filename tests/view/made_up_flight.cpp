#include "made_up_flight.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/scoring/camera_quality.hpp"
#include "process/json_text.hpp"
#include "view/cube_runs.hpp"
#include "view/look_order.hpp"
#include "view/scan_points.hpp"

namespace skein::test {
namespace {

constexpr std::size_t kTowers = 4;
constexpr double kTau = 2.0 * std::numbers::pi;
constexpr double kRadius_m = 5.0, kHeight_m = 24.0, kSpacing_m = 32.0;
constexpr double kOrbit_m = 5.5;                      ///< mean distance of a UAV from the wall of its tower
constexpr double kTurn_rad_s = 0.25, kClimb_m = 4.0;  ///< angular rate around the tower; climb per circle
constexpr double kStay_s = 150.0, kMove_s = 12.0;
constexpr double kRadio_m = 45.0;
constexpr double kWindow_rad = 0.30, kWindow_m = 2.2;  ///< half of the field of view: angle about the tower, height
constexpr std::uint64_t kCapturePeriod = 3, kPosePeriod = 10, kLinksPeriod = 5;  ///< all periods in exchanges
constexpr std::uint64_t kActivityPeriod = 40;
constexpr std::uint64_t kCloudPeriod = 32, kMapPeriod = 1600;  ///< wall time at 8 times real time: 0.2 s, 10 s
constexpr std::size_t kDeliveries = 4;                         ///< most captures that a UAV delivers per exchange
const Vector3d kStation(0.0, -34.0, 0.3);

Vector3d axis_of(std::size_t tower) {
  return {(static_cast<double>(tower % 2) - 0.5) * kSpacing_m, (static_cast<double>(tower / 2) - 0.5) * kSpacing_m, 0};
}

/// Pseudo-random number in [0, 1): a hash of three integers.
double noise(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  std::uint64_t x = a * 0x9e3779b97f4a7c15U + b * 0xbf58476d1ce4e5b9U + c * 0x94d049bb133111ebU;
  for (int i = 0; i < 2; ++i) x = (x ^ (x >> 31U)) * 0xd6e8feb86659fd93U;
  return static_cast<double>(x >> 40U) / static_cast<double>(1U << 24U);
}

/// Whether the line of sight between two positions in W is clear of towers. Approximate: for each tower it checks only
/// the point of the line that is nearest to the tower's axis, seen from above.
bool in_sight(const Vector3d& a, const Vector3d& b) {
  for (std::size_t tower = 0; tower < kTowers; ++tower) {
    const Vector3d axis = axis_of(tower);
    const Eigen::Vector2d along = (b - a).head<2>(), from = (axis - a).head<2>();
    const double share = std::clamp(from.dot(along) / std::max(along.squaredNorm(), 1e-9), 0.0, 1.0);
    const double height = a.z() + share * (b.z() - a.z());
    if ((from - share * along).norm() < kRadius_m && height < kHeight_m) return false;
  }
  return true;
}

}  // namespace

MadeUpFlight::MadeUpFlight(MadeUpSize size, view::Feed& feed) : size_(size), feed_(feed), fleet_(size.uavs) {
  results::RunRecord run;
  const std::size_t each = size.points / kTowers, around = 50;
  const double levels = std::ceil(static_cast<double>(each) / around);
  for (std::size_t i = 0; i < each * kTowers; ++i) {
    const double angle = kTau * static_cast<double>(i % each % around) / around;
    const Vector3d out(std::cos(angle), std::sin(angle), 0.0);
    results::RunPoint point;
    point.normal_W = out;
    point.p_W = axis_of(i / each) + kRadius_m * out;
    point.p_W.z() = kHeight_m * (static_cast<double>(i % each / around) + 0.5) / levels;
    points_.push_back(point.p_W);
    run.points.push_back(point);
  }
  for (std::size_t i = 0; i < size.uavs; ++i) {
    run.uavs.push_back(fmt::format("uav{:02}", i));
    run.explorer.push_back(i % 5 < 2);
    fleet_[i].best.assign(points_.size(), 0.0F);
  }
  run.station = kStation;
  run.boxes.push_back(
      {"site", {0.0, 0.0, 0.5 * kHeight_m}, {56.0, 56.0, kHeight_m + 4.0}, Eigen::Matrix3d::Identity()});
  delivered_.assign(points_.size(), 0.0F);
  Json scene = view::scene_json(run, std::vector<CameraConfig>(size.uavs), std::vector<double>(size.uavs, 8.0));
  scene["mode"] = "live";
  scene["paced"] = true;
  scene["scenario"] = "made up";
  scene["title"] = "made up";
  scene["duration"] = 3600.0;
  scene["clouds"] = {{"lidar", run.uavs}, {"maps", run.uavs}};
  feed_.set_scene(scene.dump());
  for (const std::string& name : run.uavs) feed_.add_line(view::event_line(0.0, "joined", name, ""));
  move();
  tell_links();
  feed_.add_line(view::pose_line(0.0, [this] {
    std::vector<view::ShownUav> shown;
    for (const Uav& uav : fleet_) shown.push_back(uav.shown);
    return shown;
  }()));
  feed_.add_line(
      view::estimate_line(0.0, std::vector(points_.size(), 1.0F), std::vector<std::uint8_t>(points_.size(), 1)));
  tell_state();
}

/// Position of a UAV in W on its climbing circle around a tower. Every kStay_s the position jumps to the next tower:
/// move() replaces the last kMove_s before that with a smooth flight between the two towers.
/// @param tower  receives the index of the tower.
/// @param angle  receives the angle of the UAV about the tower's axis, from the x axis [rad].
Vector3d MadeUpFlight::place_of(std::size_t uav, double time_s, std::size_t& tower, double& angle) const {
  const double stay = std::floor(time_s / kStay_s), since_s = time_s - stay * kStay_s;
  tower = (uav + static_cast<std::size_t>(stay)) % kTowers;
  const double of_fleet = static_cast<double>(uav / kTowers) * static_cast<double>(kTowers) /
                          static_cast<double>(std::max<std::size_t>(size_.uavs, kTowers));
  angle = kTau * of_fleet + kTurn_rad_s * time_s;
  const double climbed = std::fmod(3.0 + 5.0 * of_fleet * kClimb_m + kClimb_m * kTurn_rad_s * since_s / kTau, 21.0);
  const double r = kRadius_m + kOrbit_m + 0.5 * std::sin(0.3 * time_s + static_cast<double>(uav));
  return axis_of(tower) + Vector3d(r * std::cos(angle), r * std::sin(angle), 1.5 + climbed);
}

void MadeUpFlight::move() {
  const double now_s = time_s();
  for (std::size_t i = 0; i < fleet_.size(); ++i) {
    Uav& uav = fleet_[i];
    const double left_s = kStay_s - std::fmod(now_s, kStay_s);
    Vector3d place = place_of(i, now_s, uav.tower, uav.angle);
    uav.works = left_s > kMove_s;
    if (!uav.works) {
      std::size_t tower = 0;
      double angle = 0.0;
      const Vector3d next = place_of(i, now_s + left_s, tower, angle);
      const double share = 1.0 - left_s / kMove_s;
      place += share * share * (3.0 - 2.0 * share) * (next - place);
    }
    uav.shown.body.p_WB = place;
    uav.shown.body.q_WB = Quaterniond(Eigen::AngleAxisd(uav.angle + std::numbers::pi, Vector3d::UnitZ()));
  }
}

/// Takes a picture: a capture with the points of the UAV's tower that are in its field of view and that this picture
/// shows clearly better than all of the UAV's pictures before. Without such points there is no capture.
void MadeUpFlight::photograph(std::size_t index) {
  Uav& uav = fleet_[index];
  const std::size_t each = points_.size() / kTowers;
  Capture capture;
  for (std::size_t i = uav.tower * each; i < (uav.tower + 1) * each; ++i) {
    const Vector3d from_axis = points_[i] - axis_of(uav.tower);
    const double up = std::abs(points_[i].z() - uav.shown.body.p_WB.z());
    if (up > kWindow_m) continue;
    const double aside = std::abs(std::remainder(std::atan2(from_axis.y(), from_axis.x()) - uav.angle, kTau));
    if (aside > kWindow_rad) continue;
    const double middle = (1.0 - 0.6 * aside / kWindow_rad) * (1.0 - 0.4 * up / kWindow_m);
    const auto blur = static_cast<float>(0.45 + 0.55 * noise(index, i, step_ / 60));
    const auto res = static_cast<float>(middle * (0.75 + 0.25 * noise(i, step_ / 900, index)));
    if (blur * res <= uav.best[i] + 0.12F) continue;
    uav.best[i] = blur * res;
    capture.points.push_back({static_cast<std::uint32_t>(i), blur, res, blur * res, std::min(res * 1.1F, 1.0F)});
  }
  if (capture.points.empty()) return;
  capture.number = uav.captures++;
  feed_.add_line(view::capture_line(time_s(), index, capture.number, capture.points));
  uav.waiting.push_back(std::move(capture));
}

void MadeUpFlight::tell_links() {
  const std::size_t nodes = fleet_.size() + 1;
  const auto place = [this](std::size_t node) { return node == 0 ? kStation : fleet_[node - 1].shown.body.p_WB; };
  std::vector<view::ShownLink> links(nodes * nodes, view::ShownLink::blocked);
  for (std::size_t a = 0; a < nodes; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if ((place(a) - place(b)).norm() > kRadio_m || !in_sight(place(a), place(b))) continue;
      links[a * nodes + b] = links[b * nodes + a] = view::ShownLink::linked;
    }
  }
  if (links == links_) return;
  links_ = std::move(links);
  feed_.add_line(view::links_line(time_s(), links_));
}

void MadeUpFlight::deliver(std::size_t index) {
  const std::size_t nodes = fleet_.size() + 1;
  if (links_[(index + 1) * nodes] != view::ShownLink::linked) return;
  Uav& uav = fleet_[index];
  for (std::size_t i = 0; i < kDeliveries && !uav.waiting.empty(); ++i) {
    for (const CapturePoint& point : uav.waiting.front().points) {
      float& best = delivered_[point.index];
      if (point.q < kDetectedQuality || point.q <= best) continue;
      scored_ += best == 0.0F ? 1 : 0;
      score_ += point.q - best;
      best = point.q;
    }
    deliveries_.push_back({index, uav.waiting.front().number});
    uav.waiting.pop_front();
  }
}

void MadeUpFlight::tell_state() {
  std::vector<view::ShownUav> shown;
  std::vector<std::optional<view::ShownNumbers>> numbers;
  for (const Uav& uav : fleet_) {
    shown.push_back(uav.shown);
    numbers.push_back(view::ShownNumbers{1.5, static_cast<std::uint32_t>(uav.waiting.size()), 0.0125});
  }
  feed_.set_state(fmt::format(
      R"({{"t":{:.3f},"tick":{},"mission":{:.3f},"phase":"flies","paused":false,"speed":"8","u":{},"a":{}}})", time_s(),
      step_ * 20, time_s(), view::poses_json(shown), view::numbers_json(numbers)));
}

/// Every two simulated seconds each UAV reports another activity.
void MadeUpFlight::tell_activities() {
  static constexpr std::array kModes = {"flies to a goal", "rests at its goal", "looks for a way", "delivers"};
  for (std::size_t i = 0; i < fleet_.size(); ++i) {
    const std::uint64_t turn = step_ + 7 * i;
    if (turn % kActivityPeriod != 0) continue;
    Activity activity{.mode = kModes[turn / kActivityPeriod % kModes.size()]};
    activity.goal_W = fleet_[i].shown.body.p_WB + Vector3d(6.0, 0.0, 2.0);
    if (turn / kActivityPeriod % 3 == 0) activity.waits_for = fmt::format("uav{:02}", (i + 1) % fleet_.size());
    feed_.add_line(view::activity_line(time_s(), i, activity));
  }
}

/// Gives the feed LiDAR points and maps of all UAVs, about as much as sim_server sends to a page that asks for them.
void MadeUpFlight::tell_clouds() {
  const view::LookBudget budget = view::look_budget(fleet_.size());
  const std::size_t each = budget.points / fleet_.size();
  for (std::size_t i = 0; i < fleet_.size(); ++i) {
    const std::string name = fmt::format("uav{:02}", i);
    view::PointsStep step{time_s(), {}};
    for (std::size_t k = 0; k < each; ++k) {
      const auto drawn = static_cast<std::size_t>(noise(i, k, step_) * static_cast<double>(points_.size()));
      step.points_W.push_back(points_[drawn].cast<float>());
    }
    feed_.set_cloud(view::lidar_cloud(name), view::lidar_text(name, std::span(&step, 1)));
    if (step_ % kMapPeriod != 0) continue;
    view::ShownMap map;
    for (const Vector3d& point : points_) {
      const Vector3d cell = point / map.cell_m;
      map.occupied.push_back({static_cast<int>(cell.x()), static_cast<int>(cell.y()), static_cast<int>(cell.z()), 1});
    }
    map.occupied = view::joined_runs(std::move(map.occupied));
    for (int y = -60; y < 60; ++y) map.free.push_back({-60, y, 10, 120});
    feed_.set_cloud(view::map_cloud(name), view::map_text(name, time_s(), map, "what it flies on"));
  }
}

void MadeUpFlight::step() {
  ++step_;
  move();
  if (step_ % kLinksPeriod == 0) tell_links();
  if (step_ % kPosePeriod == 0) {
    std::vector<view::ShownUav> shown;
    for (const Uav& uav : fleet_) shown.push_back(uav.shown);
    feed_.add_line(view::pose_line(time_s(), shown));
  }
  const double before = score_;
  for (std::size_t i = 0; i < fleet_.size(); ++i) {
    if ((step_ + i) % kCapturePeriod == 0 && fleet_[i].works) photograph(i);
    deliver(i);
  }
  if (!deliveries_.empty()) feed_.add_line(view::delivered_line(time_s(), deliveries_));
  deliveries_.clear();
  tell_activities();
  if (step_ % kCloudPeriod == 0) tell_clouds();
  if (score_ != before) feed_.add_line(view::score_line(time_s(), scored_, score_));
  tell_state();
}

}  // namespace skein::test
