#include "results/losses.hpp"

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

/// The number as text that reads back as the same value.
std::string text(double value) { return Json(value).dump(); }

std::string csv_line(std::size_t index, const Json& place, const PointRecord& point, const PointLoss& loss) {
  std::ostringstream line;
  line << index;
  for (std::size_t axis = 0; axis < 3; ++axis) line << ',' << (axis < place.size() ? place[axis].dump() : "");
  line << ',' << text(point.estimate) << ',' << text(point.score) << ',' << name_of(loss.cause) << ','
       << text(loss.loss);
  if (const auto& best = loss.best) {
    line << ',' << best->uav << ',' << best->capture << ',' << text(best->q_distance) << ','
         << text(tilt_quality(*best)) << ',' << text(best->q_blur) << ',' << text(best->q);
  } else {
    line << ",,,,,,";
  }
  return line.str() + "\n";
}

}  // namespace

Json write_losses(const std::filesystem::path& dir, const Json& answer, const Reports& reports) {
  const Json places = value_or(read_json(dir / run_folder::kScene), "points", Json::array());
  const auto points = point_records(dir, answer, reports, places.size());
  if (!points) return nullptr;
  const BatteryEffects batteries = battery_effects(*reports.sim_server);
  std::vector<PointLoss> losses;
  std::string csv = "index,x,y,z,estimate,score,cause,loss,uav,capture,q_distance,q_tilt,q_blur,q\n";
  for (std::size_t i = 0; i < points->size(); ++i) {
    const PointRecord& point = (*points)[i];
    losses.push_back(loss_of(point, batteries));
    if (point.estimate > 0.0F || point.score > 0.0F) csv += csv_line(i, places[i], point, losses.back());
  }
  write_file_atomically(dir / run_folder::kLosses, csv);
  Json by_cause = Json::object();
  for (const auto& [cause, sum] : sum_up(losses))
    by_cause[name_of(cause)] = {{"points", sum.points}, {"score", sum.score}};
  return by_cause;
}

}  // namespace skein::results
