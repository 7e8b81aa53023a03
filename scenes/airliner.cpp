#include "scenes/airliner.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/euler.hpp"

namespace skein::sim {
namespace {

/// A cross-section of a wing: position of its leading edge in A; the chord runs aft.
struct Section {
  Vector3d leading;
  double chord = 0.0;
  double thickness = 0.0;  ///< share of the chord
};

/// Half thickness of the symmetric four-digit NACA profile (NACA report 460, 1933) at a share of the chord.
double half_thickness(double c, double thickness) {
  return 5.0 * thickness *
         (0.2969 * std::sqrt(c) - 0.1260 * c - 0.3516 * c * c + 0.2843 * c * c * c - 0.1015 * c * c * c * c);
}

/// A slice across x of a body like a fuselage: an ellipse about (0, z).
struct Slice {
  double x = 0.0, z = 0.0, half_width = 0.0, half_height = 0.0;
};

class Airliner {
 public:
  Airliner(MeshBuilder& builder, const Isometry3d& X_WA, const AirlinerShape& shape)
      : builder_(builder), X_WA_(X_WA), shape_(shape) {}

  void add_fuselage() {
    const double nose = 2.9 * shape_.radius, tail = 8.0 * shape_.radius;
    std::vector<Slice> slices;
    for (const double share : {0.008, 0.04, 0.1, 0.2, 0.35, 0.55, 0.75}) slices.push_back(fuselage_at(share * nose));
    constexpr int kStraight = 12, kTaper = 12;
    for (int i = 0; i <= kStraight; ++i) {
      slices.push_back(fuselage_at(nose + (shape_.length - tail - nose) * i / kStraight));
    }
    for (int i = 1; i <= kTaper; ++i) slices.push_back(fuselage_at(shape_.length - tail + tail * i / kTaper));
    add_body(slices, 28, Vector3d(0.0, 0.0, fuselage_at(0.0).z));

    const double belly = shape_.wing_x - 3.5, belly_length = shape_.root_chord + 8.0;
    slices.clear();
    for (const double t : {0.02, 0.1, 0.25, 0.5, 0.75, 0.9, 0.98}) {
      const double fullness = std::sqrt(1.0 - std::pow(std::abs(2.0 * t - 1.0), 2.5));
      slices.push_back({belly + belly_length * t, shape_.axis_height - 0.5 * shape_.radius,
                        1.1 * shape_.radius * fullness, 0.65 * shape_.radius * fullness});
    }
    add_body(slices, 20);
    add_wheels(6.5, 0.0, 0.5, 1);
  }

  /// @param side  1 for starboard (+y), -1 for port.
  void add_wing(double side) {
    const double hs = shape_.half_span, kink = 0.36 * hs, tip = 0.96 * hs;
    std::vector<Section> sections;
    for (const double y : {0.0, shape_.radius, 0.5 * (shape_.radius + kink), kink, 0.6 * hs, 0.8 * hs, tip}) {
      sections.push_back({{leading_edge(y), side * y, wing_height(y)}, wing_chord(y), 0.14 - 0.05 * y / hs});
    }
    const double tip_x = leading_edge(tip);
    sections.push_back({{tip_x + 1.0, side * (tip + 0.7), wing_height(tip) + 0.6}, 1.7, 0.09});
    sections.push_back({{tip_x + 2.2, side * hs, wing_height(tip) + 2.4}, 0.9, 0.09});
    add_surface(sections, side * Vector3d::UnitY());

    const double radius = shape_.four_engines ? 1.35 : 1.75;
    add_engine(side, 0.31 * hs, radius);
    if (shape_.four_engines) add_engine(side, 0.56 * hs, radius);
    add_wheels(shape_.wing_x + 0.72 * shape_.root_chord, side * 1.75 * shape_.radius, 0.65, 3);
  }

