#include "bench/sensing/study.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "bench/sensing/explorer.hpp"
#include "core/math/random_stream.hpp"
#include "idl/cdr.hpp"
#include "idl/conversions.hpp"
#include "process/host/thread_cpu.hpp"
#include "scenes/surface_sampling.hpp"
#include "sight/ray_scene.hpp"
#include "uav_agent/flight/site.hpp"
#include "uav_agent/maps/world_mapper.hpp"

namespace skein::bench {
namespace {

using agent::Space;

constexpr int kSiteBoxRays = 16;        // in a box that holds a whole site (agent::is_site_box())
constexpr double kEdgeM = 0.5;          // edge of a picture's squares
constexpr double kOffM = 0.5;           // minimum clearance of space that counts as truly free
constexpr std::size_t kDraws = 60'000;  // sample points in space, all bands together
constexpr std::size_t kSurface = 3000;  // sample points on surfaces
constexpr double kSurfaceReachM = 20.0;

class Study {
 public:
  Study(const Site& site, std::uint64_t seed)
      : site_(site),
        rays_(site.scene.mesh),
        surface_(sim::sample_surface(site.scene.mesh, site.scene.boxes, kSurface, 1)),
        mapper_(*lone_explorer(site.start).fleet.front().vehicle.lidar, {}),
        explorer_(lone_explorer(site.start), site.scene, seed, planner()) {
    result_.name = site.name;
    result_.stem = site.stem;
    const bool in_site_box = std::ranges::any_of(site.scene.boxes, agent::is_site_box);
    result_.rays = in_site_box ? kSiteBoxRays : agent::kProofRays;
  }

  SiteStudy fly(const std::vector<double>& times_s) {
    for (const double time_s : times_s) {
      while (!hovering_s_ || *hovering_s_ < time_s) {
        explorer_.step();
        count_messages();
        if (!explorer_.alive()) throw std::runtime_error("the explorer did not survive its flight at " + site_.name);
      }
      take(time_s);
    }
    result_.level = picture("level slice at the UAV's height", level_plane(), &Snapshot::level);
    result_.upright = picture("upright slice through its way", upright_plane(), &Snapshot::upright);
    return std::move(result_);
  }

 private:
  std::unique_ptr<agent::Planner> planner() {
    return std::make_unique<RoutePlanner>(RoutePlanner::Config{.along_W = site_.along_W},
                                          [this](const RoutePlanner::Seen& seen) { look(seen); });
  }

  void look(const RoutePlanner::Seen& seen) {
    hovering_s_ = seen.hovering_s;
    route_W_.push_back(seen.state.p_WB);
    const double before_s = thread_cpu_s();
    for (const agent::BeamScan& scan : seen.beam_scans) mapper_.insert(scan);
    if (hovering_s_) insert_cpu_s_ += thread_cpu_s() - before_s;
  }

  void count_messages() {
    Messages& messages = result_.messages;
    for (const sim::LidarEvent& event : explorer_.events().scans) {
      const std::size_t bytes = encoded_size(to_cloud(event.scan.tick, event.scan.points_W));
      ++messages.scans;
      messages.points += event.scan.points_W.size();
      messages.cloud_bytes += bytes;
      messages.most_cloud_bytes = std::max(messages.most_cloud_bytes, bytes);
    }
    for (const sim::ServoEvent& event : explorer_.events().servos) {
      messages.servo_bytes = std::max(messages.servo_bytes, encoded_size(to_lidar_servo(event.servo)));
    }
  }

  /// What the map of key frames knows of a point.
  Space today(const Vector3d& p_W) const {
    if (explorer_.map().occupied(p_W)) return Space::occupied;
    return explorer_.map().known_free(p_W, result_.rays) ? Space::free : Space::unknown;
  }

  void take(double time_s) {
    Snapshot snapshot;
    snapshot.time_s = time_s;
    const std::string label = fmt::format("after {:.0f} s: {:.0f} m above the ground", time_s, route_W_.back().z());
    snapshot.level = row(label, level_plane());
    snapshot.upright = row(label, upright_plane());
    measure(snapshot.bands);
    measure(snapshot.surface);
    snapshot.insert_cpu_s = insert_cpu_s_;
    snapshot.world_bytes = mapper_.map().counts().bytes;
    result_.snapshots.push_back(std::move(snapshot));
  }

