// Histogram of tracking errors, the distances between UAVs and their setpoints: counts by vehicle, speed and
// acceleration of the setpoint, and error. sim_server writes tracking.csv; `skein bench --tracking` adds up many runs.
// Units: SI.   Threads: one.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace skein::results {

class TrackingTable {
 public:
  static constexpr double kSpeedStepMps = 0.5, kAccelerationStepMps2 = 0.5, kErrorStepM = 0.01;
  static constexpr double kErrorsPerM = 100.0;
  static constexpr double kMostErrorM = 100.0;  ///< larger errors count as this one

  /// A bin of the histogram; each number is its lower edge, in steps of the constants above.
  struct Bin {
    int speed = 0, acceleration = 0, error = 0;
    std::string vehicle = {};  ///< last, because comparing numbers first is faster
    auto operator<=>(const Bin&) const = default;

    double speed_mps() const { return speed * kSpeedStepMps; }
    double acceleration_mps2() const { return acceleration * kAccelerationStepMps2; }
    double error_m() const { return error * kErrorStepM; }
    double most_error_m() const { return (error + 1) / kErrorsPerM; }
  };

  /// Quantiles are upper edges of bins, so that no quantile is smaller than the true one.
  struct Quantiles {
    std::uint64_t samples = 0;
    double p50 = 0.0, p99 = 0.0, p9999 = 0.0, max = 0.0;  ///< [m]; 0 without samples
  };

  /// Adds one sample. @param error_m  a value that is not finite counts as kMostErrorM
  void add(const std::string& vehicle, double speed_mps, double acceleration_mps2, double error_m);
  void add(const Bin& bin, std::uint64_t count) { bins_[bin] += count; }
  const std::map<Bin, std::uint64_t>& bins() const { return bins_; }

  /// Quantiles of the error over the bins for which `which` returns true.
  Quantiles quantiles(const std::function<bool(const Bin&)>& which = [](const Bin&) { return true; }) const;

  /// The contents of tracking.csv.
  std::string csv() const;

 private:
  std::map<Bin, std::uint64_t> bins_;
};

/// Adds the counts of a tracking.csv to `table`. @throws InputError if the file is missing; std::runtime_error if it is
/// damaged.
void read_tracking(const std::filesystem::path& file, TrackingTable& table);

}  // namespace skein::results
