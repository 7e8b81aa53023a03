#include "sim_server/golden/check.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/scoring/camera_quality.hpp"
#include "sim_server/flight/attitude_control.hpp"
#include "sim_server/flight/gimbal.hpp"
#include "sim_server/flight/position_control.hpp"
#include "sim_server/golden/table.hpp"
#include "sim_server/sensors/antenna_link.hpp"

namespace skein::sim {
namespace {

/// The reference's two vehicles, with the values that its controllers use.
VehicleConfig reference_vehicle(const GoldenTable& table, std::size_t row) {
  const std::string& role = table.text(row, "role");
  VehicleConfig vehicle;
  vehicle.attitude_control.inertia = Vector3d(0.07648816666, 0.07648816666, 0.16283333333);
  if (role != "explorer" && role != "photographer") {
    throw InputError(table.place(row) + ": column 'role': '" + role + "'; explorer or photographer is expected");
  }
  if (role == "photographer") {
    vehicle.role = Role::photographer;
    vehicle.attitude_control.inertia = Vector3d(0.034756, 0.045893, 0.0977);
    vehicle.arm_m = 0.2156;
    vehicle.rotor_moment_constant = 0.048;
    vehicle.position_control.omega_xy = 2.5;
    vehicle.position_control.thrust_scale = 85.0;
    vehicle.position_control.max_tilt_deg = 55.0;
    vehicle.attitude_control.p_gain = 25.0;
  }
  return vehicle;
}

GoldenReport check_scoring(const GoldenTable& table) {
  constexpr double kCountsFrom = 0.2;
  constexpr Tolerance kPoint{1e-9}, kRadius{1e-7}, kQuality{1e-9, 1e-7}, kMmPerPixel{0.0, 1e-7};
  GoldenComparison compare(table, "scoring");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    compare.begin_row(row);
    const auto number = [&](const char* column) { return table.number(row, column); };
    CameraConfig camera;
    camera.hfov_deg = number("hfov_deg");
    camera.vfov_deg = number("vfov_deg");
    camera.exposure_s = number("exposure");
    camera.focal_length_m = number("focal_length");
    camera.pixel_size_m = number("pixel_size");
    camera.p_BC = table.vector(row, "cam_");
    RigidBodyState body;
    body.p_WB = table.vector(row, "p_W_");
    body.q_WB = table.quaternion(row);
    body.v_WB = body.q_WB * table.vector(row, "v_B_");
    body.w_WB_B = table.vector(row, "w_B_");
    const GimbalState gimbal{number("gimbal_pitch"), number("gimbal_yaw"), number("gimbal_pitch_rate"),
                             number("gimbal_yaw_rate")};
    const Vector3d p_W = table.vector(row, "pt_"), n_W = table.vector(row, "n_");

    const Exposure exposure(camera_state(body, gimbal, camera), camera, number("desired_mm_per_pixel"),
                            ResolutionRule::contest);
    const PointQuality quality = exposure.evaluate(p_W, n_W);
    const auto if_in_fov = [&](double value) { return quality.in_fov ? std::optional(value) : std::nullopt; };
    compare.number("search_radius", exposure.radius(), kRadius);
    compare.vector("pt_cam_", quality.p_C, kPoint);
    compare.flag("in_search_radius", quality.in_search_radius);
    compare.flag("in_fov", quality.in_fov);
    compare.number("pixel_move_u", if_in_fov(quality.pixel_move_u), kQuality);
    compare.number("pixel_move_v", if_in_fov(quality.pixel_move_v), kQuality);
    compare.number("q_blur", if_in_fov(quality.q_blur), kQuality);
    compare.number("mm_per_pixel_u", quality.mm_per_pixel_u, kMmPerPixel);
    compare.number("mm_per_pixel_v", quality.mm_per_pixel_v, kMmPerPixel);
    compare.number("q_res", quality.q_res, kQuality);
    compare.number("score", quality.score, kQuality);

    // The flag `counted` checks the functions with which the simulator scores.
    const auto p_C = exposure.view(p_W);
    const auto score = p_C ? exposure.score(*p_C, n_W) : std::nullopt;
    compare.flag("counted", score && score->score() >= kCountsFrom);
  }
  return compare.report();
}

/// The flags for the reference's quirks; each is set if the quirk shows on either axis.
struct GimbalQuirks {
  bool saturated = false, partial = false, stale = false;

  void add_axis(GimbalMode mode, double before, double after, double rate) {
    const double moved = after - before;
    const bool fell_short = std::abs(moved) < std::abs(rate * Gimbal::kStepS) - kRounding;
    saturated |= mode == GimbalMode::rate && rate != 0.0 && moved == 0.0;
    partial |= mode == GimbalMode::rate && moved != 0.0 && fell_short;
    stale |= mode == GimbalMode::freeze && rate != 0.0;
  }

