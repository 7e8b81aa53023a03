#include "view/story.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/math/euler.hpp"
#include "core/text/text.hpp"
#include "report/page_data.hpp"

namespace skein::view {
namespace {

/// Coordinates are clamped to this distance, which is beyond the bounds of any scene.
constexpr double kFarthest_m = 1e6;
constexpr double kQualityUnits = 1e6, kPartUnits = 1000.0;

long whole(double value, double by) {
  return std::isfinite(value) ? std::lround(by * std::clamp(value, -kFarthest_m, kFarthest_m)) : 0;
}

/// Rounds a quality, but never up to kDetectedQuality: below it, a point does not count.
long quality(float q) {
  const long rounded = whole(q, kQualityUnits);
  const long least = std::lround(kDetectedQuality * kQualityUnits);
  return q < kDetectedQuality ? std::min(rounded, least - 1) : rounded;
}

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

Json scene_json(const results::RunRecord& run, std::span<const CameraConfig> cameras, std::span<const double> range_m) {
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
    const results::ViewAngles view = results::view_angles(uav.body.q_WB, uav.gimbal);
    fmt::format_to(std::back_inserter(list), "{}[{},{},{},{},{},{}]", list.empty() ? "" : ",", whole(p_WB.x(), 100.0),
                   whole(p_WB.y(), 100.0), whole(p_WB.z(), 100.0), whole(view.yaw, 1000.0), whole(view.pitch, 1000.0),
                   uav.alive ? 1 : 0);
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

std::string activity_line(double time_s, std::size_t uav, const Activity& activity) {
  const auto& goal_W = activity.goal_W;
  const std::string goal = goal_W ? fmt::format("[{},{},{}]", whole(goal_W->x(), 100.0), whole(goal_W->y(), 100.0),
                                                whole(goal_W->z(), 100.0))
                                  : "null";
  return fmt::format(R"({{"k":"activity","t":{:.3f},"u":{},"m":{},"g":{},"w":{},"n":{}}})", time_s, uav,
                     quoted(activity.mode), goal, quoted(activity.waits_for), quoted(activity.no_way));
}

std::string numbers_json(std::span<const std::optional<ShownNumbers>> uavs) {
  std::string list;
  for (const auto& uav : uavs) {
    if (!list.empty()) list += ",";
    if (!uav) {
      list += "null";
      continue;
    }
    const std::string cpu = uav->cpu_per_s ? std::to_string(whole(*uav->cpu_per_s, 1000.0)) : "null";
    list += fmt::format("[{},{},{}]", whole(uav->speed_mps, 100.0), uav->undelivered, cpu);
  }
  return "[" + list + "]";
}

std::string fault_line(double time_s, const ToldFault& fault, bool begins) {
  return fmt::format(R"({{"k":"fault","t":{:.3f},"n":{},"hand":{},"on":{},"kind":{},"of":{}}})", time_s, fault.number,
                     fault.by_hand ? 1 : 0, begins ? 1 : 0, quoted(fault.kind), quoted(fault.target));
}

std::string capture_line(double time_s, std::size_t uav, std::uint64_t capture,
                         const std::vector<CapturePoint>& points) {
  std::string list;
  long former = 0;
  for (const CapturePoint& point : points) {
    const long index = point.index;
    fmt::format_to(std::back_inserter(list), "{}{},{},{},{}", list.empty() ? "" : ",", index - former, quality(point.q),
                   whole(point.q_blur, kPartUnits), whole(point.q_distance, kPartUnits));
    former = index;
  }
  return fmt::format(R"({{"k":"capture","t":{:.3f},"u":{},"c":{},"p":[{}]}})", time_s, uav, capture, list);
}

std::string delivered_line(double time_s, std::span<const ShownDelivery> deliveries) {
  std::string list;
  for (const ShownDelivery& one : deliveries) {
    fmt::format_to(std::back_inserter(list), "{}{},{}", list.empty() ? "" : ",", one.uav, one.capture);
  }
  return fmt::format(R"({{"k":"delivered","t":{:.3f},"d":[{}]}})", time_s, list);
}

std::string estimate_line(double time_s, std::span<const float> q, std::span<const std::uint8_t> flyable) {
  std::string estimates, beyond;
  std::size_t former = 0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    fmt::format_to(std::back_inserter(estimates), "{}{}", i == 0 ? "" : ",", quality(q[i]));
    if (q[i] <= 0.0F || flyable[i] != 0) continue;
    fmt::format_to(std::back_inserter(beyond), "{}{}", beyond.empty() ? "" : ",", i - former);
    former = i;
  }
  return fmt::format(R"({{"k":"estimate","t":{:.3f},"q":[{}],"no":[{}]}})", time_s, estimates, beyond);
}

std::string void_line(double time_s, std::size_t uav) {
  return fmt::format(R"({{"k":"void","t":{:.3f},"u":{}}})", time_s, uav);
}

std::string score_line(double time_s, std::size_t points, double score) {
  return fmt::format(R"({{"k":"score","t":{:.3f},"n":{},"s":{}}})", time_s, points, shortest(score));
}

}  // namespace skein::view
