#include "cli/study/figures_json.hpp"

namespace skein::cli {
namespace {

/// Calls `each` with the key and the value of each figure, for both reading and writing.
template <class Figures, class Each>
void each_figure(Figures& f, const Each& each) {
  each("score", f.score);
  each("points_detected", f.points_detected);
  each("points_total", f.points_total);
  each("attainable_percent", f.attainable_percent);
  each("attainable", f.attainable);
  each("mean_quality", f.mean_quality);
  each("greatest_share", f.greatest_share);
  each("collisions", f.collisions);
  each("collisions_by_battery", f.collisions_by_battery);
  each("frozen_uavs", f.frozen_uavs);
  each("waiting_uavs", f.waiting_uavs);
  each("frozen_s", f.frozen_s);
  each("waited_s", f.waited_s);
  each("without_work_s", f.without_work_s);
  each("idle_explorers_s", f.idle_explorers_s);
  each("idle_photographers_s", f.idle_photographers_s);
  each("distance_m", f.distance_m);
  each("planner_cpu_ms", f.planner_cpu_ms);
  each("real_time_factor", f.real_time_factor);
  each("mission_time_s", f.mission_time_s);
  each("losses", f.losses);
  each("poor_parts", f.poor_parts);
  each("status", f.status);
  each("digest", f.digest);
  each("memory_mb", f.memory_mb);
  each("processors", f.processors);
  each("braking_hits", f.braking_hits);
  each("braking_meets", f.braking_meets);
  each("ways_meet", f.ways_meet);
  each("least_clearance_m", f.least_clearance_m);
  each("least_separation_m", f.least_separation_m);
}

template <class Uav, class Each>
void each_figure_of_uav(Uav& u, const Each& each) {
  each("name", u.name);
  each("role", u.role);
  each("score", u.score);
  each("distance_m", u.distance_m);
  each("idle_s", u.idle_s);
  each("captures", u.captures);
}

struct Write {
  Json& json;
  template <class Value>
  void operator()(const char* key, const Value& value) const {
    json[key] = value;
  }
  template <class Value>
  void operator()(const char* key, const std::optional<Value>& value) const {
    if (value) json[key] = *value;
  }
};

struct Read {
  const Json& json;
  void operator()(const char* key, std::string& value) const {
    value = value_or(json, key, "").template get<std::string>();
  }
  void operator()(const char* key, std::map<std::string, double>& values) const {
    const auto found = json.find(key);
    if (found == json.end() || !found->is_object()) return;
    for (const auto& [name, value] : found->items()) {
      if (value.is_number()) values[name] = value.template get<double>();
    }
  }
  template <class Value>
  void operator()(const char* key, Value& value) const {
    if (const auto found = json.find(key); found != json.end() && found->is_number())
      value = found->template get<Value>();
  }
  template <class Value>
  void operator()(const char* key, std::optional<Value>& value) const {
    if (const auto found = json.find(key); found != json.end() && found->is_number())
      value = found->template get<Value>();
  }
};

}  // namespace

Json to_json(const FlightFigures& figures) {
  Json json = Json::object();
  each_figure(figures, Write{json});
  Json uavs = Json::array();
  for (const UavFigures& uav : figures.uavs) {
    Json one = Json::object();
    each_figure_of_uav(uav, Write{one});
    uavs.push_back(std::move(one));
  }
  json["uavs"] = std::move(uavs);
  return json;
}

FlightFigures figures_from(const Json& json) {
  FlightFigures figures;
  if (!json.is_object()) return figures;
  each_figure(figures, Read{json});
  for (const Json& one : value_or(json, "uavs", Json::array())) {
    UavFigures uav;
    if (one.is_object()) each_figure_of_uav(uav, Read{one});
    figures.uavs.push_back(std::move(uav));
  }
  return figures;
}

}  // namespace skein::cli
