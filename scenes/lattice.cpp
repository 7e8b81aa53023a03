#include "scenes/lattice.hpp"

#include <algorithm>
#include <cmath>

namespace skein::sim {

Isometry3d frame_along(const Vector3d& from, const Vector3d& to) {
  const Vector3d axis = (to - from).normalized();
  const Vector3d helper = std::abs(axis.z()) < 0.9 ? Vector3d::UnitZ() : Vector3d::UnitY();
  const Vector3d x = helper.cross(axis).normalized();
  Isometry3d X_WL = Isometry3d::Identity();
  X_WL.linear() << x, axis.cross(x), axis;
  X_WL.translation() = from;
  return X_WL;
}

std::vector<Ring> cross_sections(const Isometry3d& X_WL, const Polygon& first, const Polygon& last, double length,
                                 int fields) {
  std::vector<Ring> rings;
  for (int i = 0; i <= fields; ++i) {
    const double share = static_cast<double>(i) / fields;
    Ring ring;
    for (std::size_t k = 0; k < first.size(); ++k) {
      const Vector2d p = (1.0 - share) * first[k] + share * last[k];
      ring.push_back(X_WL * Vector3d(p.x(), p.y(), share * length));
    }
    rings.push_back(std::move(ring));
  }
  return rings;
}

void add_lattice(MeshBuilder& builder, std::span<const Ring> rings, const LatticeStyle& style) {
  const auto brace = [&](const Vector3d& from, const Vector3d& to) {
    if ((to - from).norm() > 2.0 * style.brace) builder.add_member(from, to, style.brace);
  };
  const std::size_t corners = rings.front().size();
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const Ring& ring = rings[i];
    for (std::size_t k = 0; k < corners; ++k) brace(ring[k], ring[(k + 1) % corners]);
    if (i + 1 == rings.size()) break;
    const Ring& next = rings[i + 1];
    for (std::size_t k = 0; k < corners; ++k) {
      builder.add_member(ring[k], next[k], style.chord);
      const bool rising = (i + k) % 2 == 0;
      if (rising || style.crossed) brace(ring[k], next[(k + 1) % corners]);
      if (!rising || style.crossed) brace(ring[(k + 1) % corners], next[k]);
    }
  }
}

void add_railing(MeshBuilder& builder, const Vector3d& from, const Vector3d& to, const Vector3d& up) {
  constexpr double kHeight = 1.1, kPost = 0.05, kRail = 0.05, kPostSpacing = 2.0;
  const Vector3d top = kHeight * up.normalized();
  const int spans = std::max(1, static_cast<int>(std::lround((to - from).norm() / kPostSpacing)));
  for (int i = 0; i <= spans; ++i) {
    const Vector3d foot = from + (to - from) * i / spans;
    builder.add_member(foot, foot + top, kPost);
  }
  for (const double share : {0.5, 1.0}) builder.add_member(from + share * top, to + share * top, kRail);
}

}  // namespace skein::sim