  Plane level_plane() const {
    const Vector3d middle_W(site_.middle_W.x(), site_.middle_W.y(), route_W_.back().z());
    return {middle_W - 0.5 * Vector3d(site_.width_m, site_.depth_m, 0.0), Vector3d::UnitX(), Vector3d::UnitY(),
            site_.width_m, site_.depth_m};
  }
  Plane upright_plane() const {
    const Vector3d foot_W(site_.middle_W.x(), site_.middle_W.y(), 0.0);
    return {foot_W - 0.5 * site_.width_m * site_.across_W, site_.across_W, Vector3d::UnitZ(), site_.width_m,
            site_.top_m};
  }

  PictureRow row(const std::string& label, const Plane& plane) const {
    PictureRow row{.label = label, .today = {}, .world = {}, .cut = cut_of(site_.scene.mesh, plane), .route = {}};
    row.today = squares_of(plane, kEdgeM, [&](const Vector3d& p_W) { return today(p_W); });
    row.world = squares_of(plane, kEdgeM, [&](const Vector3d& p_W) { return mapper_.map().at(p_W); });
    for (const Vector3d& p_W : route_W_) row.route.push_back(plane.in_plane(p_W));
    return row;
  }

  Picture picture(const std::string& slice, const Plane& plane, PictureRow Snapshot::*row) const {
    Picture picture{.title = fmt::format("{}, {}: {}", site_.title, site_.route, slice),
                    .width_m = plane.width_m,
                    .height_m = plane.height_m,
                    .rows = {}};
    for (const Snapshot& snapshot : result_.snapshots) picture.rows.push_back(snapshot.*row);
    return picture;
  }

  double distance_to_route_m(const Vector3d& p_W) const {
    double nearest = std::numeric_limits<double>::max();
    constexpr std::size_t kStride = 5;  // at most 0.5 m of flight
    for (std::size_t i = 0; i < route_W_.size(); i += kStride) {
      nearest = std::min(nearest, (route_W_[i] - p_W).squaredNorm());
    }
    return std::sqrt(nearest);
  }

  void measure(std::array<Band, 3>& bands) const {
    Vector3d low_W = route_W_.front(), high_W = low_W;
    for (const Vector3d& p_W : route_W_) {
      low_W = low_W.cwiseMin(p_W);
      high_W = high_W.cwiseMax(p_W);
    }
    low_W -= Vector3d::Constant(bands.back().to_m);
    high_W += Vector3d::Constant(bands.back().to_m);
    low_W.z() = kOffM;
    RandomStream random(1, "sensed_space", 0);
    const double m3_a_draw = (high_W - low_W).prod() / static_cast<double>(kDraws);
    for (std::size_t i = 0; i < kDraws; ++i) {
      Vector3d p_W;
      for (int axis = 0; axis < 3; ++axis) p_W[axis] = random.uniform(low_W[axis], high_W[axis]);
      const double distance = distance_to_route_m(p_W);
      const auto band = std::ranges::find_if(bands, [&](const Band& one) { return distance < one.to_m; });
      if (band == bands.end() || rays_.clearance(p_W, kOffM) < kOffM) continue;
      band->free_m3 += m3_a_draw;
      if (today(p_W) == Space::free) band->today += m3_a_draw;
      if (mapper_.map().at(p_W) == Space::free) band->world += m3_a_draw;
    }
    for (Band& band : bands) {
      band.today /= std::max(band.free_m3, m3_a_draw);
      band.world /= std::max(band.free_m3, m3_a_draw);
    }
  }

  void measure(Surface& surface) const {
    for (const InterestPoint& point : surface_) {
      const Vector3d p_W = point.p_W.cast<double>();
      if (distance_to_route_m(p_W) > kSurfaceReachM) continue;
      const Space today_says = today(p_W), world_says = mapper_.map().at(p_W);
      ++surface.places;
      surface.today_free += today_says == Space::free;
      surface.today_occupied += today_says == Space::occupied;
      surface.world_free += world_says == Space::free;
      surface.world_occupied += world_says == Space::occupied;
    }
  }

  const Site& site_;
  const sim::RayScene rays_;
  const std::vector<InterestPoint> surface_;
  agent::WorldMapper mapper_;
  SiteStudy result_;
  std::vector<Vector3d> route_W_;  ///< by exchange, from the ground on
  std::optional<double> hovering_s_;
  double insert_cpu_s_ = 0.0;
  Explorer explorer_;
};

}  // namespace

SiteStudy study_of(const Site& site, const std::vector<double>& times_s, std::uint64_t seed) {
  return Study(site, seed).fly(times_s);
}

}  // namespace skein::bench
