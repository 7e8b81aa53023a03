// Plans, kept like the oracle's answers (oracle/cache.hpp): a file each, named by a hash of all that the plan depends
// on.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim_server/plan/plan.hpp"

namespace skein::sim {

/// Keys: docs/oracle.md. Doubles come back to the last bit.
nlohmann::ordered_json to_json(const Plan& plan);
/// @throws nlohmann::json::exception where something is missing or of the wrong type.
Plan plan_from_json(const nlohmann::ordered_json& json);

/// 64 hexadecimal digits that change with anything that a plan or its flight depends on. Pure.
std::string plan_key(const Scenario& scenario, const Scene& scene, const PlanConfig& config);

struct PlanRequest {
  PlanConfig config;
  bool search = true;                          ///< false: only what is in the cache
  std::optional<std::filesystem::path> cache;  ///< nullopt: none is used
};

struct PlanReply {
  std::optional<Plan> plan;  ///< with its flight
  std::vector<std::string> warnings;
};

/// Looks into the cache; where there is nothing whole, and it is asked to, it searches, flies, and keeps the plan.
PlanReply ask_plan(const Scenario& scenario, const Scene& scene, const PlanRequest& request);

}  // namespace skein::sim
