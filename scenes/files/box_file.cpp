#include "scenes/files/box_file.hpp"

#include <spdlog/fmt/fmt.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "core/config/config_reader.hpp"
#include "core/config/config_writer.hpp"
#include "scenes/files/limits.hpp"

namespace skein::sim {
namespace {

/// Greatest accepted deviation of the columns from orthonormal: files have single precision.
constexpr double kOrthogonalWithin = 1e-3;
/// Up to this deviation the columns are orthonormal except for rounding errors, and are not changed.
constexpr double kRounding = 1e-14;

double distance_from_orthonormal(const Matrix3d& R) {
  return (R.transpose() * R - Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

/// The reason why a matrix is not a rotation; empty if it is one.
std::string rotation_complaint(const Matrix3d& R) {
  if (distance_from_orthonormal(R) > kOrthogonalWithin) {
    return fmt::format(
        "the upper left 3x3 must be a rotation: its columns have lengths {:.6g}, {:.6g}, {:.6g} where "
        "1 is needed, and products (x.y, y.z, z.x) {:.6g}, {:.6g}, {:.6g} where 0 is needed",
        R.col(0).norm(), R.col(1).norm(), R.col(2).norm(), R.col(0).dot(R.col(1)), R.col(1).dot(R.col(2)),
        R.col(2).dot(R.col(0)));
  }
  if (R.determinant() < 0.0) {
    return fmt::format("the upper left 3x3 must be right-handed: its determinant is {:.6g}; turn one column round",
                       R.determinant());
  }
  return {};
}

struct BoxEntry {
  Vector3d center = Vector3d::Zero();
  Vector3d size = Vector3d::Zero();
  std::array<double, 16> orientation{};

  Matrix3d rotation() const {
    Matrix3d R;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        R(row, column) = orientation[static_cast<std::size_t>(4 * row + column)];
      }
    }
    return R;
  }

  void describe(auto& r) {
    r.required("center", center, within(-kFarthest, kFarthest));
    r.required("size", size, within(1e-3, kFarthest));
    r.required("orientation", orientation, within(-kFarthest, kFarthest));
    const std::string complaint = rotation_complaint(rotation());
    r.check(complaint.empty(), "orientation", complaint);
    const bool row_major = std::abs(orientation[12]) + std::abs(orientation[13]) + std::abs(orientation[14]) +
                               std::abs(orientation[15] - 1.0) <=
                           1e-6;
    r.check(row_major, "orientation", "the last row must be 0, 0, 0, 1: the matrix is row-major");
  }
};

/// The rotation with exactly orthonormal columns (Gram-Schmidt from z, so that upright boxes stay upright).
Matrix3d orthonormal(const Matrix3d& R) {
  if (distance_from_orthonormal(R) <= kRounding) return R;
  const Vector3d z = R.col(2).normalized();
  const Vector3d y = (R.col(1) - z * z.dot(R.col(1))).normalized();
  Matrix3d result;
  result << y.cross(z), y, z;
  return result;
}

}  // namespace

std::vector<OrientedBox> read_boxes(const std::filesystem::path& file) {
  const auto entries = read_config_file<Named<BoxEntry>>(file);
  if (entries.empty()) throw InputError(file.string() + ": no boxes; at least one is needed");
  std::vector<OrientedBox> boxes;
  for (const auto& [name, entry] : entries) {
    boxes.push_back({name, entry.center, entry.size, orthonormal(entry.rotation())});
  }
  return boxes;
}

std::string to_box_description(const std::vector<OrientedBox>& boxes) {
  Named<BoxEntry> entries;
  for (const OrientedBox& box : boxes) {
    BoxEntry entry{box.center, box.size, {}};
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 3; ++column) {
        entry.orientation[4 * row + column] = box.R_WO(static_cast<int>(row), static_cast<int>(column));
      }
      entry.orientation[4 * row + 3] = box.center[static_cast<int>(row)];
    }
    entry.orientation[15] = 1.0;
    entries.emplace_back(box.name, entry);
  }
  return config_to_yaml(entries);
}

TriangleMesh box_surface(const OrientedBox& box) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d sign(corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5, corner & 4 ? 0.5 : -0.5);
    mesh.vertices.push_back((box.R_WO * sign.cwiseProduct(box.size) + box.center).cast<float>());
  }
  // Faces as seen from outside, counter-clockwise: x, y and z, low and high.
  static constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& [a, b, c, d] : kFaces) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return mesh;
}

}  // namespace skein::sim
