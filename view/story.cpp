#include "view/story.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/euler.hpp"
#include "core/text.hpp"
#include "report/page_data.hpp"

namespace skein::view {
namespace {

/// Beyond all bounds of a scene: a body whose motion no number describes is drawn there.
constexpr double kFarthest_m = 1e6;

long whole(double value, double by) {
  return std::isfinite(value) ? std::lround(by * std::clamp(value, -kFarthest_m, kFarthest_m)) : 0;
}

/// The axis of the camera, which looks along its x. Where the camera sits and what it sees do not matter for that.
Vector3d view_axis(const ShownUav& uav) {
  return camera_state(uav.body, uav.gimbal, CameraConfig{}).X_WC.linear() * Vector3d::UnitX();
}

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

Json scene_json(const report::RunData& run, std::span<const CameraConfig> cameras, std::span<const double> range_m) {
  Json scene = report::scene_data(run);
  scene["uavs"] = Json::array();
  for (std::size_t i = 0; i < run.uavs.size(); ++i) {
    scene["uavs"].push_back({{"name", run.uavs[i]},
                             {"explorer", static_cast<bool>(run.explorer[i])},
                             {"hfov", cameras[i].hfov_deg},
                             {"vfov", cameras[i].vfov_deg},
                             {"range", range_m[i]}});
  }
  return scene;
}

std::string poses_json(std::span<const ShownUav> uavs) {
  std::string list;
  for (const ShownUav& uav : uavs) {
    const Vector3d& p_WB = uav.body.p_WB;
    const Vector3d axis = view_axis(uav);
    fmt::format_to(std::back_inserter(list), "{}[{},{},{},{},{},{}]", list.empty() ? "" : ",", whole(p_WB.x(), 100.0),
                   whole(p_WB.y(), 100.0), whole(p_WB.z(), 100.0), whole(std::atan2(axis.y(), axis.x()), 1000.0),
                   whole(std::asin(std::clamp(-axis.z(), -1.0, 1.0)), 1000.0), uav.alive ? 1 : 0);
  }
  return "[" + list + "]";
}

std::string pose_line(double time_s, std::span<const ShownUav> uavs) {
  return fmt::format(R"({{"k":"pose","t":{:.3f},"u":{}}})", time_s, poses_json(uavs));
}

std::string links_line(double time_s, std::span<const ShownLink> row_major) {
  std::string digits;
  for (const ShownLink link : row_major) digits += static_cast<char>('0' + static_cast<int>(link));
  return fmt::format(R"({{"k":"links","t":{:.3f},"l":"{}"}})", time_s, digits);
}

std::string event_line(double time_s, const std::string& event, const std::string& subject, const std::string& object) {
  return fmt::format(R"({{"k":"event","t":{:.3f},"e":{},"s":{},"o":{}}})", time_s, quoted(event), quoted(subject),
                     quoted(object));
}

std::string capture_line(double time_s, std::size_t uav, std::uint64_t capture,
                         const std::vector<CapturePoint>& points) {
  std::string list;
  for (const CapturePoint& point : points) {
    fmt::format_to(std::back_inserter(list), "{}[{},{:.4f},{:.4f},{:.4f},{:.4f}]", list.empty() ? "" : ",", point.index,
                   point.q, point.q_blur, point.q_res, point.q_distance);
  }
  return fmt::format(R"({{"k":"capture","t":{:.3f},"u":{},"c":{},"p":[{}]}})", time_s, uav, capture, list);
}

std::string delivered_line(double time_s, std::size_t uav, std::uint64_t capture) {
  return fmt::format(R"({{"k":"delivered","t":{:.3f},"u":{},"c":{}}})", time_s, uav, capture);
}

std::string void_line(double time_s, std::size_t uav) {
  return fmt::format(R"({{"k":"void","t":{:.3f},"u":{}}})", time_s, uav);
}

std::string score_line(double time_s, std::size_t points, double score) {
  return fmt::format(R"({{"k":"score","t":{:.3f},"n":{},"s":{}}})", time_s, points, shortest(score));
}

}  // namespace skein::view