 private:
  static constexpr double kRounding = 1e-12;  ///< [rad]
};

double number_of(GimbalMode mode) { return mode == GimbalMode::freeze ? 0.0 : mode == GimbalMode::angle ? 1.0 : -1.0; }

/// A gimbal under test, and the tick that it expects next.
struct GimbalSequence {
  Gimbal gimbal;
  double next_tick = 0.0;
};

GoldenReport check_gimbal(const GoldenTable& table) {
  constexpr Tolerance kTolerance{1e-8};
  GoldenComparison compare(table, "gimbal");
  std::map<std::string, GimbalSequence> sequences;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    compare.begin_row(row);
    const auto number = [&](const char* column) { return table.number(row, column); };
    const std::string& id = table.text(row, "sequence_id");
    if (number("tick") == 0.0) {
      const GimbalConfig limits{number("pitch_limit_deg"), number("yaw_limit_deg"), number("rate_limit_deg_s")};
      sequences.insert_or_assign(id, GimbalSequence{Gimbal(limits, /*phantom_rate=*/true)});
    }
    const auto sequence = sequences.find(id);
    if (sequence == sequences.end() || sequence->second.next_tick++ != number("tick")) {
      throw InputError(table.place(row) + ": the ticks of a gimbal sequence are 0, 1, 2, ...");
    }
    Gimbal& gimbal = sequence->second.gimbal;
    const GimbalState before = gimbal.state();
    compare.number("pitch_before", before.pitch, kTolerance);
    compare.number("yaw_before", before.yaw, kTolerance);

    std::optional<GimbalCommand> command;
    if (number("ticks_since_command") == 0.0) {
      command = GimbalCommand{gimbal_mode(number("mode")), number("cmd_pitch"), number("cmd_yaw")};
    }
    gimbal.step(command);
    const GimbalState& state = gimbal.state();
    const double mode = number("effective_mode");  // any number that means the same mode passes
    compare.number("effective_mode", gimbal_mode(mode) == gimbal.mode() ? mode : number_of(gimbal.mode()), {});
    compare.number("pitch", state.pitch, kTolerance);
    compare.number("yaw", state.yaw, kTolerance);
    compare.number("pitch_rate", state.pitch_rate, kTolerance);
    compare.number("yaw_rate", state.yaw_rate, kTolerance);
    GimbalQuirks quirks;
    quirks.add_axis(gimbal.mode(), before.pitch, state.pitch, state.pitch_rate);
    quirks.add_axis(gimbal.mode(), before.yaw, state.yaw, state.yaw_rate);
    compare.flag("saturated_reference_quirk", quirks.saturated);
    compare.flag("partial_saturation_quirk", quirks.partial);
    compare.flag("stale_rate_quirk", quirks.stale);
  }
  return compare.report();
}

ControlMode control_mode(const GoldenTable& table, std::size_t row) {
  const std::string& name = table.text(row, "state_before");
  for (const ControlMode mode : {ControlMode::hold, ControlMode::yaw_only, ControlMode::moving}) {
    if (name == name_of(mode)) return mode;
  }
  throw InputError(table.place(row) + ": column 'state_before': '" + name + "'; hold, yaw_only or moving is expected");
}

/// Converts an age to ticks such that rounding does not move it across the limit: it stays below, at, or above it.
Tick age_of(double age_s) {
  constexpr Tick kLimit = PositionController::kMaxAge;
  if (age_s == seconds(kLimit)) return kLimit;
  return age_s < seconds(kLimit) ? std::min(ticks(age_s), kLimit - 1) : std::max(ticks(age_s), kLimit + 1);
}

GoldenReport check_position_control(const GoldenTable& table) {
  constexpr Tolerance kPositionSum{5e-6}, kYawSum{2e-6}, kAcceleration{5e-5}, kTilt{1e-5}, kYawRate{1e-5},
      kThrust{1.5e-4};
  GoldenComparison compare(table, "position_control");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    compare.begin_row(row);
    const auto number = [&](const char* column) { return table.number(row, column); };
    PositionController controller(reference_vehicle(table, row).position_control);
    PositionController::Memory memory;
    memory.mode = control_mode(table, row);
    memory.position_error_sum = table.vector(row, "pos_err_acc_");
    memory.yaw_error_sum = number("yaw_err_acc");
    controller.set_memory(memory);
    RigidBodyState body;
    body.p_WB = table.vector(row, "p");
    body.q_WB = table.quaternion(row);
    body.v_WB = table.vector(row, "vel_world_");
    const TrajectoryCommand command{table.vector(row, "cmd_p"), table.vector(row, "cmd_v"), table.vector(row, "cmd_a"),
                                    number("cmd_yaw")};

    const ControlDemand demand = controller.step(body, command, age_of(number("command_age_s")));
    const auto& after = controller.memory();
    compare.text("state_after", name_of(after.mode));
    compare.vector("eff_cmd_p", after.command.p_WB, kPositionSum);
    compare.angle("eff_cmd_yaw", after.command.yaw, kYawSum);
    compare.vector("pos_err_acc_out_", after.position_error_sum, kPositionSum);
    compare.number("yaw_err_acc_out", after.yaw_error_sum, kYawSum);
    compare.vector("tar_acc_", controller.target_acceleration(), kAcceleration);
    compare.number("roll_cmd", demand.roll, kTilt);
    compare.number("pitch_cmd", demand.pitch, kTilt);
    compare.number("yaw_rate_cmd", demand.yaw_rate, kYawRate);
    compare.number("thrust_cmd_N", demand.thrust_N, kThrust);
  }
  return compare.report();
}

