// losses.csv and `losses` of result.json: the oracle's estimate beside what a run left behind.
#pragma once

#include <filesystem>

#include "cli/run/result.hpp"

namespace skein::cli {

/// Writes losses.csv into a run's folder: a line for each point that is attainable, and for each that scored although
/// it is not: index, x, y, z, estimate, score, cause, loss, then of the picture that the cause is about uav, capture,
/// q_distance, q_tilt, q_blur, q (docs/results.md).
/// @param answer  the oracle's, with `estimate` and `flyable` for each point.
/// @returns `losses` of result.json: by cause `points` and `score`. Null, and no file, where the answer or a report
///          that is needed is missing, or does not fit the scene.
/// @throws std::runtime_error when captures.csv makes no sense or the file cannot be written.
Json write_losses(const std::filesystem::path& dir, const Json& answer, const Reports& reports);

}  // namespace skein::cli
