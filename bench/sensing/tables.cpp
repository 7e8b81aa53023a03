#include "bench/sensing/tables.hpp"

#include <spdlog/fmt/fmt.h>

#include <nlohmann/json.hpp>

#include "core/types.hpp"

namespace skein::bench {
namespace {

constexpr const char* kEnd = "[//]: # (end of table)";

std::string ruled(std::size_t columns) {
  std::string line = "|";
  for (std::size_t i = 0; i < columns; ++i) line += "---|";
  return line + "\n";
}

double percent(double share) { return 100.0 * share; }
double percent(int part, int all) { return all == 0 ? 0.0 : 100.0 * part / all; }

}  // namespace

Table space_table(std::span<const SiteStudy> studies) {
  std::string text = "| after | from the route |";
  for (const SiteStudy& study : studies) {
    text += fmt::format(" {0}: free [m³] | key frames [%] | world map [%] |", study.name);
  }
  text += "\n" + ruled(2 + 3 * studies.size());
  const std::vector<Snapshot>& times = studies.front().snapshots;
  for (std::size_t i = 0; i < times.size(); ++i) {
    for (std::size_t band = 0; band < times[i].bands.size(); ++band) {
      const Band& place = times[i].bands[band];
      text += fmt::format("| {:.0f} s | {:.0f} to {:.0f} m |", times[i].time_s, place.from_m, place.to_m);
      for (const SiteStudy& study : studies) {
        const Band& here = study.snapshots[i].bands[band];
        text += fmt::format(" {:.0f} | {:.1f} | {:.1f} |", here.free_m3, percent(here.today), percent(here.world));
      }
      text += "\n";
    }
  }
  return {"space", text};
}

Table surface_table(std::span<const SiteStudy> studies) {
  std::string text =
      "| | after | places on it | key frames: occupied [%] | free [%] | world map: occupied [%] | free [%] |\n" +
      ruled(7);
  for (const SiteStudy& study : studies) {
    for (const Snapshot& snapshot : study.snapshots) {
      const Surface& surface = snapshot.surface;
      const auto share = [&](int part) { return percent(part, surface.places); };
      text += fmt::format("| {} | {:.0f} s | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", study.name, snapshot.time_s,
                          surface.places, share(surface.today_occupied), share(surface.today_free),
                          share(surface.world_occupied), share(surface.world_free));
    }
  }
  return {"surface", text};
}

Table reach_table(std::span<const Reach> reaches, std::span<const Stop> stops) {
  std::string text =
      "| member | hovering for 8 s: proved way, median and minimum [m] | speed [m/s] | hovering for 24 s [m] "
      "| speed [m/s] | flying at 2 m/s, ahead [m] | speed [m/s] |\n" +
      ruled(7);
  for (const Reach& reach : reaches) {
    const auto cells = [&](double median_m, double least_m) {
      return fmt::format(" {:.1f}, {:.1f} | {:.1f} |", median_m, least_m, speed_within(stops, median_m));
    };
    text += fmt::format("| {:.0f} cm |", 100.0 * reach.member_width_m) +
            cells(reach.one_sweep_m, reach.one_sweep_least_m) +
            cells(reach.three_sweeps_m, reach.three_sweeps_least_m) + cells(reach.ahead_m, reach.ahead_least_m) + "\n";
  }
  text += "\n| speed [m/s] |";
  for (const Stop& stop : stops) text += fmt::format(" {:.1f} |", stop.speed_mps);
  text += "\n" + ruled(1 + stops.size()) + "| way to rest [m] |";
  for (const Stop& stop : stops) text += fmt::format(" {:.1f} |", stop.way_m);
  return {"reach", text + "\n"};
}

Table cost_table(std::span<const SiteStudy> studies) {
  std::string text = "| | after | CPU of the map [ms per simulated second] | memory [MB] |\n" + ruled(4);
  for (const SiteStudy& study : studies) {
    for (const Snapshot& snapshot : study.snapshots) {
      text +=
          fmt::format("| {} | {:.0f} s | {:.1f} | {:.1f} |\n", study.name, snapshot.time_s,
                      1e3 * snapshot.insert_cpu_s / snapshot.time_s, 1e-6 * static_cast<double>(snapshot.world_bytes));
    }
  }
  return {"cost", text};
}

Table message_table(std::span<const SiteStudy> studies) {
  std::string text =
      "| | scans | points per scan | `cloud_inW` [bytes per scan]: mean, maximum | `lidar_servo` [bytes per scan] |\n" +
      ruled(5);
  for (const SiteStudy& study : studies) {
    const Messages& messages = study.messages;
    const std::size_t scans = std::max<std::size_t>(1, messages.scans);
    text += fmt::format("| {} | {} | {} | {}, {} | {} |\n", study.name, messages.scans, messages.points / scans,
                        messages.cloud_bytes / scans, messages.most_cloud_bytes, messages.servo_bytes);
  }
  return {"messages", text};
}

Table vendor_table(const nlohmann::json& vendors) {
  std::string text =
      "| vendor | step without beams [ms] | step with beams [ms] | CPU without [ms per step] "
      "| CPU with [ms per step] |\n" +
      ruled(5);
  for (const nlohmann::json& one : vendors) {
    const auto figure = [&](const char* run, const char* what) { return one.at(run).at(what).get<double>(); };
    text += fmt::format("| {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", one.at("vendor").get<std::string>(),
                        figure("plain", "round_ms"), figure("beams", "round_ms"), figure("plain", "cpu_ms"),
                        figure("beams", "cpu_ms"));
  }
  return {"vendors", text};
}

std::string with_table(const std::string& page, const Table& table) {
  const std::string begin = "[//]: # (table: " + table.name + ")\n";
  const std::size_t at = page.find(begin), from = at + begin.size();
  const std::size_t to = at == std::string::npos ? at : page.find(kEnd, from);
  if (to == std::string::npos) throw InputError("the page has no place for the table '" + table.name + "'");
  return page.substr(0, from) + "\n" + table.markdown + "\n" + page.substr(to);
}

}  // namespace skein::bench
