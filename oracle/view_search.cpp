#include "oracle/view_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/math/euler.hpp"
#include "sight/camera.hpp"

namespace skein::sim {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();
/// The camera's least distance from a point, if the clearance does not demand more [m].
constexpr double kNearest = 2.0 * Camera::kSurfaceTolerance;
/// Rays from a point begin this far from it, clear of its surface [m].
constexpr double kLiftOff = 0.03;
constexpr double kLeastStep = 0.05;        ///< along a direction close to the structure [m]
constexpr double kBodyStep = 0.1;          ///< along a direction where the body fits with no heading [m]
constexpr std::size_t kHeadingsApart = 4;  ///< body_lacks() tries every fourth heading of the body
constexpr double kReachStep = 0.5;         ///< along a direction where the camera is outside open space [m]
constexpr int kHalvings = 4;               ///< of the last step
constexpr double kFinestTurn = 1.0 * kRadPerDeg;
constexpr int kMostRefinements = 16, kMostUnseen = 5;  ///< steps of a refinement; of one without any picture so far
constexpr std::array<std::array<double, 2>, 8> kNeighbours = {
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

/// 1 / g and 1 / g^2, where g^3 = g + 1: their multiples fill a square very evenly (Roberts' R2 sequence).
constexpr double kHeightStep = 0.7548776662466927, kAzimuthStep = 0.5698402909980532;

bool is_within(const std::vector<const OpenSpace*>& spaces, const Vector3d& p_W) {
  return std::ranges::all_of(spaces, [&p_W](const OpenSpace* space) { return space->reaches(p_W); });
}

}  // namespace

/// A direction from the point, and the best picture from there.
struct ViewSearch::Trial {
  Vector3d direction = Vector3d::UnitZ();
  /// How close a place in this direction is to being free, in [0, 1]: guides the search as long as there is no picture.
  double openness = 0.0;
  PointView view;

  bool better_than(const Trial& other) const {
    return view.q != other.view.q ? view.q > other.view.q : openness > other.openness;
  }
};

/// The best picture so far, and the best two trials, the better one first.
class ViewSearch::Best {
 public:
  explicit Best(double enough) : enough_(enough) {}
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
  double enough() const { return enough_; }
  bool done() const { return view_.q >= enough_; }
  const std::array<Trial, 2>& trials() const { return trials_; }

 private:
  double enough_;
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

/// One kind of camera that looks at a point from some distance in a direction.
struct ViewSearch::Look {
  const Viewer& viewer;
  Vector3d p_W, direction;  ///< the point, and the unit vector from it towards the camera
  double until;             ///< distance from the point at which something blocks the view
  BodyHeadings headings;    ///< with which the body does not block the view; set only if heading_matters()

