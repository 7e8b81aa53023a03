#include "oracle/cache.hpp"

#include "core/text/sha256.hpp"
#include "oracle/kept_answer.hpp"
#include "oracle/mesh_hash.hpp"
#include "sight/camera_mount.hpp"

namespace skein::sim {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Must be increased with every change that may change an answer: of the search, of the visibility test, or of a
/// formula.
constexpr int kOracleVersion = 2;

Json part_to_json(const OracleSummary::Part& part) {
  const double coarse = part.coarse.score;
  return {{"points", part.attainable.points},
          {"score", part.attainable.score},
          {"coarse_points", part.coarse.points},
          {"coarse_score", coarse},
          {"change_percent", coarse > 0.0 ? 100.0 * (part.attainable.score - coarse) / coarse : 0.0}};
}

OracleSummary::Part part_from_json(const Json& json) {
  return {{json.at("points").get<std::size_t>(), json.at("score").get<double>()},
          {json.at("coarse_points").get<std::size_t>(), json.at("coarse_score").get<double>()}};
}

}  // namespace

OracleSummary summary_of(const OracleReport& report, const OracleConfig& config, double least) {
  std::vector<float> estimate;
  for (const PointView& view : report.reachable.best) {
    estimate.push_back(view.q >= least ? static_cast<float>(view.q) : 0.0F);
  }
  return {config.clearance_m,
          config.outside_berth_m,
          config.berth,
          report.reachable.best.size(),
          2 * config.directions,
          {report.reachable.attainable, report.reachable.coarse},
          {report.outside.attainable, report.outside.coarse},
          std::move(estimate),
          report.flyable};
}

Json to_json(const OracleSummary& summary) {
  std::string flyable;
  for (const std::uint8_t flag : summary.flyable) flyable += flag != 0 ? '1' : '0';
  return {{"points_total", summary.points_total},
          {"vehicle", summary.berth == Berth::body},
          {"clearance_m", summary.clearance_m},
          {"outside_berth_m", summary.outside_berth_m},
          {"directions", summary.directions},
          {"reachable", part_to_json(summary.reachable)},
          {"outside", part_to_json(summary.outside)},
          {"estimate", summary.estimate},
          {"flyable", flyable}};
}

OracleSummary summary_from_json(const Json& json) {
  OracleSummary summary{json.at("clearance_m").get<double>(),
                        json.at("outside_berth_m").get<double>(),
                        json.at("vehicle").get<bool>() ? Berth::body : Berth::camera,
                        json.at("points_total").get<std::size_t>(),
                        json.at("directions").get<std::size_t>(),
                        part_from_json(json.at("reachable")),
                        part_from_json(json.at("outside")),
                        json.at("estimate").get<std::vector<float>>(),
                        {}};
  for (const char digit : json.at("flyable").get<std::string>()) summary.flyable.push_back(digit == '1' ? 1 : 0);
  return summary;
}

std::string oracle_key(const Scenario& scenario, const Scene& scene, const OracleConfig& config) {
  Sha256 hash;
  hash.add("oracle").add(kOracleVersion);
  add_mesh(hash, scene.mesh);
  hash.add(scene.points.size());
  for (const InterestPoint& point : scene.points) {
    hash.add(Vector3d(point.p_W.cast<double>())).add(Vector3d(point.n_W.cast<double>()));
  }
  for (const UavConfig& uav : scenario.fleet) {
    hash.add(uav.start.x()).add(uav.start.y()).add(uav.vehicle.collision_box_m.z());
  }
  for (const CameraKind& kind : camera_kinds(scenario)) {
    for (const double value : kind.essence()) hash.add(value);
  }
  const RulesConfig& rules = scenario.rules;
  hash.add(scenario.desired_mm_per_pixel).add(rules.unnormalised_displacement).add(rules.limit_search_radius);
  hash.add(rules.min_point_score).add(rules.own_body_hides).add(rules.camera_blind_in_structure);
  hash.add(rules.ray_ends_at_point);
  hash.add(config.clearance_m).add(config.outside_berth_m).add(config.directions).add(config.berth == Berth::body);
  return hash.hex();
}

OracleReply ask_oracle(const Scenario& scenario, const Scene& scene, const OracleRequest& request) {
  OracleReply reply;
  const std::string key = oracle_key(scenario, scene, request.config);
  const fs::path file = request.cache.value_or("") / ("oracle-" + key + ".json");
  try {
    const auto kept = request.cache ? kept_answer(file, key) : std::nullopt;
    if (kept) reply.summary = summary_from_json(*kept);
  } catch (const std::exception& error) {
    reply.warnings.push_back(file.string() + " is not used: " + error.what());
  }
  if (reply.summary) {
    reply.cached = true;
    return reply;
  }
  reply.expected_s = expected_seconds(scenario, scene, request.config);
  if (request.patience_s && reply.expected_s > *request.patience_s) return reply;
  reply.summary =
      summary_of(consult_oracle(scenario, scene, request.config), request.config, scenario.rules.min_point_score);
  try {
    if (request.cache) keep_answer(file, key, to_json(*reply.summary));
  } catch (const std::exception& error) {
    reply.warnings.push_back("the oracle's answer is not kept: " + std::string(error.what()));
  }
  return reply;
}

}  // namespace skein::sim
