#include "results/run_rows.hpp"

namespace skein::results {
namespace {

// Names of columns that several tables have.
constexpr const char* kTime = "time_s";
constexpr const char* kUav = "uav";
constexpr const char* kStep = "step";
constexpr const char* kScoreColumn = "score";
constexpr const char* kAlive = "alive";

}  // namespace

Vector3d RunRow::vector(const char* x, const char* y, const char* z) const {
  const double first = table_.number(x), second = table_.number(y), third = table_.number(z);
  return {first, second, third};
}

const std::string& CaptureCells::uav() const { return table_.text(kUav); }
std::uint64_t CaptureCells::capture() const { return table_.count("capture"); }
double CaptureCells::time_s() const { return table_.number(kTime); }
std::uint64_t CaptureCells::point() const { return table_.count("point"); }
double CaptureCells::q() const { return table_.number("q"); }
double CaptureCells::q_blur() const { return table_.number("q_blur"); }
double CaptureCells::q_res() const { return table_.number("q_res"); }
double CaptureCells::q_distance() const { return table_.number("q_distance"); }
std::optional<double> CaptureCells::delivered_at_s() const { return table_.number_if_any("delivered_at_s"); }
const std::string& CaptureCells::reason() const { return table_.text("reason"); }

std::uint64_t EventCells::step() const { return table_.count(kStep); }
double EventCells::time_s() const { return table_.number(kTime); }
const std::string& EventCells::event() const { return table_.text("event"); }
const std::string& EventCells::subject() const { return table_.text("subject"); }
const std::string& EventCells::object() const { return table_.text("object"); }

std::uint64_t MessageCells::step() const { return table_.count(kStep); }
const std::string& MessageCells::uav() const { return table_.text(kUav); }
std::optional<std::uint64_t> MessageCells::arrives() const { return table_.count_if_any("arrives"); }

double PoseCells::time_s() const { return table_.number(kTime); }
const std::string& PoseCells::uav() const { return table_.text(kUav); }
Vector3d PoseCells::p_W() const { return vector("x", "y", "z"); }
Quaterniond PoseCells::q_WB() const {
  const double w = table_.number("qw");
  const Vector3d xyz = vector("qx", "qy", "qz");
  return {w, xyz.x(), xyz.y(), xyz.z()};
}
Vector3d PoseCells::v_W() const { return vector("vx", "vy", "vz"); }
GimbalState PoseCells::gimbal() const {
  GimbalState gimbal;
  gimbal.pitch = table_.number("gimbal_pitch");
  gimbal.yaw = table_.number("gimbal_yaw");
  return gimbal;
}
bool PoseCells::alive() const { return table_.text(kAlive) != "0"; }
bool PoseCells::alive_beyond_doubt() const { return table_.number(kAlive) != 0.0; }
std::optional<double> PoseCells::clearance_m() const { return table_.number_if_any("clearance"); }
std::optional<double> PoseCells::charge() const {
  return table_.has("charge") ? table_.number_if_any("charge") : std::nullopt;
}

double ScoreCells::time_s() const { return table_.number(kTime); }
double ScoreCells::points() const { return table_.number("points"); }
double ScoreCells::score() const { return table_.number(kScoreColumn); }

Vector3d PointCells::p_W() const { return vector("x", "y", "z"); }
Vector3d PointCells::normal_W() const { return vector("nx", "ny", "nz"); }
double PointCells::score() const { return table_.number(kScoreColumn); }

std::uint64_t LossCells::index() const { return table_.count("index"); }
double LossCells::estimate() const { return table_.number("estimate"); }
double LossCells::loss() const { return table_.number("loss"); }
const std::string& LossCells::cause() const { return table_.text("cause"); }

double WorkCells::time_s() const { return table_.number(kTime); }
const std::string& WorkCells::uav() const { return table_.text(kUav); }
double WorkCells::without_work_s() const { return table_.number("without_work_s"); }

double ActivityCells::time_s() const { return table_.number(kTime); }
const std::string& ActivityCells::uav() const { return table_.text(kUav); }
Activity ActivityCells::activity() const {
  Activity activity{
      .mode = table_.text("mode"), .waits_for = table_.text("waits_for"), .no_way = table_.text("no_way")};
  if (const auto x = table_.number_if_any("goal_x")) {
    activity.goal_W = Vector3d(*x, table_.number("goal_y"), table_.number("goal_z"));
  }
  return activity;
}

std::string no_file(const char* file) { return std::string("There is no ") + file + "."; }

std::string damaged_table(const std::filesystem::path& dir, const char* table, std::size_t rows, const char* what) {
  const std::string why = what, folder = dir.string() + "/";
  return std::string(table) + " makes sense for " + std::to_string(rows) + " rows only (" +
         (why.starts_with(folder) ? why.substr(folder.size()) : why) + ").";
}

}  // namespace skein::results
