// Radio line of sight between two nodes with six antennas each.
// Frame: W.  Units: m.  Source: golden vectors `los_antenna`.
// The antennas are at +-offset along the world's axes and do not turn with the body; the lower one is never
// below z = 0.1. Two nodes are linked if any of the 36 sight lines is free, or is hit no more than 0.1 m before its
// end. Because of those 0.1 m the result may depend on the order of the nodes: trace from the lower index.
#pragma once

#include <array>
#include <concepts>
#include <optional>

#include "core/types.hpp"

namespace skein::sim {

/// A radio node as the line-of-sight test sees it.
struct AntennaNode {
  Vector3d p_W = Vector3d::Zero();
  double offset_m = 0.1;  ///< antenna distance from the centre
};

struct LinkResult {
  bool linked = false;
  double range = 0.0;  ///< between the centres, linked or not [m]
};

struct SightLineCounts {
  int clear = 0;             ///< of 36 sight lines
  int within_tolerance = 0;  ///< hit, but no more than 0.1 m before the end
};

/// Distance from the first point to the nearest obstacle on the segment to the second [m]; nullopt: there is none.
template <class F>
concept FirstHit = requires(F f, const Vector3d& p) {
  { f(p, p) } -> std::convertible_to<std::optional<double>>;
};

inline constexpr std::size_t kAntennas = 6;
/// A sight line counts as free if the obstacle is no farther than this from its end [m].
inline constexpr double kEndTolerance = 0.1;

/// Antenna positions in W. Pure.
std::array<Vector3d, kAntennas> antennas(const AntennaNode& node);

/// Upper bound of the distance of the node's antennas from its centre [m]. Pure.
double antenna_reach(const AntennaNode& node);

/// Classifies one sight line. @param length  of it [m]. @param hit  distance of the first obstacle. Pure.
enum class SightLine { clear, within_tolerance, blocked };
SightLine judge_sight_line(double length, const std::optional<double>& hit);

/// Whether two nodes are linked; stops at the first sight line that suffices.
/// @param first_hit  obstacles, without the bodies of the two nodes themselves.
template <FirstHit F>
LinkResult trace_link(const AntennaNode& from, const AntennaNode& to, F&& first_hit) {
  LinkResult result{false, (to.p_W - from.p_W).norm()};
  const auto targets = antennas(to);
  for (const Vector3d& a : antennas(from)) {
    for (const Vector3d& b : targets) {
      if (judge_sight_line((b - a).norm(), first_hit(a, b)) != SightLine::blocked) {
        result.linked = true;
        return result;
      }
    }
  }
  return result;
}

/// Counts all 36 sight lines; for audits and reference vectors.
template <FirstHit F>
SightLineCounts count_sight_lines(const AntennaNode& from, const AntennaNode& to, F&& first_hit) {
  SightLineCounts counts;
  const auto targets = antennas(to);
  for (const Vector3d& a : antennas(from)) {
    for (const Vector3d& b : targets) {
      const SightLine line = judge_sight_line((b - a).norm(), first_hit(a, b));
      counts.clear += line == SightLine::clear;
      counts.within_tolerance += line == SightLine::within_tolerance;
    }
  }
  return counts;
}

}  // namespace skein::sim
