#include "oracle/oracle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>

#include "oracle/best_aim.hpp"
#include "oracle/open_space.hpp"
#include "oracle/share_out.hpp"
#include "oracle/view_search.hpp"
#include "sight/camera_mount.hpp"

namespace skein::sim {
namespace {

constexpr double kFaintest = 1e-6;  ///< least quality that ends a search if `min_point_score` is 0

std::vector<Vector3d> starts_of(const Scenario& scenario) {
  std::vector<Vector3d> starts;
  for (const UavConfig& uav : scenario.fleet) {
    starts.emplace_back(uav.start.x(), uav.start.y(), 0.5 * uav.vehicle.collision_box_m.z());
  }
  return starts;
}

/// Open spaces by clearance, each computed once, on demand.
class Spaces {
 public:
  Spaces(const RayScene& world, const TriangleMesh& mesh, const Scenario& scenario, unsigned threads)
      : world_(world), structure_(box_around(mesh)), starts_(starts_of(scenario)), threads_(threads) {}

  const OpenSpace* with(double clearance) {
    auto& space = by_clearance_[clearance];
    if (!space) space = std::make_unique<OpenSpace>(world_, structure_, clearance, starts_, threads_);
    return space.get();
  }

 private:
  const RayScene& world_;
  Eigen::AlignedBox3d structure_;
  std::vector<Vector3d> starts_;
  unsigned threads_;
  std::map<double, std::unique_ptr<OpenSpace>> by_clearance_;
};

/// Clearance from the structure that one kind of camera (or its body's centre) must keep [m].
double needed_clearance(const CameraKind& kind, Berth berth, double clearance) {
  return berth == Berth::camera ? clearance : Body(kind.body).radius + clearance;
}

Viewer viewer_of(const CameraKind& kind, const Scenario& scenario, double clearance,
                 std::vector<const OpenSpace*> spaces) {
  return {BestAim(kind, scenario.desired_mm_per_pixel, scenario.rules),
          CameraMount(kind, scenario.rules.own_body_hides), clearance, std::move(spaces)};
}

/// @param wide_berth  places must also be next to open space with this clearance [m]; 0: no such condition.
std::vector<Viewer> viewers(const Scenario& scenario, const OracleConfig& config, double wide_berth, Spaces& spaces) {
  std::vector<Viewer> all;
  std::vector<std::array<double, 5>> optics;
  for (const CameraKind& kind : camera_kinds(scenario)) {
    const double needed = needed_clearance(kind, config.berth, config.clearance_m);
    all.push_back(viewer_of(kind, scenario, needed, {spaces.with(needed)}));
    if (wide_berth > 0.0) all.back().spaces.push_back(spaces.with(std::max(needed, wide_berth)));
    const auto known = std::ranges::find(optics, kind.optics());
    all.back().optics = static_cast<std::size_t>(known - optics.begin());
    if (known == optics.end()) optics.push_back(kind.optics());
  }
  return all;
}

bool counts(const PointView& view, double least) { return view.q >= least && view.q > 0.0; }

Attainable sum_up(const std::vector<PointView>& views, double least) {
  Attainable sum;
  for (const PointView& view : views) {
    if (!counts(view, least)) continue;
    ++sum.points;
    sum.score += static_cast<float>(view.q);  // single precision, as for captures: differences of the two are exact
  }
  return sum;
}

/// Finds the attainable points that a whole UAV can photograph. Tries the kind with the smallest body first, and larger
/// kinds only for the remaining points.
class FlyablePoints {
 public:
  FlyablePoints(const Scenario& scenario, const Scene& scene, const OracleConfig& config, const RayScene& world,
                Spaces& spaces)
      : scenario_(scenario), scene_(scene), config_(config), world_(world), spaces_(spaces) {}

