#include "results/losses.hpp"

#include <algorithm>
#include <sstream>

#include "process/files/atomic_file.hpp"
#include "results/run_folder.hpp"
#include "results/run_rows.hpp"
#include "results/score_losses.hpp"

namespace skein::results {
namespace {

/// @returns 0 if the table is missing or has no entry for the point.
float score_of(const std::optional<std::vector<Amount>>& table, std::size_t point) {
  return table && point < table->size() ? static_cast<float>((*table)[point]) : 0.0F;
}

/// Adds the best picture of each point that only had pictures too poor to count. Reports of earlier versions have none;
/// an invalid entry counts as missing.
void add_poor_pictures(const SimServerReport& report, std::vector<PointRecord>& points) {
  if (!report.points_poor) return;
  for (const PoorPointReport& poor : *report.points_poor) {
    const bool whole = poor.index && poor.q && poor.q_blur && poor.q_distance && poor.q_res;
    if (!whole || *poor.index >= points.size()) continue;
    CaptureRow row;
    row.q = *poor.q;
    row.q_blur = *poor.q_blur;
    row.q_res = *poor.q_res;
    row.q_distance = *poor.q_distance;
    points[*poor.index].poor = row;
  }
}

/// The record of each point of the scene; nullopt if an input is missing or does not fit the scene.
std::optional<std::vector<PointRecord>> point_records(const std::filesystem::path& dir, const Json& answer,
                                                      const Reports& reports, std::size_t count) {
  if (!reports.sim_server || !reports.station || !reports.station->points) return std::nullopt;
  const Json estimate = value_or(answer, "estimate", Json::array());
  const std::string flyable = value_or(answer, "flyable", ""), seen = reports.sim_server->points_seen.value_or("");
  const bool whole = estimate.size() == count && flyable.size() == count && seen.size() == count;
  if (!whole || count == 0) return std::nullopt;
  std::vector<PointRecord> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (!estimate[i].is_number()) return std::nullopt;
    points[i].estimate = estimate[i].get<float>();
    points[i].flyable = flyable[i] == '1';
    points[i].seen = seen[i] == '1';
    points[i].if_exact = score_of(reports.sim_server->points_if_exact, i);
    points[i].if_calm = score_of(reports.sim_server->points_if_calm, i);
  }
  add_poor_pictures(*reports.sim_server, points);
  for (const ScoredPointReport& point : *reports.station->points) {
    const std::size_t index = point.index.value_or(count);
    if (index >= count) return std::nullopt;
    points[index].score = static_cast<float>(point.score.value_or(0.0));
  }
  for (CaptureRow& row : read_rows<CaptureRow>(dir)) {
    if (row.point >= count) return std::nullopt;
    points[row.point].captures.push_back(std::move(row));
  }
  return points;
}

BatteryEffects battery_effects(const SimServerReport& report) {
  BatteryEffects effects;
  bool all = true, any = false;
  for (const UavReport& uav : report.uavs) {
    const bool grounded = uav.battery && uav.battery->grounded.value_or(false);
    any |= grounded;
    all &= grounded || !uav.alive.value_or(true);
  }
  effects.no_uav_could_fly = all && any;
  for (const CollisionReport& collision : report.collisions) {
    if (collision.cause == "battery" && collision.uav) effects.fell.insert(*collision.uav);
  }
  return effects;
}

Json json_of_sum(const LossSum& sum) { return {{"points", sum.points}, {"score", sum.score}}; }

/// The number as text that reads back as the same value.
std::string text(double value) { return Json(value).dump(); }

std::string csv_line(std::size_t index, const Json& place, const PointRecord& point, const PointLoss& loss) {
  std::ostringstream line;
  line << index;
  for (std::size_t axis = 0; axis < 3; ++axis)
    line << ',' << (place.is_array() && axis < place.size() ? place[axis].dump() : "");
  line << ',' << text(point.estimate) << ',' << text(point.score) << ',' << name_of(loss.cause) << ','
       << text(loss.loss);
  line << ',';
  if (loss.best)
    line << loss.best->uav << ',' << loss.best->capture;
  else
    line << ',';
  if (const auto& shown = loss.best ? loss.best : loss.poor) {
    line << ',' << text(shown->q_distance) << ',' << text(tilt_quality(*shown)) << ',' << text(shown->q_blur) << ','
         << text(shown->q);
  } else {
    line << ",,,,";
  }
  line << ',' << loss.poor_part() << '\n';
  return line.str();
}

}  // namespace

Json write_losses(const std::filesystem::path& dir, const Json& answer, const Reports& reports) {
  const Json places = value_or(read_json(dir / run_folder::kScene), "points", Json::array());
  const auto points = point_records(dir, answer, reports, places.size());
  if (!points) return nullptr;
  const BatteryEffects batteries = battery_effects(*reports.sim_server);
  std::vector<PointLoss> losses;
  std::string csv = "index,x,y,z,estimate,score,cause,loss,uav,capture,q_distance,q_tilt,q_blur,q,part\n";
  for (std::size_t i = 0; i < points->size(); ++i) {
    const PointRecord& point = (*points)[i];
    losses.push_back(loss_of(point, batteries));
    if (point.estimate > 0.0F || point.score > 0.0F) csv += csv_line(i, places[i], point, losses.back());
  }
  write_file_atomically(dir / run_folder::kLosses, csv);
  Json by_cause = Json::object();
  for (const auto& [cause, sum] : sum_up(losses)) by_cause[name_of(cause)] = json_of_sum(sum);
  const auto poor = sum_up_poor(losses);
  Json& by_part = by_cause[name_of(LossCause::below_threshold)]["by_part"];
  for (std::size_t i = 0; i < poor.size(); ++i) by_part[kPoorParts[i].key] = json_of_sum(poor[i]);
  return by_cause;
}

std::array<LossSum, kPoorParts.size()> poor_parts(const Json& losses) {
  const auto sum_in = [](const Json& parent, const char* key) {
    const Json sum = value_or(parent, key, Json::object());
    return LossSum{static_cast<std::size_t>(std::max(number_in(sum, "points"), 0.0)), number_in(sum, "score")};
  };
  const char* cause = kCauses[*cause_of("below_threshold")].key;
  const Json by_part = value_or(value_or(losses, cause, Json::object()), "by_part", Json());
  std::array<LossSum, kPoorParts.size()> parts;
  if (!by_part.is_object()) {
    parts.back() = sum_in(losses, cause);
    return parts;
  }
  for (std::size_t i = 0; i < parts.size(); ++i) parts[i] = sum_in(by_part, kPoorParts[i].key);
  return parts;
}

}  // namespace skein::results
