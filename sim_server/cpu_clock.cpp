#include "sim_server/cpu_clock.hpp"

#include <ctime>

namespace skein::sim {

double thread_cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void CpuClock::begin(Work work) { accounts_[static_cast<std::size_t>(work)].began_s = thread_cpu_s(); }

void CpuClock::end(Work work) {
  Account& account = accounts_[static_cast<std::size_t>(work)];
  account.total_s += thread_cpu_s() - account.began_s;
  ++account.count;
}

nlohmann::json CpuClock::summary() const {
  const auto total = [&](Work work) { return accounts_[static_cast<std::size_t>(work)].total_s; };
  const double lidar = total(Work::lidar), camera = total(Work::camera), links = total(Work::links);
  const Account& scans = accounts_[static_cast<std::size_t>(Work::lidar)];
  nlohmann::json json = {{"physics_s", total(Work::simulation) - lidar - camera - links},
                         {"lidar_s", lidar},
                         {"camera_s", camera},
                         {"links_s", links}};
  if (scans.count > 0) json["lidar_ms_per_scan"] = 1e3 * lidar / static_cast<double>(scans.count);
  return json;
}

}  // namespace skein::sim
