#include "results/run_rows.hpp"

#include <cmath>

namespace skein::results {
namespace {

// Names of columns that several tables have.
constexpr const char* kTime = "time_s";
constexpr const char* kUav = "uav";
constexpr const char* kStep = "step";
constexpr const char* kScoreColumn = "score";

double bounded(const CsvTable& table, const char* column) {
  const double value = table.number(column);
  if (std::abs(value) > kFarthest) {
    table.fail(std::string("column '") + column + "': '" + table.text(column) + "' is out of range");
  }
  return value;
}

/// nullopt: the cell is empty.
std::optional<double> bounded_if_any(const CsvTable& table, const char* column) {
  return table.text(column).empty() ? std::nullopt : std::optional(bounded(table, column));
}

/// 0: the table has no such column.
double bounded_or_zero(const CsvTable& table, const char* column) {
  return table.has(column) ? bounded(table, column) : 0.0;
}

Vector3d vector(const CsvTable& table, const char* x, const char* y, const char* z) {
  const double first = bounded(table, x), second = bounded(table, y), third = bounded(table, z);
  return {first, second, third};
}

}  // namespace

CaptureRow CaptureRow::read(const CsvTable& table) {
  return {.uav = table.text(kUav),
          .capture = table.count("capture"),
          .time_s = bounded(table, kTime),
          .point = table.count("point"),
          .q = bounded(table, "q"),
          .delivered_at_s = bounded_if_any(table, "delivered_at_s"),
          .reason = table.text("reason"),
          .q_blur = bounded_or_zero(table, "q_blur"),
          .q_res = bounded_or_zero(table, "q_res"),
          .q_distance = bounded_or_zero(table, "q_distance")};
}

EventRow EventRow::read(const CsvTable& table) {
  EventRow row{.step = table.count(kStep),
               .event = table.text("event"),
               .subject = table.text("subject"),
               .object = table.text("object"),
               .time_s = bounded(table, kTime)};
  if (row.is_of_a_capture()) table.count("object");  // refuses what is no number
  return row;
}

MessageRow MessageRow::read(const CsvTable& table) {
  return {.step = table.count(kStep), .uav = table.text(kUav), .arrives = table.count_if_any("arrives")};
}

PoseRow PoseRow::read(const CsvTable& table) {
  PoseRow row{.time_s = bounded(table, kTime), .uav = table.text(kUav), .p_W = vector(table, "x", "y", "z")};
  if (table.has("vx")) row.v_W = vector(table, "vx", "vy", "vz");
  if (table.has("alive")) row.alive = bounded(table, "alive") != 0.0;
  if (table.has("clearance")) row.clearance_m = bounded_if_any(table, "clearance");
  if (table.has("charge")) row.charge = bounded_if_any(table, "charge");
  if (table.has("qw")) {
    row.q_WB.w() = bounded(table, "qw");
    row.q_WB.vec() = vector(table, "qx", "qy", "qz");
  }
  row.gimbal.pitch = bounded_or_zero(table, "gimbal_pitch");
  row.gimbal.yaw = bounded_or_zero(table, "gimbal_yaw");
  return row;
}

ScoreRow ScoreRow::read(const CsvTable& table) {
  return {.time_s = bounded(table, kTime), .score = bounded(table, kScoreColumn), .points = bounded(table, "points")};
}

PointRow PointRow::read(const CsvTable& table) {
  return {.p_W = vector(table, "x", "y", "z"),
          .normal_W = vector(table, "nx", "ny", "nz"),
          .score = bounded(table, kScoreColumn)};
}

LossRow LossRow::read(const CsvTable& table) {
  return {.point = table.count("index"),
          .estimate = bounded(table, "estimate"),
          .loss = bounded(table, "loss"),
          .cause = table.text("cause")};
}

WorkRow WorkRow::read(const CsvTable& table) {
  return {.time_s = bounded(table, kTime), .uav = table.text(kUav), .without_work_s = bounded(table, "without_work_s")};
}

ActivityRow ActivityRow::read(const CsvTable& table) {
  ActivityRow row{.time_s = bounded(table, kTime), .uav = table.text(kUav)};
  row.activity.mode = table.text("mode");
  row.activity.waits_for = table.text("waits_for");
  row.activity.no_way = table.text("no_way");
  if (!table.text("goal_x").empty()) row.activity.goal_W = vector(table, "goal_x", "goal_y", "goal_z");
  return row;
}

std::string no_file(const char* file) { return std::string(kThereIsNo) + file + "."; }

std::string damaged_table(const std::filesystem::path& dir, const char* table, std::size_t rows, const char* what) {
  const std::string why = what, folder = dir.string() + "/";
  return std::string(table) + " is readable only up to row " + std::to_string(rows) + " (" +
         (why.starts_with(folder) ? why.substr(folder.size()) : why) + ").";
}

}  // namespace skein::results