  Vector3d place(double d) const { return p_W + d * direction; }
};

ViewSearch::ViewSearch(const RayScene& world, const std::vector<Viewer>& viewers, Berth berth, const RulesConfig& rules)
    : world_(world),
      viewers_(viewers),
      berth_(berth),
      blind_in_structure_(rules.camera_blind_in_structure),
      sees_(sight_test(rules)) {
  for (const Viewer& viewer : viewers) reach_ = std::max(reach_, viewer.aim.reach());
}

/// Whether a place can be free with some headings of the body and not with others. A camera is only some decimetres
/// from its body's centre: if the clearance is at least this distance, no structure can be between the two.
bool ViewSearch::heading_matters(const Viewer& viewer) const {
  const bool room_for_arm = !blind_in_structure_ || viewer.clearance >= viewer.mount.offset();
  return berth_ == Berth::body || !room_for_arm;
}

bool ViewSearch::fits(const Viewer& viewer, const Vector3d& p_WC, double body_yaw) const {
  const Vector3d centre = viewer.mount.body_centre(p_WC, body_yaw);
  if (berth_ == Berth::body) {
    const double needed = viewer.clearance;
    if (world_.clearance(centre, needed) < needed || !is_within(viewer.spaces, centre)) return false;
  }
  const bool room_for_arm = !blind_in_structure_ || viewer.clearance >= viewer.mount.offset();
  return room_for_arm || !world_.first_hit_distance(centre, p_WC, {.ground = false, .uavs = false});
}

/// For Berth::body: 0 if the place is free, else a distance to step on before another place is tried.
double ViewSearch::body_lacks(const Look& look, const Vector3d& p_WC, double& openness) const {
  const auto& [aim, mount, needed, spaces, optics] = look.viewer;
  // The body's centres for all headings lie on a circle around this point.
  const Vector3d mean = mount.mean_centre(p_WC);
  const double room = world_.clearance(mean, needed), lacking = needed - mount.arm() - room;
  if (room < needed) openness = std::max(openness, room / needed);
  if (lacking > 0.0) return std::max(lacking, kLeastStep);
  if (room >= needed && !is_within(spaces, mean)) return kReachStep;
  for (std::size_t i = 0; i < BodyHeadings::kCount; i += kHeadingsApart) {
    if (look.headings.allowed[i] && fits(look.viewer, p_WC, look.headings.yaw(i))) return 0.0;
  }
  return kBodyStep;
}

/// For Berth::camera: 0 if the place is free, else a distance to step on before another place is tried.
double ViewSearch::camera_lacks(const Look& look, const Vector3d& p_WC, double& openness) const {
  const double needed = look.viewer.clearance;
  if (!is_within(look.viewer.spaces, p_WC)) return kReachStep;
  // The clearance changes by at most a metre per metre: a distance as long as the lacking clearance can be skipped.
  const double lacking = needed - world_.clearance(p_WC, needed);
  if (lacking > 0.0) {
    openness = std::max(openness, 1.0 - lacking / needed);
    return std::max(lacking, kLeastStep);
  }
  return heading_matters(look.viewer) && fitting(look, p_WC).allowed.none() ? kLeastStep : 0.0;
}

/// Distance from the point of the nearest free place in a direction; kNowhere if there is none.
double ViewSearch::nearest_place(const Look& look, double& openness) const {
  const auto step_on = [&](double d) {
    return berth_ == Berth::body ? body_lacks(look, look.place(d), openness)
                                 : camera_lacks(look, look.place(d), openness);
  };
  const double nearest = berth_ == Berth::camera ? std::max(look.viewer.clearance, kNearest) : kNearest;
  double refused = 0.0;  // the last place that was not free
  for (double d = nearest; d < look.until && look.place(d).z() >= 0.0;) {
    if (const double step = step_on(d); step > 0.0) {
      refused = d;
      d += step;
      continue;
    }
    openness = 1.0;
    // The last step may have been long: bisect it to find where the free places begin.
    for (int i = 0; i < kHalvings && refused > 0.0; ++i) {
      const double middle = 0.5 * (refused + d);
      (step_on(middle) == 0.0 ? d : refused) = middle;
    }
    return d;
  }
  return kNowhere;
}

BodyHeadings ViewSearch::fitting(const Look& look, const Vector3d& p_WC) const {
  BodyHeadings headings = look.headings;
  for (std::size_t i = 0; i < BodyHeadings::kCount; ++i) {
    if (headings.allowed[i]) headings.allowed[i] = fits(look.viewer, p_WC, headings.yaw(i));
  }
  return headings;
}

/// Of the headings with which the body fits, the one with the least gimbal yaw; nullopt if there is none.
std::optional<double> ViewSearch::fitting_yaw(const Look& look, const Vector3d& p_WC, BodyHeadings headings,
                                              double camera_yaw) const {
  while (const auto nearest = look.viewer.mount.nearest_heading(headings, camera_yaw)) {
    const double yaw = headings.yaw(*nearest);
    if (fits(look.viewer, p_WC, yaw)) return yaw;
    headings.allowed.reset(*nearest);
  }
  return std::nullopt;
}

/// Replaces `best` with the best picture from a place, if that is better.
/// @param aim  the best aim if the body may have any heading.
void ViewSearch::take_picture(const Look& look, const Vector3d& p_WC, const Vector3d& n_W, Aim aim,
                              PointView& best) const {
  if (aim.q <= best.q) return;
  const CameraMount& mount = look.viewer.mount;
  const bool placed = heading_matters(look.viewer);
  const BodyHeadings headings = placed ? look.headings : mount.clear_headings(-look.direction);
  auto body_yaw = fitting_yaw(look, p_WC, headings, aim.yaw);
  if (!body_yaw) {
    const BodyHeadings left = placed ? fitting(look, p_WC) : headings;
    if (left.allowed.none()) return;
    const auto allowed = [&](double camera_yaw) { return mount.nearest_heading(left, camera_yaw).has_value(); };
    aim = look.viewer.aim.find(look.p_W - p_WC, n_W, allowed);
    body_yaw = fitting_yaw(look, p_WC, left, aim.yaw);
  }
  if (body_yaw && aim.q > best.q) {
    best = {p_WC,
            aim.yaw,
            aim.pitch,
            aim.q,
            wrap_angle(aim.yaw - *body_yaw),
            static_cast<std::size_t>(&look.viewer - viewers_.data())};
  }
}

/// Tries the kinds of camera one by one, until a picture is good enough.
ViewSearch::Trial ViewSearch::try_direction(const InterestPoint& point, const Vector3d& direction,
                                            double enough) const {
  const Vector3d p_W = point.p_W.cast<double>(), n_W = point.n_W.cast<double>();
  Trial trial{direction, 0.0, {}};
  double until = 0.0, d = kNowhere;
  bool visible = false;
  std::optional<Aim> aim;  // the best one from distance d, with the optics of `before`
  const Viewer* before = nullptr;
  for (const Viewer& viewer : viewers_) {
    if (trial.view.q >= enough) break;
    Look look{viewer, p_W, direction, until, {}};
    if (heading_matters(viewer)) {
      look.headings = viewer.mount.clear_headings(-direction);
      if (look.headings.allowed.none()) continue;
    }
    if (before == nullptr) {
      const auto hit = world_.first_hit(p_W + kLiftOff * direction, direction, reach_);
      look.until = until = hit ? kLiftOff + hit->distance : reach_;
    }
    // If the heading does not matter, the nearest free place is the same for all kinds of camera.
    if (before == nullptr || heading_matters(viewer)) {
      d = nearest_place(look, trial.openness);
      visible = d < kNowhere && sees_(look.place(d), p_W, kNoUav, world_);
      aim.reset();
    }
    if (aim && before->optics != viewer.optics) aim.reset();
    before = &viewer;
    if (!visible) continue;
    const Vector3d p_WC = look.place(d);
    if (!aim) aim = viewer.aim.find(p_W - p_WC, n_W);
    take_picture(look, p_WC, n_W, *aim, trial.view);
  }
  return trial;
}

void ViewSearch::refine(const InterestPoint& point, double step, Best& best) const {
  const auto starts = best.trials();
  for (Trial trial : starts) {
    if (trial.openness <= 0.0) continue;  // no indication of a free place nearby
    double turn = step;
    for (int i = 0; turn > kFinestTurn && !best.done(); ++i) {
      if (i == (trial.view.q > 0.0 ? kMostRefinements : kMostUnseen)) break;
      const Vector3d u = trial.direction.unitOrthogonal(), v = trial.direction.cross(u);
      Trial next = trial;
      for (const auto& [a, b] : kNeighbours) {
        const Trial neighbour =
            try_direction(point, (trial.direction + turn * (a * u + b * v)).normalized(), best.enough());
        if (neighbour.better_than(next)) next = neighbour;
        best.offer(neighbour);
      }
      if (!next.better_than(trial)) turn *= 0.5;
      trial = next;
    }
  }
}

ViewSearch::Found ViewSearch::find(const InterestPoint& point, std::size_t directions, const Found& known,
                                   double enough) const {
  Best best(enough);
  const auto search = [&](std::size_t from, std::size_t until, const PointView& known_view) {
    best.know(known_view);
    for (std::size_t n = from; n < until && !best.done(); ++n) {
      best.offer(try_direction(point, sphere_direction(n), enough));
    }
    // The first step is half the mean distance between neighbours on the unit sphere.
    refine(point, 0.5 * std::sqrt(4.0 * std::numbers::pi / static_cast<double>(until)), best);
    return best.view();
  };
  best.know(known.coarse);  // no search is needed if this one is good enough
  const Vector3d n_W = point.n_W.cast<double>();
  for (const Vector3d& direction : {n_W, Vector3d(-n_W)}) {
    if (!best.done()) best.offer(try_direction(point, direction, enough));
  }
  const PointView coarse = search(0, directions, known.coarse);
  return {coarse, search(directions, 2 * directions, known.fine)};
}

}  // namespace skein::sim