  void add_tail() {
    const double root_z = shape_.axis_height + 0.5 * shape_.radius, rise = shape_.height - root_z;
    const double fin_x = shape_.length - 13.0, slope = std::tan(0.73);
    std::vector<Section> fin;
    for (const double t : {0.0, 0.3, 0.65, 0.95, 1.0}) {
      const double chord = t < 1.0 ? 9.8 - 6.0 * t : 3.2;
      fin.push_back({{fin_x + slope * rise * t, 0.0, root_z + rise * t}, chord, 0.1});
    }
    add_surface(fin, Vector3d::UnitZ());

    const double half_span = 0.33 * shape_.half_span, z = shape_.axis_height + 0.35 * shape_.radius;
    for (const double side : {-1.0, 1.0}) {
      std::vector<Section> plane;
      for (const double t : {0.0, 0.4, 0.8, 1.0}) {
        const double y = t * half_span;
        plane.push_back({{shape_.length - 11.5 + 0.72 * y, side * y, z + 0.12 * y}, 6.8 - 4.3 * t, 0.1});
      }
      add_surface(plane, side * Vector3d::UnitY());
    }
  }

 private:
  Slice fuselage_at(double x) const {
    const double nose = 2.9 * shape_.radius, tail = 8.0 * shape_.radius;
    double radius = shape_.radius, z = shape_.axis_height;
    if (x < nose) {
      const double q = 1.0 - x / nose;
      radius *= std::pow(1.0 - std::pow(q, 2.2), 0.6);
      z -= 0.3 * shape_.radius * q * q;
    } else if (x > shape_.length - tail) {
      const double q = (x - shape_.length + tail) / tail;
      radius *= 1.0 - 0.88 * std::pow(q, 1.7);
      z += 0.75 * (shape_.radius - radius);
    }
    return {x, z, radius, radius};
  }

  double leading_edge(double y) const {
    return shape_.wing_x + std::tan(shape_.sweep) * std::max(0.0, y - shape_.radius);
  }
  double wing_height(double y) const {
    const double share = y / shape_.half_span;
    return shape_.axis_height - 0.5 * shape_.radius + std::tan(shape_.dihedral) * y + 0.9 * share * share;
  }
  double wing_chord(double y) const {
    const double kink = 0.36 * shape_.half_span, kink_chord = 0.56 * shape_.root_chord, tip_chord = 2.6;
    if (y <= shape_.radius) return shape_.root_chord;
    if (y <= kink) return std::lerp(shape_.root_chord, kink_chord, (y - shape_.radius) / (kink - shape_.radius));
    return std::lerp(kink_chord, tip_chord, (y - kink) / (0.96 * shape_.half_span - kink));
  }

  /// Ellipses one behind the other; closed flat unless there is an apex.
  void add_body(const std::vector<Slice>& slices, int sides, const std::optional<Vector3d>& first_apex = std::nullopt,
                const std::optional<Vector3d>& last_apex = std::nullopt, double y = 0.0) {
    std::vector<Ring> rings;
    for (const Slice& slice : slices) {
      Ring ring;
      for (const Vector2d& p : regular_polygon(sides, 1.0)) {
        ring.push_back(X_WA_ * Vector3d(slice.x, y + slice.half_width * p.x(), slice.z + slice.half_height * p.y()));
      }
      rings.push_back(std::move(ring));
    }
    const auto in_W = [&](const std::optional<Vector3d>& p) {
      return p ? std::optional<Vector3d>(X_WA_ * *p) : std::nullopt;
    };
    builder_.add_loft(rings, in_W(first_apex), in_W(last_apex));
  }

  /// A wing, fin or tail plane: sections that follow each other along `span`.
  void add_surface(const std::vector<Section>& sections, const Vector3d& span) {
    constexpr double kChordShares[] = {0.0, 0.02, 0.07, 0.17, 0.35, 0.6, 0.85, 1.0};
    constexpr double kTrailingEdge = 0.02;  // least thickness aft of the leading edge [m]
    const Vector3d aft = Vector3d::UnitX(), up = aft.cross(span);
    std::vector<Ring> rings;
    for (const Section& section : sections) {
      const auto at = [&](double share, double face) {
        const double depth = section.chord * half_thickness(share, section.thickness);
        const double half = share > 0.0 ? std::max(depth, 0.5 * kTrailingEdge) : 0.0;
        return Vector3d(X_WA_ * Vector3d(section.leading + share * section.chord * aft + face * half * up));
      };
      Ring ring;
      for (const double share : kChordShares) ring.push_back(at(share, 1.0));
      for (std::size_t i = std::size(kChordShares) - 1; i > 0; --i) ring.push_back(at(kChordShares[i], -1.0));
      rings.push_back(std::move(ring));
    }
    builder_.add_loft(rings);
  }

