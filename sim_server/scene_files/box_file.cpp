#include "sim_server/scene_files/box_file.hpp"

#include <array>
#include <cmath>

#include "core/config_reader.hpp"

namespace skein::sim {
namespace {

/// How far the columns may be from orthonormal: files carry float precision.
constexpr double kOrthogonalWithin = 1e-3;

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

  template <class Reader>
  void describe(Reader& r) {
    r.required("center", center, within(-1e5, 1e5));
    r.required("size", size, within(1e-3, 1e5));
    r.required("orientation", orientation, within(-1e5, 1e5));
    const Matrix3d R = rotation();
    const bool orthogonal = (R.transpose() * R - Matrix3d::Identity()).cwiseAbs().maxCoeff() <= kOrthogonalWithin;
    r.check(orthogonal && R.determinant() > 0.0, "orientation",
            "the upper left 3x3 must be a rotation: columns of length 1, at right angles, right-handed");
    const bool row_major = std::abs(orientation[12]) + std::abs(orientation[13]) + std::abs(orientation[14]) +
                               std::abs(orientation[15] - 1.0) <=
                           1e-6;
    r.check(row_major, "orientation", "the last row must be 0, 0, 0, 1: the matrix is row-major");
  }
};

/// The rotation with exactly orthonormal columns (Gram-Schmidt from z, so that upright boxes stay upright).
Matrix3d orthonormal(const Matrix3d& R) {
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

}  // namespace skein::sim
