#include "uav_agent/planning/strips.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/euler.hpp"

namespace skein::agent {
namespace {

constexpr double kTurnS = 3.0;       ///< least time for the change from one strip to another; chosen
constexpr double kFlatFace = 0.7;    ///< a face with a greater |n_z| is a top or a bottom; chosen
constexpr double kMinBottomM = 3.0;  ///< least height above lowest_m of the UAV below a bottom face; chosen
constexpr int kTwoOptPasses = 20;    ///< chosen: bounds the CPU time
constexpr double kNotWider = 0.15;   ///< this share of a width at a face's edge gets no strip of its own; chosen
/// A strip ends inside the face by this share of the face's length or of the strip's width, whichever is less. Chosen.
constexpr double kInset = 0.25;
constexpr double kNotLess = 1e-9;  ///< a smaller difference is a rounding error

struct Face {
  std::size_t box = 0;
  FaceKind kind = FaceKind::side;
  Vector3d centre_W, out_W, u_W, w_W;  ///< u and w span the face
  double u_m = 0.0, w_m = 0.0;         ///< edge lengths along them
  double inside_m = 0.0;
};

Face face_of(const OrientedBox& box, std::size_t index, int axis, double sign) {
  Face face;
  face.box = index;
  face.out_W = sign * box.R_WO.col(axis);
  face.centre_W = box.center + 0.5 * box.size[axis] * face.out_W;
  const int u = (axis + 1) % 3, w = (axis + 2) % 3;
  face.u_W = box.R_WO.col(u);
  face.w_W = box.R_WO.col(w);
  face.u_m = box.size[u];
  face.w_m = box.size[w];
  face.inside_m = box.size[axis];
  if (std::abs(face.out_W.z()) > kFlatFace) face.kind = face.out_W.z() > 0.0 ? FaceKind::top : FaceKind::bottom;
  return face;
}

/// The strips of a face if they run along one of its axes: their number, and the time that it takes to fly them.
struct Cut {
  int count = 1;
  double seconds = 0.0;
};

Cut cut_along(double along_m, double across_m, double swath_m, double speed_mps) {
  Cut cut;
  cut.count = std::max(1, static_cast<int>(std::ceil(across_m / swath_m - kNotWider)));
  cut.seconds = cut.count * (along_m / speed_mps + kTurnS);
  return cut;
}

}  // namespace

CameraReach camera_reach(const CameraConfig& camera, double desired_mm_per_pixel) {
  CameraReach reach;
  constexpr double kMillimetre = 1e-3;  // format
  reach.sharp_distance_m = desired_mm_per_pixel * kMillimetre * camera.focal_length_m / camera.pixel_size_m;
  reach.half_width_slope = std::tan(0.5 * camera.hfov_deg * kRadPerDeg);
  reach.half_height_slope = std::tan(0.5 * camera.vfov_deg * kRadPerDeg);
  reach.blur_speed_mps = camera.pixel_size_m / camera.focal_length_m / camera.exposure_s * reach.sharp_distance_m;
  return reach;
}

std::vector<Strip> cut_into_strips(const std::vector<OrientedBox>& boxes, const CameraReach& reach,
                                   const StripConfig& config) {
  const double depth = config.standoff_ratio * reach.sharp_distance_m;
  const double speed = config.standoff_ratio * reach.blur_speed_mps;
  const double width = 2.0 * depth * reach.half_width_slope * (1.0 - config.overlap);
  const double height = 2.0 * depth * reach.half_height_slope * (1.0 - config.overlap);
  std::vector<Strip> strips;

  const auto cut_face = [&](Face face) {
    if (face.kind == FaceKind::top && !config.top) return;
    if (face.kind == FaceKind::bottom &&
        (!config.bottom || face.centre_W.z() - depth < config.lowest_m + kMinBottomM)) {
      return;
    }
    if (std::min(face.u_m, face.w_m) < config.min_length_m) return;
    const auto swap_axes = [&face] {
      std::swap(face.u_W, face.w_W);
      std::swap(face.u_m, face.w_m);
    };
    double swath = width;
    if (face.kind == FaceKind::side) {
      // Makes u the vertical axis: strips along u are then as wide as the image's width, strips along w as its height.
      if (std::abs(face.w_W.z()) > std::abs(face.u_W.z())) swap_axes();
      const Cut upright = cut_along(face.u_m, face.w_m, width, speed);
      const Cut level = cut_along(face.w_m, face.u_m, height, speed);
      if (level.seconds < upright.seconds) {
        swap_axes();
        swath = height;
      }
    } else if (cut_along(face.w_m, face.u_m, width, speed).seconds <
               cut_along(face.u_m, face.w_m, width, speed).seconds) {
      swap_axes();
    }
    const int count = cut_along(face.u_m, face.w_m, swath, speed).count;
    // The camera sees beyond the strip's end, so the UAV need not fly to the face's edge.
    const double inset = std::min(kInset * face.u_m, kInset * swath);
    const double reach_m = face.u_m - 2.0 * inset;
    const int pieces = std::max(1, static_cast<int>(std::ceil(reach_m / config.max_length_m)));
    for (int i = 0; i < count * pieces; ++i) {
      const int row = i / pieces, piece = i % pieces;
      const Vector3d middle = face.centre_W + face.w_W * (((row + 0.5) / count - 0.5) * face.w_m);
      const Vector3d from = middle - 0.5 * reach_m * face.u_W;
      Strip strip;
      strip.box = face.box;
      strip.kind = face.kind;
      strip.begin_W = from + face.u_W * (reach_m * piece / pieces);
      strip.end_W = from + face.u_W * (reach_m * (piece + 1) / pieces);
      strip.out_W = face.out_W;
      strip.across_W = face.w_W;
      strip.half_width_m = 0.5 * face.w_m / count;
      strip.inside_m = face.inside_m;
      strips.push_back(strip);
    }
  };

  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      cut_face(face_of(boxes[i], i, axis, 1.0));
      cut_face(face_of(boxes[i], i, axis, -1.0));
    }
  }
  return strips;
}

