#include "results/tracking_table.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "core/types.hpp"
#include "results/csv_table.hpp"

namespace skein::results {
namespace {

/// Index of the bin that contains `value`. A value that rounding errors put just below an edge counts as on the edge.
int steps(double value, double step, double most) {
  return static_cast<int>(std::floor((value < most ? value : most) / step + 1e-9));
}

}  // namespace

void TrackingTable::add(const std::string& vehicle, double speed_mps, double acceleration_mps2, double error_m) {
  constexpr double kMost = 1000.0;
  ++bins_[{steps(speed_mps, kSpeedStepMps, kMost), steps(acceleration_mps2, kAccelerationStepMps2, kMost),
           steps(error_m, kErrorStepM, kMostErrorM), vehicle}];
}

TrackingTable::Quantiles TrackingTable::quantiles(const std::function<bool(const Bin&)>& which) const {
  std::map<int, std::uint64_t> by_error;
  Quantiles found;
  for (const auto& [bin, count] : bins_) {
    if (!which(bin)) continue;
    by_error[bin.error] += count;
    found.samples += count;
  }
  const auto at = [&](double share) {
    const auto enough = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(found.samples) - 1e-6));
    std::uint64_t sum = 0;
    for (const auto& [error, count] : by_error) {
      sum += count;
      if (sum >= enough) return (error + 1) / kErrorsPerM;  // 0.07, not 0.07000000000000001
    }
    return 0.0;
  };
  if (found.samples == 0) return found;
  found.p50 = at(0.5);
  found.p99 = at(0.99);
  found.p9999 = at(0.9999);
  found.max = at(1.0);
  return found;
}

std::string TrackingTable::csv() const {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "vehicle,speed_mps,acceleration_mps2,error_m,samples\n");
  for (const auto& [bin, count] : bins_) {
    fmt::format_to(std::back_inserter(text), "{},{:.1f},{:.1f},{:.2f},{}\n", bin.vehicle, bin.speed_mps(),
                   bin.acceleration_mps2(), bin.error_m(), count);
  }
  return fmt::to_string(text);
}

void read_tracking(const std::filesystem::path& file, TrackingTable& table) {
  if (!std::filesystem::exists(file)) throw InputError(file.string() + ": cannot be read");
  CsvTable rows(file);
  const auto step = [&rows](const char* column, double size) {
    const double steps = rows.number(column) / size;
    if (steps < 0.0 || steps > 1e9) {  // a bin's numbers are of type int
      rows.fail(std::string("column '") + column + "': '" + rows.text(column) + "' is out of range");
    }
    return static_cast<int>(std::lround(steps));
  };
  while (rows.next()) {
    table.add({.speed = step("speed_mps", TrackingTable::kSpeedStepMps),
               .acceleration = step("acceleration_mps2", TrackingTable::kAccelerationStepMps2),
               .error = step("error_m", TrackingTable::kErrorStepM),
               .vehicle = rows.text("vehicle")},
              rows.count("samples"));
  }
}

}  // namespace skein::results
