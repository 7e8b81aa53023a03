// The cache of the oracle's answers: one file per answer, named by a hash of everything that the answer depends on.
// If a file cannot be read or written, this costs time and adds a warning, but the result is the same. Several programs
// may share a cache.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "oracle/oracle.hpp"

namespace skein::sim {

/// The numbers of an OracleReport, without the camera poses. The score of `reachable` is the sum of `estimate`.
struct OracleSummary {
  struct Part {
    Attainable attainable, coarse;
    bool operator==(const Part&) const = default;
  };
  double clearance_m = 0.0, outside_berth_m = 0.0;
  Berth berth = Berth::camera;
  std::size_t points_total = 0, directions = 0;  ///< directions: of the finer of the two searches
  Part reachable, outside;
  std::vector<float> estimate;        ///< by interest point: q of the best picture, 0 if it is not attainable
  std::vector<std::uint8_t> flyable;  ///< by interest point, as in OracleReport
  bool operator==(const OracleSummary&) const = default;
};
/// @param least  `rules.min_point_score`.
OracleSummary summary_of(const OracleReport& report, const OracleConfig& config, double least);

/// Keys: docs/oracle.md. Includes the change from the coarse to the fine score, in percent.
nlohmann::ordered_json to_json(const OracleSummary& summary);
/// @throws nlohmann::json::exception if a key is missing or has the wrong type.
OracleSummary summary_from_json(const nlohmann::ordered_json& json);

/// Hash (64 hexadecimal digits) of everything that an answer depends on: triangles, points, starts, cameras and the
/// bodies that carry them, the desired resolution, rules, and the version of the oracle. It does not depend on names,
/// boxes, times or radios. Pure.
std::string oracle_key(const Scenario& scenario, const Scene& scene, const OracleConfig& config);

struct OracleRequest {
  OracleConfig config;
  /// If an answer is not in the cache and is expected to take longer than this [s], there is none. nullopt: no limit.
  std::optional<double> patience_s;
  std::optional<std::filesystem::path> cache;  ///< folder; nullopt: no cache is used
};

struct OracleReply {
  std::optional<OracleSummary> summary;  ///< nullopt: it would take too long
  bool cached = false;                   ///< whether the answer is from the cache
  double expected_s = 0.0;               ///< as expected_seconds(); 0 if `cached`
  std::vector<std::string> warnings;
};

/// Looks for the answer in the cache. If there is none, or a damaged one, consults the oracle and caches its answer.
/// @throws as consult_oracle().
OracleReply ask_oracle(const Scenario& scenario, const Scene& scene, const OracleRequest& request);

}  // namespace skein::sim
