#include "cli/bench/tracking.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "cli/bench/planners.hpp"
#include "cli/study_command.hpp"
#include "process/program.hpp"
#include "results/csv_table.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

constexpr double kShare = 0.9999;  ///< of the samples, for which the bound must hold
/// The planners of the table in docs/flight-safety.md.
constexpr const char* kTrackedPlanners = "patrol,kios,xxh,star";
constexpr double kQuickMissionS = 120.0;
constexpr int kSpeeds = 8, kAccelerations = 5;  ///< rows and columns of the table, 1 m/s and 1 m/s^2 wide

/// The samples of one bin: at least this speed and acceleration of the setpoint, at most this error.
struct Sample {
  double speed_mps, acceleration_mps2, error_m;
  double count;
};

std::vector<Sample> samples_of(const results::TrackingTable& table, const std::string& vehicle) {
  std::vector<Sample> samples;
  for (const auto& [bin, count] : table.bins()) {
    if (bin.vehicle != vehicle) continue;
    samples.push_back({bin.speed_mps(), bin.acceleration_mps2(), bin.most_error_m(), static_cast<double>(count)});
  }
  return samples;
}

/// The smallest bound with these slopes that holds for a share of the samples.
TrackingBound bound_of(const std::vector<Sample>& samples, double c1_s, double c2_s2, double share) {
  std::vector<std::pair<double, double>> above;  // error beyond the slopes, number of samples
  double all = 0.0;
  TrackingBound bound{.c1_s = c1_s, .c2_s2 = c2_s2};
  for (const Sample& sample : samples) {
    const double by_slopes = c1_s * sample.speed_mps + c2_s2 * sample.acceleration_mps2;
    above.emplace_back(sample.error_m - by_slopes, sample.count);
    bound.mean_m += by_slopes * sample.count;
    all += sample.count;
  }
  std::ranges::sort(above);
  double covered = 0.0;
  for (const auto& [rest, count] : above) {
    if (covered >= share * all && rest > bound.c0_m) break;
    bound.c0_m = std::max(0.0, rest);
    covered += count;
  }
  bound.covered = covered / all;
  bound.beyond_m = std::max(0.0, above.back().first - bound.c0_m);
  bound.mean_m = bound.mean_m / all + bound.c0_m;
  return bound;
}

std::set<std::string> vehicles_in(const results::TrackingTable& table) {
  std::set<std::string> vehicles;
  for (const auto& [bin, count] : table.bins()) vehicles.insert(bin.vehicle);
  return vehicles;
}

void print_rows(std::ostream& out, const results::TrackingTable& table, const std::string& vehicle) {
  const auto in_row = [](double value, double from, int last, int k) {
    return value >= from && (k == last || value < from + 1.0);
  };
  for (int row = 0; row < kSpeeds; ++row) {
    for (int column = 0; column < kAccelerations; ++column) {
      const auto quantiles = table.quantiles([&](const results::TrackingTable::Bin& bin) {
        return bin.vehicle == vehicle && in_row(bin.speed_mps(), row, kSpeeds - 1, row) &&
               in_row(bin.acceleration_mps2(), column, kAccelerations - 1, column);
      });
      if (quantiles.samples == 0) continue;
      out << fmt::format("{:<14}{:>7}{:>8}{:>10}{:>8.2f}{:>8.2f}{:>8.2f}{:>8.2f}\n", vehicle, row, column,
                         quantiles.samples, quantiles.p50, quantiles.p99, quantiles.p9999, quantiles.max);
    }
  }
}

StudyOptions flights(const BenchOptions& options) {
  StudyOptions study;
  study.planner_lists = {kTrackedPlanners};
  study.seeds = options.quick ? "1" : "1-2";  // with start offsets, and some UAVs that take commands an exchange late
  study.scenarios = bench_scenarios(options);
  study.assets = options.assets;
  study.duration_s = options.duration_s;
  if (options.quick && !study.duration_s) study.duration_s = kQuickMissionS;
  study.out = "runs/bench-tracking";
  study.force = true;  // the programs may have changed; flights that still fit are kept
  return study;
}

}  // namespace

TrackingBound fit_bound(const results::TrackingTable& table, const std::string& vehicle, double share) {
  constexpr int kSteps = 40;
  constexpr double kStep = 0.01;
  const std::vector<Sample> samples = samples_of(table, vehicle);
  if (samples.empty()) return {};
  TrackingBound best = bound_of(samples, 0.0, 0.0, share);
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const TrackingBound bound = bound_of(samples, i * kStep, j * kStep, share);
      if (bound.mean_m < best.mean_m) best = bound;
    }
  }
  return best;
}

void print_tracking(std::ostream& out, const results::TrackingTable& table) {
  out << fmt::format("{:<14}{:>7}{:>8}{:>10}{:>8}{:>8}{:>8}{:>8}\n", "vehicle", "m/s", "m/s^2", "samples", "50 %",
                     "99 %", "99.99 %", "most");
  for (const std::string& vehicle : vehicles_in(table)) print_rows(out, table, vehicle);
  out << "speed and acceleration of the setpoint, from these values on; quantiles of its distance from the UAV [m]\n\n";
  for (const std::string& vehicle : vehicles_in(table)) {
    for (const double share : {kShare, 1.0}) {
      const TrackingBound bound = fit_bound(table, vehicle, share);
      out << fmt::format(
          "{}: e(v, a) = {:.2f} m + {:.2f} s |v| + {:.2f} s^2 |a| for {:.4f} %; {:.2f} m on average, "
          "{:.2f} m beyond at most\n",
          vehicle, bound.c0_m, bound.c1_s, bound.c2_s2, 100.0 * bound.covered, bound.mean_m, bound.beyond_m);
    }
  }
}

int bench_tracking(const BenchOptions& options, const Console& console) {
  const StudyPlan plan = plan_study(flights(options));
  const std::optional<Study> study = flown_study(plan, console);
  if (!study) return kExitInterrupted;
  results::TrackingTable table;
  for (const FlightEntry& flight : study->flights) {
    if (flight.figures) results::read_tracking(flight.dir / run_folder::kTracking, table);
  }
  console.out << '\n';
  print_tracking(console.out, table);
  return study->any_problem() ? kExitProcessFailed : kExitDone;
}

}  // namespace skein::cli