  std::vector<std::uint8_t> among(const std::vector<PointView>& attainable) {
    flyable_.assign(attainable.size(), 0);
    for (std::size_t i = 0; i < attainable.size(); ++i) {
      if (counts(attainable[i], least_)) open_.push_back(i);
    }
    std::vector<CameraKind> kinds = camera_kinds(scenario_);
    std::ranges::stable_sort(kinds, {}, [](const CameraKind& kind) { return Body(kind.body).radius; });
    for (const CameraKind& kind : kinds) {
      const double needed = Body(kind.body).radius;
      // An open space with more clearance is a subset of the one that the body needs, and is known already. So it is
      // searched first, and the body's own space, which costs time, is computed only for the remaining points.
      const double known = config_.clearance_m >= needed ? config_.clearance_m : config_.outside_berth_m;
      if (known > needed) search(kind, needed, known);
      search(kind, needed, needed);
    }
    return flyable_;
  }

 private:
  void search(const CameraKind& kind, double needed, double space) {
    if (open_.empty()) return;
    const std::vector<Viewer> alone = {viewer_of(kind, scenario_, needed, {spaces_.with(space)})};
    const ViewSearch search(world_, alone, Berth::body, scenario_.rules);
    share_out(open_.size(), config_.threads, [&](std::size_t n) {
      const auto found = search.find(scene_.points[open_[n]], config_.directions, {}, std::max(least_, kFaintest));
      flyable_[open_[n]] = counts(found.fine, least_) ? 1 : 0;
    });
    std::erase_if(open_, [this](std::size_t i) { return flyable_[i] != 0; });
  }

  const Scenario& scenario_;
  const Scene& scene_;
  const OracleConfig& config_;
  const RayScene& world_;
  Spaces& spaces_;
  const double least_ = scenario_.rules.min_point_score;
  std::vector<std::uint8_t> flyable_;
  std::vector<std::size_t> open_;  ///< attainable points for which no kind has been found yet
};

}  // namespace

double expected_seconds(const Scenario& scenario, const Scene& scene, const OracleConfig& config) {
  constexpr double kPerLine = 1.5e-4, kPerLook = 5e-6;
  std::set<double> clearances;
  for (const CameraKind& kind : camera_kinds(scenario)) {
    const double needed = needed_clearance(kind, config.berth, config.clearance_m);
    clearances.insert({needed, std::max(needed, config.outside_berth_m)});
  }
  double lines = 0.0;
  for (const double clearance : clearances) {
    lines += static_cast<double>(OpenSpace::line_count(box_around(scene.mesh), clearance));
  }
  const double looks = static_cast<double>(scene.points.size() * config.directions);
  return (kPerLine * lines + kPerLook * looks) / std::max(1U, config.threads);
}

OracleReport consult_oracle(const Scenario& scenario, const Scene& scene, const OracleConfig& config) {
  if (!(config.clearance_m >= 0.0) || !std::isfinite(config.clearance_m) || config.directions == 0) {
    throw std::invalid_argument("the oracle needs a clearance of 0 m or more, and directions");
  }
  const RayScene world(scene.mesh);
  Spaces spaces(world, scene.mesh, scenario, config.threads);
  const auto everywhere = viewers(scenario, config, 0.0, spaces);
  const auto in_the_open = viewers(scenario, config, config.outside_berth_m, spaces);
  const ViewSearch from_reachable(world, everywhere, config.berth, scenario.rules);
  const ViewSearch from_outside(world, in_the_open, config.berth, scenario.rules);

  const double least = scenario.rules.min_point_score;
  const std::size_t count = scene.points.size();
  std::vector<ViewSearch::Found> reachable(count), outside(count);
  share_out(count, config.threads, [&](std::size_t i) {
    outside[i] = from_outside.find(scene.points[i], config.directions, {});
    reachable[i] = from_reachable.find(scene.points[i], config.directions, outside[i]);
  });

  const auto answer = [&](const std::vector<ViewSearch::Found>& found) {
    std::vector<PointView> coarse, fine;
    for (const ViewSearch::Found& views : found) {
      coarse.push_back(views.coarse);
      fine.push_back(views.fine);
    }
    return OracleAnswer{fine, sum_up(fine, least), sum_up(coarse, least)};
  };
  OracleReport report{answer(reachable), answer(outside), {}};
  if (config.berth == Berth::body) {  // all pictures are from a whole UAV
    for (const PointView& view : report.reachable.best) report.flyable.push_back(counts(view, least) ? 1 : 0);
  } else {
    report.flyable = FlyablePoints(scenario, scene, config, world, spaces).among(report.reachable.best);
  }
  return report;
}

}  // namespace skein::sim
