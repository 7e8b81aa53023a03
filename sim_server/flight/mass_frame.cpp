#include "sim_server/flight/mass_frame.hpp"

#include <Eigen/Eigenvalues>

#include "core/vehicle/airframe.hpp"

namespace skein::sim {
namespace {

constexpr double kNoProduct = 1e-12;  ///< products of inertia below this share of the moments are rounding errors

/// Vector from Bo to the centre of mass, in W.
Vector3d arm_W(const MassFrame& frame, const Quaterniond& q_WB) { return q_WB * frame.X_BP.translation(); }

Quaterniond q_BP(const MassFrame& frame) { return Quaterniond(Matrix3d(frame.X_BP.linear())); }

}  // namespace

MassFrame mass_frame(const VehicleConfig& vehicle) {
  const MassProperties whole = mass_properties(vehicle);
  MassFrame frame{whole.mass_kg, Isometry3d(Eigen::Translation3d(whole.p_BBcm)), whole.I_BBcm_B.diagonal()};
  const Matrix3d products = whole.I_BBcm_B - Matrix3d(frame.inertia.asDiagonal());
  // Rounding errors must not permute or flip the axes of a symmetric vehicle.
  if (products.norm() < kNoProduct * whole.I_BBcm_B.norm()) return frame;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(whole.I_BBcm_B);
  Matrix3d R_BP = principal.eigenvectors();
  if (R_BP.determinant() < 0.0) R_BP.col(2) *= -1.0;
  frame.X_BP.linear() = R_BP;
  frame.inertia = principal.eigenvalues();
  return frame;
}

MassState mass_state(const MassFrame& frame, const RigidBodyState& state) {
  const Vector3d r_W = arm_W(frame, state.q_WB), w_WB = state.q_WB * state.w_WB_B;
  return {state.p_WB + r_W, state.q_WB * q_BP(frame), state.v_WB + w_WB.cross(r_W), w_WB};
}

RigidBodyState body_state(const MassFrame& frame, const MassState& state) {
  RigidBodyState body;
  body.q_WB = state.q_WP * q_BP(frame).conjugate();
  const Vector3d r_W = arm_W(frame, body.q_WB);
  body.p_WB = state.p_WBcm - r_W;
  body.v_WB = state.v_WBcm - state.w_WB.cross(r_W);
  body.w_WB_B = body.q_WB.conjugate() * state.w_WB;
  return body;
}

Vector3d torque_about_mass(const MassFrame& frame, const Quaterniond& q_WB, const Vector3d& force_W,
                           const Vector3d& torque_W) {
  return torque_W - arm_W(frame, q_WB).cross(force_W);
}

}  // namespace skein::sim
