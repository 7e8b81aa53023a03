#include "sim_server/view_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/euler.hpp"
#include "sim_server/camera.hpp"

namespace skein::sim {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();
/// The camera's least distance from a point, when no clearance asks for more [m].
constexpr double kNearest = 2.0 * Camera::kSurfaceTolerance;
/// Where rays from a point begin: just out of the surface that it lies on [m].
constexpr double kLiftOff = 0.03;
constexpr double kLeastStep = 0.05;  ///< along a direction that runs beside the structure [m]
constexpr double kReachStep = 0.5;   ///< along a direction where the camera is out of reach [m]
constexpr int kHalvings = 4;         ///< of the last such step
constexpr double kFinestTurn = 1.0 * kRadPerDeg;
constexpr int kMostRefinements = 16, kMostUnseen = 5;  ///< steps of a refinement; of one where nothing has been seen
constexpr std::array<std::array<double, 2>, 8> kNeighbours = {
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

/// 1 / g and 1 / g^2, g^3 = g + 1: the numbers whose multiples fill a square most evenly (Roberts' R2 sequence).
constexpr double kHeightStep = 0.7548776662466927, kAzimuthStep = 0.5698402909980532;

}  // namespace

/// A direction from the point, and what it is good for.
struct ViewSearch::Trial {
  Vector3d direction = Vector3d::UnitZ();
  /// How nearly a place there is free, in [0, 1]: leads the search while nothing has been seen.
  double openness = 0.0;
  PointView view;

  bool better_than(const Trial& other) const {
    return view.q != other.view.q ? view.q > other.view.q : openness > other.openness;
  }
};

/// The best picture so far, and the best few trials, the very best first.
class ViewSearch::Best {
 public:
  void know(const PointView& view) {
    if (view.q > view_.q) view_ = view;
  }
  void offer(const Trial& trial) {
    know(trial.view);
    for (std::size_t i = 0; i < trials_.size(); ++i) {
      if (!trial.better_than(trials_[i])) continue;
      std::move_backward(trials_.begin() + static_cast<std::ptrdiff_t>(i), trials_.end() - 1, trials_.end());
      trials_[i] = trial;
      return;
    }
  }
  const PointView& view() const { return view_; }
  bool perfect() const { return view_.q >= 1.0; }
  const std::array<Trial, 2>& trials() const { return trials_; }

 private:
  PointView view_;
  std::array<Trial, 2> trials_;
};

Vector3d sphere_direction(std::size_t n) {
  const auto part = [n](double step) {
    const double multiple = (static_cast<double>(n) + 0.5) * step;
    return multiple - std::floor(multiple);
  };
  const double z = 1.0 - 2.0 * part(kHeightStep), azimuth = 2.0 * std::numbers::pi * part(kAzimuthStep);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

ViewSearch::ViewSearch(const RayScene& world, const std::vector<BestAim>& cameras, double clearance,
                       std::vector<const OpenSpace*> spaces)
    : world_(world), cameras_(cameras), clearance_(clearance), reach_(0.0), spaces_(std::move(spaces)) {
  for (const BestAim& camera : cameras) reach_ = std::max(reach_, camera.reach());
}

bool ViewSearch::may_be_at(const Vector3d& p_WC) const {
  return std::ranges::all_of(spaces_, [&p_WC](const OpenSpace* space) { return space->reaches(p_WC); });
}

/// Distance of the first place along a direction where a camera may be, kNowhere if there is none.
double ViewSearch::nearest_place(const Vector3d& p_W, const Vector3d& direction, double until,
                                 double& openness) const {
  /// How far to go on from there; 0 where the camera may be.
  const auto step_on = [&](double d) {
    const Vector3d place = p_W + d * direction;
    // Of a surface the distance changes by no more than a metre a metre: what lacks of the clearance can be skipped.
    const double lacking = clearance_ - world_.clearance(place, clearance_);
    if (lacking > 0.0) openness = std::max(openness, 1.0 - lacking / clearance_);
    return lacking > 0.0 ? std::max(lacking, kLeastStep) : 0.0;
  };
  double refused = 0.0;  // the last place that was not
  for (double d = std::max(clearance_, kNearest); d < until && p_W.z() + d * direction.z() >= 0.0;) {
    const bool in_reach = may_be_at(p_W + d * direction);
    const double step = in_reach ? step_on(d) : kReachStep;
    if (step > 0.0) {
      refused = d;
      d += step;
      continue;
    }
    openness = 1.0;
    // The way into reach was taken in long steps: back to where it began.
    for (int i = 0; i < kHalvings && refused > 0.0; ++i) {
      const double middle = 0.5 * (refused + d);
      const bool allowed = may_be_at(p_W + middle * direction) && step_on(middle) == 0.0;
      (allowed ? d : refused) = middle;
    }
    return d;
  }
  return kNowhere;
}

ViewSearch::Trial ViewSearch::try_direction(const InterestPoint& point, const Vector3d& direction) const {
  const Vector3d p_W = point.p_W.cast<double>(), n_W = point.n_W.cast<double>();
  Trial trial{direction, 0.0, {}};
  const auto hit = world_.first_hit(p_W + kLiftOff * direction, direction, reach_);
  const double until = hit ? kLiftOff + hit->distance : reach_;
  const double d = nearest_place(p_W, direction, until, trial.openness);
  if (d == kNowhere) return trial;
  const Vector3d p_WC = p_W + d * direction;
  if (!in_sight(p_WC, p_W, kNobody, world_)) return trial;
  for (const BestAim& camera : cameras_) {
    const Aim aim = camera.find(p_W - p_WC, n_W);
    if (aim.q > trial.view.q) trial.view = {p_WC, aim.yaw, aim.pitch, aim.q};
  }
  return trial;
}

void ViewSearch::refine(const InterestPoint& point, double step, Best& best) const {
  const auto starts = best.trials();
  for (Trial trial : starts) {
    if (trial.openness <= 0.0) continue;  // nothing to go by
    double turn = step;
    for (int i = 0; turn > kFinestTurn && !best.perfect(); ++i) {
      if (i == (trial.view.q > 0.0 ? kMostRefinements : kMostUnseen)) break;
      const Vector3d u = trial.direction.unitOrthogonal(), v = trial.direction.cross(u);
      Trial next = trial;
      for (const auto& [a, b] : kNeighbours) {
        const Trial neighbour = try_direction(point, (trial.direction + turn * (a * u + b * v)).normalized());
        if (neighbour.better_than(next)) next = neighbour;
        best.offer(neighbour);
      }
      if (!next.better_than(trial)) turn *= 0.5;
      trial = next;
    }
  }
}

ViewSearch::Found ViewSearch::find(const InterestPoint& point, std::size_t directions, const Found& known) const {
  Best best;
  const auto search = [&](std::size_t from, std::size_t until, const PointView& known_view) {
    best.know(known_view);
    for (std::size_t n = from; n < until && !best.perfect(); ++n) {
      best.offer(try_direction(point, sphere_direction(n)));
    }
    // Half the mean distance of neighbours on the unit sphere.
    refine(point, 0.5 * std::sqrt(4.0 * std::numbers::pi / static_cast<double>(until)), best);
    return best.view();
  };
  best.know(known.coarse);  // a perfect one needs no search
  const Vector3d n_W = point.n_W.cast<double>();
  for (const Vector3d& direction : {n_W, Vector3d(-n_W)}) {
    if (!best.perfect()) best.offer(try_direction(point, direction));
  }
  const PointView coarse = search(0, directions, known.coarse);
  return {coarse, search(directions, 2 * directions, known.fine)};
}

}  // namespace skein::sim
