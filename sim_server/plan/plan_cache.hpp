// A cache of plans, like that of the oracle's answers (oracle/cache.hpp): one file per plan, named by a hash of all
// inputs of the plan.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim_server/plan/plan.hpp"

namespace skein::sim {

/// Keys: docs/oracle.md. plan_from_json() restores doubles to the last bit.
nlohmann::ordered_json to_json(const Plan& plan);
/// @throws nlohmann::json::exception if a key is missing or its value has the wrong type.
Plan plan_from_json(const nlohmann::ordered_json& json);

/// 64 hexadecimal digits that change with anything that a plan or its flight depends on. Pure.
std::string plan_key(const Scenario& scenario, const Scene& scene, const PlanConfig& config);

struct PlanRequest {
  PlanConfig config;
  bool search = true;                          ///< false: only look into the cache
  std::optional<std::filesystem::path> cache;  ///< folder; nullopt: no cache is used
};

struct PlanReply {
  std::optional<Plan> plan;  ///< with its flight
  std::vector<std::string> warnings;
};

/// Returns the plan from the cache. If the cache has no valid one, and if `search` is set, makes a plan, flies it, and
/// stores it in the cache. Errors of the cache become warnings.
PlanReply ask_plan(const Scenario& scenario, const Scene& scene, const PlanRequest& request);

}  // namespace skein::sim
