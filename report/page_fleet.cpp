// The sections about UAVs, radio and machine.
#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "core/planners/python_spec.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/text/text.hpp"
#include "report/html.hpp"
#include "report/page_parts.hpp"
#include "report/time_chart.hpp"
#include "results/uav_state.hpp"

namespace skein::report {
namespace {

constexpr std::size_t kMostNodesInWords = 12;  ///< with more nodes, cells of the link matrix have a colour, but no text

std::string share_text(const Spans& spans, double end_s) {
  return end_s > 0.0 ? fixed(100.0 * length_of(spans) / end_s, 1) : "–";
}

std::string state_of(const Json& uav, const Json& faults) {
  const std::string state = results::uav_state(uav, faults);
  const bool is_of_program = state == "lost" || state == "killed" || state == "paused";
  return state == "-" ? "–" : is_of_program ? "program " + state : state;
}

std::string uav_table(const RunPage& page) {
  const Json& result = page.run.result;
  const Json planners = value_or(result, "planner", Json::object()),
             scores = value_or(result, "score_by_uav", Json::object());
  const Json uavs = value_or(result, "uavs", Json::array()), faults = value_or(result, "faults", Json::array());
  std::string html = "<div class=\"wide\"><table data-table=\"uavs\">\n" +
                     table_head({"UAV", "Role", "Planner", "State", "Score", "Pictures", "Distance [m]",
                                 "Top speed [m/s]", "Idle [s]", "Direct link [%]", "Relayed [%]"}) +
                     "<tbody>\n";
  for (std::size_t i = 0; i < page.run.uavs.size(); ++i) {
    const Json& uav = uavs[i];
    const std::string &name = page.run.uavs[i], planner = without_folders(text_in(planners, name.c_str()));
    html += table_row({fmt::format("<span class=\"swatch\" style=\"background:var(--t{})\"></span>{}",
                                   i % kTrackColours, escaped(name)),
                       escaped(text_in(uav, "role")), escaped(shortened(planner, 32)), state_of(uav, faults),
                       cell_of(scores, name.c_str(), 1), cell_of(uav, "captures", 0), cell_of(uav, "distance_m", 1),
                       cell_of(uav, "max_speed_mps", 2), cell_of(uav, "idle_s", 1),
                       share_text(page.lanes[i].direct, page.run.end_s),
                       share_text(page.lanes[i].relayed, page.run.end_s)});
  }
  return html + "</tbody></table></div>\n";
}

/// What the UAVs used their time for; empty if none reported it.
std::string budget_table(const RunPage& page) {
  if (std::ranges::none_of(page.budgets, &std::optional<TimeBudget>::has_value)) return "";
  std::string html =
      "<h3>Where the time went</h3><p class=\"soft\">Seconds, as each UAV&#39;s program reported what it did, while it "
      "took part in the run.</p>\n<div class=\"wide\"><table data-table=\"time\">\n" +
      table_head({"UAV", "Ground, takeoff", "Waits for another UAV", "Flies to goals", "Rests, has no goal",
                  "Shows another UAV its way up", "Looks for a way, recovers", "Stands", "Brings captures home",
                  "Other"}) +
      "<tbody>\n";
  for (std::size_t i = 0; i < page.run.uavs.size(); ++i) {
    std::vector<std::string> cells = {escaped(page.run.uavs[i])};
    for (std::size_t use = 0; use < kTimeUses; ++use) {
      cells.push_back(page.budgets[i] ? fixed((*page.budgets[i])[use], 1) : "–");
    }
    html += table_row(cells);
  }
  return html + "</tbody></table></div>\n";
}

std::vector<std::string> nodes_of(const RunPage& page) {
  std::vector<std::string> nodes = {"gcs"};
  nodes.insert(nodes.end(), page.run.uavs.begin(), page.run.uavs.end());
  return nodes;
}

/// A table with a row for each sender and a column for each receiver.
std::string link_matrix(const RunPage& page) {
  const std::vector<std::string> nodes = nodes_of(page);
  const bool words = nodes.size() <= kMostNodesInWords;
  std::map<std::pair<std::string, std::string>, Json> counts;
  for (const Json& link : value_or(value_or(page.run.result, "radio", Json::object()), "per_link", Json::array())) {
    counts[{text_in(link, "from"), text_in(link, "to")}] = link;
  }
  std::vector<std::string> heads = {"from \\ to"};
  for (const std::string& node : nodes) heads.push_back(words ? escaped(node) : "");
  std::string html = "<div class=\"wide\"><table class=\"" + std::string(words ? "matrix" : "matrix dense") +
                     "\" data-table=\"links\">\n" + table_head(heads) + "<tbody>\n";
  for (const std::string& from : nodes) {
    html += "<tr><td>" + escaped(from) + "</td>";
    for (const std::string& to : nodes) {
      const auto share = page.links.find({from, to});
      const auto count = counts.find({from, to});
      if (from == to || (share == page.links.end() && count == counts.end())) {
        html += "<td></td>";
        continue;
      }
      const double of = share == page.links.end() ? 0.0 : share->second;
      html += fmt::format("<td class=\"heat\" style=\"--v:{}%;--h:var(--c0)\">", fixed(60.0 * of, 0));
      if (words) {
        html += fixed(100.0 * of, 0) + " %";
        if (count != counts.end()) {
          html += fmt::format("<small>{} of {}</small><small>{} kB</small>", cell_of(count->second, "delivered", 0),
                              cell_of(count->second, "sent", 0),
                              fixed(1e-3 * number_in(count->second, "delivered_bytes"), 1));
        }
      }
      html += "</td>";
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

/// For a fleet that is too large for link_matrix(): a row for each sender.
std::string link_sums(const RunPage& page) {
  struct Sums {
    std::size_t nodes = 0;
    double delivered = 0.0, bytes = 0.0;
  };
  std::map<std::string, Sums> sums;
  for (const Json& link : value_or(value_or(page.run.result, "radio", Json::object()), "per_link", Json::array())) {
    const double delivered = number_in(link, "delivered");
    if (delivered == 0.0) continue;
    Sums& of = sums[text_in(link, "from")];
    ++of.nodes;
    of.delivered += delivered;
    of.bytes += number_in(link, "delivered_bytes");
  }
  std::string html = "<div class=\"wide\"><table data-table=\"links\">\n" +
                     table_head({"Sender", "Receivers", "Messages delivered", "Delivered [kB]"}) + "<tbody>\n";
  for (const std::string& node : nodes_of(page)) {
    const Sums& of = sums[node];
    html += table_row({escaped(node), std::to_string(of.nodes), fixed(of.delivered, 0), fixed(1e-3 * of.bytes, 1)});
  }
  return html + "</tbody></table></div>\n";
}

std::string key_figures(const std::vector<std::pair<std::string, std::string>>& figures, const std::string& table) {
  std::string html = "<div class=\"wide\"><table class=\"pairs\" data-table=\"" + table + "\"><tbody>\n";
  for (const auto& [name, value] : figures) html += table_row({name, value});
  return html + "</tbody></table></div>\n";
}

/// How the CPU time of sim_server's main thread was spent; empty if it was not measured.
std::string simulation_table(const Json& timing) {
  const double cpu_s = number_in(timing, "cpu_s");
  if (!(cpu_s > 0.0)) return "";
  std::string html = "<details><summary>Simulation</summary><div class=\"wide\"><table data-table=\"simulation\">" +
                     table_head({"Work", "CPU [s]", "Share"}) + "<tbody>\n";
  double rest_s = cpu_s;
  const auto row = [&](const char* name, double spent_s) {
    html += table_row({name, fixed(spent_s, 2), fixed(100.0 * spent_s / cpu_s, 1) + " %"});
    rest_s -= spent_s;
  };
  for (const auto& [key, name] : {std::pair("physics_s", "physics"),
                                  {"lidar_s", "LiDAR"},
                                  {"camera_s", "cameras"},
                                  {"links_s", "line of sight"},
                                  {"recording_s", "digest and files"}}) {
    row(name, number_in(timing, key));
  }
  row("exchange and the rest", rest_s);
  return html + "</tbody></table></div></details>\n";
}

}  // namespace

std::string fleet_section(const RunPage& page) {
  std::string html = "<section id=\"fleet\"><h2>The UAVs over time</h2>\n";
  if (page.run.uavs.empty()) return html + absent("result.json names no UAV.") + "</section>\n";
  html +=
      "<ul class=\"legend\">"
      "<li><span class=\"swatch\" style=\"background:var(--flying)\"></span>takes part</li>"
      "<li><span class=\"swatch\" style=\"background:var(--still)\"></span>below 0.1 m/s, no better capture for 5 "
      "s</li>"
      "<li><span class=\"swatch\" style=\"background:var(--direct)\"></span>linked to the station</li>"
      "<li><span class=\"swatch\" style=\"background:var(--relayed)\"></span>by way of others only</li>"
      "<li><span class=\"swatch\" style=\"background:var(--soft)\"></span>captures that improved a point</li>"
      "<li><span class=\"swatch\" style=\"background:var(--c1)\"></span>captures not acknowledged yet</li>";
  if (!page.run.collisions.empty()) html += "<li><b class=\"cross\">×</b> collision</li>";
  if (!page.run.faults.empty())
    html += "<li><span class=\"swatch\" style=\"background:var(--fault)\"></span>faults</li>";
  html += "</ul>\n<figure data-live=\"lanes\">" + lanes_svg("What each UAV did when", page.run, page.lanes) +
          "</figure>\n" + uav_table(page) + budget_table(page);
  if (!page.run.collisions.empty()) {
    html += "<h3>Collisions</h3><div class=\"wide\"><table data-table=\"collisions\">" +
            table_head({"UAV", "With", "At [s]"}) + "<tbody>\n";
    for (const results::RunCollision& collision : page.run.collisions) {
      html += table_row({escaped(collision.uav), escaped(collision.with), fixed(collision.time_s, 2)});
    }
    html += "</tbody></table></div>\n";
  }
  return html + "</section>\n";
}

std::string radio_section(const RunPage& page) {
  const Json radio = value_or(page.run.result, "radio", Json::object());
  std::string html = "<section id=\"radio\"><h2>Radio</h2>\n<div class=\"halves\"><div>\n<h3>Links</h3>";
  if (page.run.uavs.size() > kMostUavsOverDds) {
    html += "<p class=\"soft\">UAVs and the station that received messages of each sender.</p>\n" + link_sums(page);
  } else {
    html +=
        "<p class=\"soft\">Share of the time with a link; messages delivered of those sent; delivered bytes.</p>\n" +
        link_matrix(page);
  }
  html += key_figures(
      {{"messages sent", cell_of(radio, "sent", 0)},
       {"delivered", cell_of(radio, "delivered", 0)},
       {"dropped: no line of sight", cell_of(radio, "dropped_no_los", 0)},
       {"dropped: faults", cell_of(radio, "dropped_fault", 0)},
       {"dropped: no room", cell_of(radio, "dropped_overflow", 0)},
       {"delivered [kB]",
        number_if_any(radio, "delivered_bytes") ? fixed(1e-3 * number_in(radio, "delivered_bytes"), 1) : "–"}},
      "radio");
  const Latency& latency = page.latency;
  const std::size_t all = latency.delays_s.size() + latency.never;
  html += "</div><div>\n<h3>Delivery of captures</h3>\n";
  if (all == 0) return html + absent("No capture is known that improved a point.") + "</div></div></section>\n";
  html += figure("From picture to delivery", fmt::format("{} captures that improved a point", all),
                 latency_svg("How long captures took to the station", latency));
  html += key_figures({{"median [s]", latency.delays_s.empty() ? "–" : fixed(latency.quantile(0.5), 2)},
                       {"nine of ten within [s]", latency.delays_s.empty() ? "–" : fixed(latency.quantile(0.9), 2)},
                       {"longest [s]", latency.delays_s.empty() ? "–" : fixed(latency.delays_s.back(), 2)},
                       {"never delivered", std::to_string(latency.never)}},
                      "latency");
  return html + "</div></div></section>\n";
}

std::string machine_section(const RunPage& page) {
  const Json& result = page.run.result;
  std::string html =
      "<section id=\"machine\"><h2>Planners and machine</h2>\n<div class=\"halves\"><div>\n<h3>Planner time</h3>\n"
      "<p class=\"soft\">Processor time of the planner's thread on this machine, an exchange of the lock-step; "
      "the score does not depend on it.</p>\n<div class=\"wide\"><table data-table=\"planners\">\n" +
      table_head({"UAV", "CPU [s]", "99 of 100 within [ms]", "Longest [ms]", "Over 50 ms"}) + "<tbody>\n";
  const Json uavs = value_or(result, "uavs", Json::array());
  for (std::size_t i = 0; i < page.run.uavs.size(); ++i) {
    html += table_row({escaped(page.run.uavs[i]), cell_of(uavs[i], "planner_cpu_s", 2),
                       cell_of(uavs[i], "planner_cpu_p99_ms", 2), cell_of(uavs[i], "planner_cpu_max_ms", 2),
                       cell_of(uavs[i], "planner_exchanges_over_50ms", 0)});
  }
  html += "</tbody></table></div></div><div>\n<h3>Machine</h3>\n";
  html += key_figures({{"simulated [s]", cell_of(result, "sim_time_s", 1)},
                       {"wall time [s]", cell_of(result, "wall_time_s", 1)},
                       {"times real time", cell_of(result, "real_time_factor", 1)},
                       {"processors in use", fixed(processors_of(result), 2)},
                       {"start-up [s]", cell_of(result, "startup_s", 2)},
                       {"memory [MB]", cell_of(result, "memory_mb", 0)}},
                      "machine");
  html += simulation_table(value_or(result, "timing", Json::object()));
  const Json processes = value_or(result, "processes", Json::object());
  if (!processes.empty()) {
    html += "<details><summary>Programs</summary><div class=\"wide\"><table data-table=\"processes\">" +
            table_head({"Program", "DDS", "CPU [s]", "Peak memory [MB]"}) + "<tbody>\n";
    const Json dds = value_or(result, "dds", Json::object());
    for (const auto& [name, use] : processes.items()) {
      html += table_row({escaped(name), escaped(text_in(dds, name.c_str())), cell_of(use, "cpu_s", 2),
                         cell_of(use, "peak_memory_mb", 0)});
    }
    html += "</tbody></table></div></details>\n";
  }
  return html + "</div></div></section>\n";
}

}  // namespace skein::report
