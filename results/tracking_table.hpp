// How far UAVs were from where their set-points wanted them: counts by vehicle, speed and acceleration of the
// set-point. sim_server fills such a table, tracking.csv holds it, `skein bench --tracking` joins those of many runs.
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
  static constexpr double kMostErrorM = 100.0;  ///< larger errors count as this

  /// Which samples are counted together: each number is the lower edge of a bin, in steps.
  struct Bin {
    int speed = 0, acceleration = 0, error = 0;
    std::string vehicle = {};  ///< last: numbers are compared more quickly
    auto operator<=>(const Bin&) const = default;

    double speed_mps() const { return speed * kSpeedStepMps; }
    double acceleration_mps2() const { return acceleration * kAccelerationStepMps2; }
    double error_m() const { return error * kErrorStepM; }
    double most_error_m() const { return (error + 1) / kErrorsPerM; }
  };

  /// Quantiles are upper edges of bins, so that no share is told too small an error.
  struct Quantiles {
    std::uint64_t samples = 0;
    double p50 = 0.0, p99 = 0.0, p9999 = 0.0, max = 0.0;  ///< [m]; 0 of no samples
  };

  /// @param error_m  of one sample; what is not finite counts as kMostErrorM.
  void add(const std::string& vehicle, double speed_mps, double acceleration_mps2, double error_m);
  void add(const Bin& bin, std::uint64_t count) { bins_[bin] += count; }
  const std::map<Bin, std::uint64_t>& bins() const { return bins_; }

  /// Of the samples in bins that `which` wants.
  Quantiles quantiles(const std::function<bool(const Bin&)>& which = [](const Bin&) { return true; }) const;

  /// As tracking.csv holds it.
  std::string csv() const;

 private:
  std::map<Bin, std::uint64_t> bins_;
};

/// Joins a run's tracking.csv to a table. @throws InputError when it is not there; std::runtime_error when it is
/// damaged.
void read_tracking(const std::filesystem::path& file, TrackingTable& table);

}  // namespace skein::results