namespace {

double tour_seconds(const std::vector<Visit>& tour, const std::vector<Strip>& strips, const Vector3d& start,
                    double transit_mps) {
  double length = 0.0;
  Vector3d at = start;
  for (const Visit& visit : tour) {
    const Strip& strip = strips[visit.strip];
    length += ((visit.reversed ? strip.end_W : strip.begin_W) - at).norm();
    at = visit.reversed ? strip.begin_W : strip.end_W;
  }
  return length / transit_mps;
}

void shorten(std::vector<Visit>& tour, const std::vector<Strip>& strips, const Vector3d& start, double transit_mps) {
  double best = tour_seconds(tour, strips, start, transit_mps);
  for (int pass = 0; pass < kTwoOptPasses; ++pass) {
    bool better = false;
    for (std::size_t i = 0; i < tour.size(); ++i) {
      for (std::size_t j = i; j < tour.size(); ++j) {
        std::vector<Visit> other = tour;
        std::reverse(other.begin() + static_cast<std::ptrdiff_t>(i),
                     other.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        for (std::size_t k = i; k <= j; ++k) other[k].reversed = !other[k].reversed;
        const double seconds = tour_seconds(other, strips, start, transit_mps);
        if (seconds >= best - kNotLess) continue;
        best = seconds;
        tour = std::move(other);
        better = true;
      }
    }
    if (!better) return;
  }
}

}  // namespace

std::vector<std::vector<Visit>> share_strips(const std::vector<Strip>& strips, const std::vector<double>& work_s,
                                             const std::vector<Vector3d>& p_W_start, double transit_mps,
                                             const std::vector<double>& team_size) {
  std::vector<std::vector<Visit>> tours(p_W_start.size());
  std::vector<Vector3d> at = p_W_start;
  std::vector<double> free_at(p_W_start.size(), 0.0);
  std::vector<bool> taken(strips.size(), false);
  for (std::size_t left = strips.size(); left > 0; --left) {
    const auto uav = static_cast<std::size_t>(std::min_element(free_at.begin(), free_at.end()) - free_at.begin());
    Visit next;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < strips.size(); ++s) {
      if (taken[s]) continue;
      for (const bool reversed : {false, true}) {
        const double distance = ((reversed ? strips[s].end_W : strips[s].begin_W) - at[uav]).norm();
        if (distance >= nearest - kNotLess) continue;
        nearest = distance;
        next = {s, reversed};
      }
    }
    taken[next.strip] = true;
    tours[uav].push_back(next);
    at[uav] = next.reversed ? strips[next.strip].begin_W : strips[next.strip].end_W;
    const double taken_s = nearest / transit_mps + work_s[next.strip] + kTurnS;
    free_at[uav] += team_size.empty() ? taken_s : taken_s / team_size[uav];
  }
  for (std::size_t uav = 0; uav < tours.size(); ++uav) shorten(tours[uav], strips, p_W_start[uav], transit_mps);
  return tours;
}

}  // namespace skein::agent
