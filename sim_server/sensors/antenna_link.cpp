#include "sim_server/sensors/antenna_link.hpp"

#include <algorithm>

namespace skein::sim {
namespace {

constexpr double kLowestAntenna = 0.1;

}  // namespace

std::array<Vector3d, kAntennas> antennas(const AntennaNode& node) {
  const Vector3d& p = node.p_W;
  const double d = node.offset_m;
  return {p + Vector3d(d, 0, 0), p - Vector3d(d, 0, 0), p + Vector3d(0, d, 0),
          p - Vector3d(0, d, 0), p + Vector3d(0, 0, d), Vector3d(p.x(), p.y(), std::max(p.z() - d, kLowestAntenna))};
}

double antenna_reach(const AntennaNode& node) { return std::max(node.offset_m, kLowestAntenna - node.p_W.z()); }

SightLine judge_sight_line(double length, const std::optional<double>& hit) {
  if (!hit) return SightLine::clear;
  return *hit >= length - kEndTolerance ? SightLine::within_tolerance : SightLine::blocked;
}

}  // namespace skein::sim
