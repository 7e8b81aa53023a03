// losses.csv and `losses` of result.json: compare the oracle's estimate with the results of a run.
// Threads: any, but one for each folder.
#pragma once

#include <array>
#include <filesystem>

#include "results/result.hpp"
#include "results/score_losses.hpp"

namespace skein::results {

/// Writes losses.csv into a run's folder. It has a line for each point that is attainable, and for each other point
/// that scored: index, x, y, z (frame W, metres), estimate, score, cause, loss, then uav, capture, q_distance, q_tilt,
/// q_blur and q of the picture to which the cause refers, and the part by which `below_threshold` is split
/// (docs/results.md).
/// @param answer  the oracle's answer, with `estimate` and `flyable` for each point.
/// @returns `losses` of result.json: `points` and `score` for each cause, and for `below_threshold` also `by_part`.
///          Null, without writing a file, if the answer or a required report is missing, or does not fit the scene.
/// @throws std::runtime_error when captures.csv is not valid or losses.csv cannot be written.
Json write_losses(const std::filesystem::path& dir, const Json& answer, const Reports& reports);

/// @returns how `losses` of a result splits the cause `below_threshold`, in the order of kPoorParts. If the result does
///          not split it, everything is in the last part.
std::array<LossSum, kPoorParts.size()> poor_parts(const Json& losses);

}  // namespace skein::results
