#include "sim_server/plan/plan_cache.hpp"

#include <initializer_list>

#include "core/text/sha256.hpp"
#include "oracle/cache.hpp"
#include "oracle/kept_answer.hpp"

namespace skein::sim {
namespace {

using Json = nlohmann::ordered_json;

/// Increment it with each change of the code that may change the plan for the same inputs, or the flight of a plan.
constexpr int kPlanVersion = 1;

Json numbers(const Vector3d& p) { return {p.x(), p.y(), p.z()}; }
double number(const Json& json, const char* key) { return json.at(key).get<double>(); }
std::size_t count(const Json& json, const char* key) { return json.at(key).get<std::size_t>(); }
Vector3d vector_from(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Json move_to_json(const PlanMove& move) {
  return {{"from_s", move.from_s}, {"until_s", move.until_s}, {"to", numbers(move.to_W)},
          {"yaw", move.yaw},       {"pitch", move.pitch},     {"picture", move.picture}};
}

Json uav_to_json(const PlanUav& uav) {
  Json moves = Json::array();
  for (const PlanMove& move : uav.moves) moves.push_back(move_to_json(move));
  const Json start = uav.moves.empty() ? Json(nullptr) : numbers(uav.moves.front().from_W);
  return {{"name", uav.name}, {"views", uav.views}, {"time_s", uav.time_s}, {"distance_m", uav.distance_m},
          {"start", start},   {"moves", moves}};
}

PlanUav uav_from_json(const Json& json) {
  PlanUav uav;
  uav.name = json.at("name").get<std::string>();
  uav.views = count(json, "views");
  uav.time_s = number(json, "time_s");
  uav.distance_m = number(json, "distance_m");
  Vector3d at = json.at("start").is_null() ? Vector3d::Zero() : vector_from(json.at("start"));
  for (const Json& move : json.at("moves")) {
    const Vector3d to_W = vector_from(move.at("to"));
    uav.moves.push_back({number(move, "from_s"), number(move, "until_s"), at, to_W, number(move, "yaw"),
                         number(move, "pitch"), move.at("picture").get<bool>()});
    at = to_W;
  }
  return uav;
}

void add_numbers(Sha256& hash, std::initializer_list<double> values) {
  for (const double value : values) hash.add(value);
}

/// Adds the vehicle's flight parameters, which oracle_key() leaves out because the oracle's answer does not depend on
/// them.
void add_vehicle(Sha256& hash, const VehicleConfig& vehicle) {
  const PositionControlConfig& law = vehicle.position_control;
  const AttitudeControlConfig& attitude = vehicle.attitude_control;
  add_numbers(hash, {vehicle.mass_kg, vehicle.rotor_mass_kg, vehicle.inertia.x(), vehicle.inertia.y(),
                     vehicle.inertia.z(), vehicle.rotor_force_constant, vehicle.rotor_moment_constant,
                     vehicle.rotor_max_speed, vehicle.motor_time_constant_up_s, vehicle.motor_time_constant_down_s,
                     vehicle.rotor_drag, vehicle.rolling_moment, vehicle.antenna_offset_m, vehicle.max_speed_mps,
                     vehicle.max_acceleration_mps2, vehicle.max_yaw_rate_deg_s, vehicle.gimbal.rate_limit_deg_s,
                     vehicle.camera.exposure_s, vehicle.camera.trigger_interval_s});
  add_numbers(hash, {law.omega_xy, law.omega_z, law.zeta_xy, law.zeta_z, law.ki_xy, law.ki_z, law.thrust_scale,
                     law.max_tilt_deg, attitude.p_gain, attitude.q_gain, attitude.r_gain});
  const Vector3d assumed_inertia = attitude.inertia.value_or(Vector3d::Zero());
  add_numbers(hash, {assumed_inertia.x(), assumed_inertia.y(), assumed_inertia.z()});
  for (const VehicleLink& link : vehicle.links) {
    add_numbers(hash, {link.mass_kg, link.inertia.x(), link.inertia.y(), link.inertia.z(), link.p_BL.x(), link.p_BL.y(),
                       link.p_BL.z()});
  }
}

void add_rules(Sha256& hash, const RulesConfig& rules) {
  hash.add(rules.reject_commands_beyond_limits).add(rules.guard_position_commands).add(rules.collision_kills_both);
  hash.add(rules.collision_voids_score).add(rules.phantom_gimbal_rate);
  add_numbers(hash, {rules.takeoff_height_m, rules.takeoff_speed_mps});
}

}  // namespace

Json to_json(const Plan& plan) {
  Json uavs = Json::array();
  for (const PlanUav& uav : plan.uavs) uavs.push_back(uav_to_json(uav));
  const PlanFlight& flown = plan.flown;
  return {{"score", plan.score},
          {"points", plan.points},
          {"views", plan.views},
          {"margin_m", plan.margin_m},
          {"flown",
           {{"score", flown.score},
            {"points", flown.points},
            {"collisions", flown.collisions},
            {"astray_m", flown.astray_m}}},
          {"uavs", uavs}};
}

Plan plan_from_json(const Json& json) {
  Plan plan;
  plan.score = number(json, "score");
  plan.points = count(json, "points");
  plan.views = count(json, "views");
  plan.margin_m = number(json, "margin_m");
  const Json& flown = json.at("flown");
  plan.flown = {number(flown, "score"), count(flown, "points"), count(flown, "collisions"), number(flown, "astray_m")};
  for (const Json& uav : json.at("uavs")) plan.uavs.push_back(uav_from_json(uav));
  return plan;
}

std::string plan_key(const Scenario& scenario, const Scene& scene, const PlanConfig& config) {
  Sha256 hash;
  hash.add("plan").add(kPlanVersion).add(oracle_key(scenario, scene, {}));
  add_numbers(
      hash, {scenario.duration_s, scenario.takeoff_timeout_s, scenario.exchange_period_s, scenario.station_position.x(),
             scenario.station_position.y(), scenario.station_position.z(), scenario.station_antenna_offset_m});
  add_rules(hash, scenario.rules);
  hash.add(scenario.fleet.size());
  for (const UavConfig& uav : scenario.fleet) {
    hash.add(uav.name).add(uav.start_yaw);
    for (const double value : CameraKind{uav.vehicle.camera, uav.vehicle.gimbal, body_shape(uav.vehicle)}.essence()) {
      hash.add(value);
    }
    add_vehicle(hash, uav.vehicle);
  }
  for (const LinkEffect& effect : scenario.links) {
    if (!effect.range_m) continue;  // links without a range only delay or lose messages, which plans ignore
    hash.add(*effect.range_m).add(effect.from.size());
    for (const std::string& node : effect.from) hash.add(node);
    for (const std::string& node : effect.to) hash.add(node);
  }
  add_numbers(hash, {config.margin_m, config.speed_share, config.acceleration_share, config.settle_s});
  hash.add(config.most_seeds).add(config.most_views).add(config.most_nodes).add(config.rounds).add(config.seed);
  return hash.hex();
}

PlanReply ask_plan(const Scenario& scenario, const Scene& scene, const PlanRequest& request) {
  PlanReply reply;
  const std::string key = plan_key(scenario, scene, request.config);
  const std::filesystem::path file = request.cache.value_or("") / ("plan-" + key + ".json");
  try {
    const auto kept = request.cache ? kept_answer(file, key) : std::nullopt;
    if (kept) reply.plan = plan_from_json(*kept);
  } catch (const std::exception& error) {
    reply.warnings.push_back(file.string() + " is not used: " + error.what());
  }
  if (reply.plan || !request.search) return reply;
  reply.plan = make_plan(scenario, scene, request.config);
  reply.plan->flown = fly_plan(scenario, scene, request.config, *reply.plan);
  try {
    if (request.cache) keep_answer(file, key, to_json(*reply.plan));
  } catch (const std::exception& error) {
    reply.warnings.push_back("the plan cannot be stored for later runs: " + std::string(error.what()));
  }
  return reply;
}

}  // namespace skein::sim
