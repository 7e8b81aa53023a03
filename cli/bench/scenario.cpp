#include "cli/bench/scenario.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>

namespace skein::cli {
namespace {

constexpr double kSpacingM = 5.0;
constexpr double kNearestX = -10.0, kMiddleY = 5.0;  ///< towers stand at x > 0, the station at (-2, 8)

}  // namespace

std::string bench_scenario(const BenchFleet& fleet) {
  std::string yaml = fmt::format(
      "name: bench{}\n"
      "description: a square of UAVs beside the towers, made by skein bench\n"
      "duration_s: {}\n"
      "exchange_period_s: {}\n"
      "desired_mm_per_pixel: 2.0\n"
      "station: {{position: [-2, 8, 0.3], antenna_offset_m: 0.1}}\n"
      "scene: {{family: towers, scene_seed: 0}}\n"
      "fleet:\n",
      fleet.uavs, fleet.duration_s, fleet.exchange_period_s);
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(fleet.uavs))));
  for (std::size_t i = 0; i < fleet.uavs; ++i) {
    const std::size_t row = i / side, column = i % side;
    const double x = kNearestX - kSpacingM * static_cast<double>(column);
    const double y = kMiddleY + kSpacingM * (static_cast<double>(row) - 0.5 * static_cast<double>(side - 1));
    yaml += fmt::format("  - {{name: uav{:03}, vehicle: {}, start: [{}, {}]}}\n", i,
                        i % 5 < 2 ? "explorer" : "photographer", x, y);
  }
  return yaml;
}

}  // namespace skein::cli
