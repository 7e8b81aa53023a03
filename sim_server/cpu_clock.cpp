#include "sim_server/cpu_clock.hpp"

#include "process/host/thread_cpu.hpp"

namespace skein::sim {

void CpuClock::begin(Work work) { accounts_[static_cast<std::size_t>(work)].began_s = thread_cpu_s(); }

void CpuClock::end(Work work, std::size_t pieces) {
  Account& account = accounts_[static_cast<std::size_t>(work)];
  account.total_s += thread_cpu_s() - account.began_s;
  account.count += pieces;
}

TimingReport CpuClock::summary() const {
  const auto total = [&](Work work) { return accounts_[static_cast<std::size_t>(work)].total_s; };
  const double lidar = total(Work::lidar), camera = total(Work::camera), links = total(Work::links);
  const auto count = [&](Work work) { return accounts_[static_cast<std::size_t>(work)].count; };
  const std::uint64_t scans = count(Work::lidar);
  TimingReport timing{.physics_s = total(Work::simulation) - lidar - camera - links,
                      .lidar_s = lidar,
                      .camera_s = camera,
                      .links_s = links,
                      .recording_s = total(Work::recording),
                      .scans = scans,
                      .exposures = count(Work::camera),
                      .steps = count(Work::recording)};
  if (scans > 0) timing.lidar_ms_per_scan = 1e3 * lidar / static_cast<double>(scans);
  return timing;
}

}  // namespace skein::sim
