// The oracle's answers, kept from run to run: a file each, named by a hash of all that the answer depends on.
// A cache that cannot be read or written costs time and a warning, never a result. Several programs may share one.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "oracle/oracle.hpp"

namespace skein::sim {

/// The numbers of an OracleReport, without the views. The score of `reachable` is the sum of `estimate`.
struct OracleSummary {
  struct Part {
    Attainable attainable, coarse;
    bool operator==(const Part&) const = default;
  };
  double clearance_m = 0.0, outside_berth_m = 0.0;
  Berth berth = Berth::camera;
  std::size_t points_total = 0, directions = 0;  ///< directions: of the finer of the two searches
  Part reachable, outside;
  std::vector<float> estimate;        ///< by interest point: q of the best picture, 0 where it is not attainable
  std::vector<std::uint8_t> flyable;  ///< by interest point, as in OracleReport
  bool operator==(const OracleSummary&) const = default;
};
/// @param least  `rules.min_point_score`.
OracleSummary summary_of(const OracleReport& report, const OracleConfig& config, double least);

/// Keys: docs/oracle.md. The change from the coarse to the fine score is there in percent.
nlohmann::ordered_json to_json(const OracleSummary& summary);
/// @throws nlohmann::json::exception where something is missing or of the wrong type.
OracleSummary summary_from_json(const nlohmann::ordered_json& json);

/// 64 hexadecimal digits that change with anything that an answer depends on: triangles, points, starts, cameras and
/// the bodies that carry them, the desired resolution, rules, and how the oracle works. Not with names, boxes, times or
/// radios. Pure.
std::string oracle_key(const Scenario& scenario, const Scene& scene, const OracleConfig& config);

struct OracleRequest {
  OracleConfig config;
  /// No answer rather than one that is not in the cache and is expected to take longer [s].
  std::optional<double> patience_s;
  std::optional<std::filesystem::path> cache;  ///< nullopt: none is used
};

struct OracleReply {
  std::optional<OracleSummary> summary;  ///< nullopt: it would take too long
  bool cached = false;
  double expected_s = 0.0;  ///< as expected_seconds()
  std::vector<std::string> warnings;
};

/// Looks into the cache, consults the oracle where nothing (or nothing whole) is there, and keeps the answer.
OracleReply ask_oracle(const Scenario& scenario, const Scene& scene, const OracleRequest& request);

}  // namespace skein::sim