GoldenReport check_attitude_control(const GoldenTable& table) {
  constexpr Tolerance kSpeed{1e-6}, kRest{1e-9};
  GoldenComparison compare(table, "attitude_control");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    compare.begin_row(row);
    const auto number = [&](const char* column) { return table.number(row, column); };
    AttitudeController controller(reference_vehicle(table, row));
    controller.set_integrators({number("roll_int"), number("pitch_int")});
    const ControlDemand demand{number("roll_cmd"), number("pitch_cmd"), number("yaw_rate_cmd"), number("thrust_cmd_N")};

    const RotorSpeeds speeds = controller.step(table.quaternion(row), table.vector(row, "w_B_"), demand);
    compare.number("roll_int_out", controller.integrators().roll, kRest);
    compare.number("pitch_int_out", controller.integrators().pitch, kRest);
    compare.vector("ang_acc_", controller.angular_acceleration(), kRest);
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      compare.number("rotor_" + std::to_string(i), speeds[i], kSpeed);
    }
  }
  return compare.report();
}

/// The table's obstacles: solid boxes along the world's axes.
struct Boxes {
  std::vector<Eigen::AlignedBox3d> boxes;

  /// Distance of the first box on the segment [m], by the slab method.
  std::optional<double> operator()(const Vector3d& from, const Vector3d& to) const {
    std::optional<double> nearest;
    for (const auto& box : boxes) {
      const auto entry = entry_share(box, from, to - from);
      if (entry && (!nearest || *entry < *nearest)) nearest = entry;
    }
    if (nearest) *nearest *= (to - from).norm();
    return nearest;
  }

 private:
  /// Where the segment enters the box, as a share of its length.
  static std::optional<double> entry_share(const Eigen::AlignedBox3d& box, const Vector3d& from, const Vector3d& way) {
    double enter = 0.0, leave = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      if (way[axis] == 0.0) {
        if (from[axis] < box.min()[axis] || from[axis] > box.max()[axis]) return std::nullopt;
        continue;
      }
      const double a = (box.min()[axis] - from[axis]) / way[axis], b = (box.max()[axis] - from[axis]) / way[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave ? std::optional(enter) : std::nullopt;
  }
};

GoldenReport check_los_antenna(const GoldenTable& table) {
  GoldenComparison compare(table, "los_antenna");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    compare.begin_row(row);
    Boxes obstacles;
    const int boxes = static_cast<int>(table.number(row, "n_boxes"));
    for (int i = 1; i <= boxes; ++i) {
      const std::string name = std::string("b").append(std::to_string(i));
      obstacles.boxes.emplace_back(table.vector(row, name + "_min_"), table.vector(row, name + "_max_"));
    }
    const AntennaNode from{table.vector(row, "n1_"), table.number(row, "n1_offset")};
    const AntennaNode to{table.vector(row, "n2_"), table.number(row, "n2_offset")};
    const LinkResult link = trace_link(from, to, obstacles);
    const SightLineCounts counts = count_sight_lines(from, to, obstacles);
    compare.number("centre_distance", link.range, {1e-9});
    compare.count("pairs_clear", counts.clear);
    compare.count("pairs_within_tolerance", counts.within_tolerance);
    compare.flag("linked", link.linked);
  }
  return compare.report();
}

}  // namespace

GoldenReport check_golden(const std::filesystem::path& file) {
  const GoldenTable table(file);
  if (table.has("mm_per_pixel_u")) return check_scoring(table);
  if (table.has("ticks_since_command")) return check_gimbal(table);
  if (table.has("command_age_s")) return check_position_control(table);
  if (table.has("rotor_0")) return check_attitude_control(table);
  if (table.has("pairs_clear")) return check_los_antenna(table);
  throw InputError(file.string() +
                   ":1: not a known table; expected the columns of scoring, gimbal, position_control, "
                   "attitude_control or los_antenna");
}

}  // namespace skein::sim