  /// A nacelle on a pylon under the wing; its intake is a funnel.
  void add_engine(double side, double y, double radius) {
    const double length = 3.3 * radius, front = leading_edge(y) - 0.7 * length, wing_z = wing_height(y);
    const double z = std::max(radius + 0.7, wing_z - radius - 0.25);
    std::vector<Slice> slices;
    for (const auto& [share, width] :
         {std::pair{0.0, 0.86}, {0.03, 0.95}, {0.12, 1.0}, {0.4, 1.0}, {0.7, 0.9}, {1.0, 0.62}}) {
      slices.push_back({front + share * length, z, width * radius, width * radius});
    }
    const Vector3d intake(front + 0.2 * length, side * y, z), cone(front + 1.25 * length, side * y, z);
    add_body(slices, 20, intake, cone, side * y);

    const auto level = [&](double x0, double x1, double height) {
      Ring ring;
      for (const Vector2d& p : rectangle({0.5 * (x0 + x1), side * y}, {x1 - x0, 0.45})) {
        ring.push_back(X_WA_ * Vector3d(p.x(), p.y(), height));
      }
      return ring;
    };
    const Ring rings[] = {level(front + 0.25 * length, front + 0.9 * length, z + 0.6 * radius),
                          level(front + 0.6 * length, leading_edge(y) + 0.5 * wing_chord(y), wing_z)};
    builder_.add_loft(rings);
  }

  /// A leg with pairs of wheels one behind the other.
  void add_wheels(double x, double y, double radius, int pairs) {
    const auto cylinder = [&](const Vector3d& from, const Vector3d& to, double r, int sides) {
      builder_.add_cylinder(X_WA_ * from, X_WA_ * to, r, sides);
    };
    cylinder({x, y, radius}, {x, y, shape_.axis_height - 0.4 * shape_.radius}, 0.24, 10);
    const double spacing = 2.2 * radius, reach = 0.5 * spacing * (pairs - 1);
    if (pairs > 1) cylinder({x - reach, y, radius}, {x + reach, y, radius}, 0.2, 8);
    for (int i = 0; i < pairs; ++i) {
      const double wheel_x = x - reach + spacing * i;
      cylinder({wheel_x, y - 0.7, radius}, {wheel_x, y + 0.7, radius}, 0.12, 8);
      for (const double side : {-1.0, 1.0}) {
        cylinder({wheel_x, y + side * 0.55 - 0.22, radius}, {wheel_x, y + side * 0.55 + 0.22, radius}, radius, 16);
      }
    }
  }

  MeshBuilder& builder_;
  Isometry3d X_WA_;
  AirlinerShape shape_;
};

}  // namespace

AirlinerShape draw_airliner(RandomStream& random) {
  AirlinerShape shape;
  shape.length = random.uniform(67.0, 73.0);
  shape.half_span = random.uniform(30.5, 33.5);
  shape.height = random.uniform(18.8, 20.5);
  shape.radius = random.uniform(2.85, 3.2);
  shape.axis_height = shape.radius + random.uniform(2.1, 2.5);
  shape.sweep = random.uniform(0.54, 0.66);
  shape.dihedral = random.uniform(0.08, 0.13);
  shape.wing_x = shape.length * random.uniform(0.31, 0.34);
  shape.root_chord = random.uniform(12.0, 14.0);
  shape.four_engines = random.uniform() < 0.3;
  return shape;
}

std::vector<OrientedBox> add_airliner(MeshBuilder& builder, const Isometry3d& X_WA, const AirlinerShape& shape,
                                      double box_margin) {
  Airliner airliner(builder, X_WA, shape);
  std::vector<OrientedBox> boxes;
  const auto box = [&](const std::string& name, std::size_t first, double turn) {
    boxes.push_back(enclosing_box(name, builder.mesh(), first, X_WA.linear() * rotation_z(turn), box_margin));
  };
  std::size_t first = builder.mesh().vertices.size();
  airliner.add_fuselage();
  box("fuselage", first, 0.0);
  for (const double side : {-1.0, 1.0}) {
    first = builder.mesh().vertices.size();
    airliner.add_wing(side);
    box(side > 0.0 ? "starboard_wing" : "port_wing", first, -side * 0.85 * shape.sweep);
  }
  first = builder.mesh().vertices.size();
  airliner.add_tail();
  box("tail", first, 0.0);
  return boxes;
}

}  // namespace skein::sim
