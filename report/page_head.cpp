// The top of the page, and functions that all sections share.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>

#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "report/html.hpp"
#include "report/page_parts.hpp"
#include "results/score_steps.hpp"

namespace skein::report {
namespace {

/// A seed as it is: a double does not hold all whole numbers above 2^53.
std::string seed_of(const Json& result, const char* key) {
  const Json seed = value_or(result, key, Json());
  return seed.is_number_integer() ? seed.dump() : cell_of(result, key, 0);
}

FlightPicture picture_of(const results::RunRecord& run) {
  FlightPicture picture = shape_of(run);
  picture.station = run.station;
  for (const results::RunCollision& collision : run.collisions) {
    if (collision.p_W) picture.collisions.push_back(*collision.p_W);
  }
  return picture;
}

/// The value of --planner for this fleet: one name for all UAVs, or a name for each UAV.
std::string planner_option(const Json& planners) {
  std::set<std::string> names;
  std::vector<std::string> by_uav;
  for (const auto& [uav, planner] : planners.items()) {
    if (uav == "gcs" || !planner.is_string()) continue;
    names.insert(planner.get<std::string>());
    by_uav.push_back(uav + "=" + planner.get<std::string>());
  }
  return names.size() == 1 ? *names.begin() : joined(by_uav, ",");
}

std::string card(const std::string& name, const std::string& value, const std::string& small,
                 const std::string& style = "") {
  return fmt::format("<div class=\"card {}\"><span>{}</span><strong>{}</strong><small>{}</small></div>\n", style, name,
                     value, small);
}

std::string percent_of(double part, double whole) { return whole > 0.0 ? fixed(100.0 * part / whole, 1) + " %" : "–"; }

/// The main figures of the run.
std::string cards(const RunPage& page) {
  const Json& result = page.run.result;
  const Json attainable = value_or(result, "attainable", Json::object());
  const double score = number_in(result, "score"), earned = number_in(result, "score_earned");
  const auto possible = number_if_any(attainable, "score");
  const std::size_t collisions = value_or(result, "collisions", Json::array()).size();
  std::string html = "<div class=\"cards\">\n";
  html += card("Score delivered", "<span id=\"score\">" + cell_of(result, "score", 1) + "</span>",
               possible ? percent_of(score, *possible) + " of the " + fixed(*possible, 1) + " attainable"
                        : "the attainable score is not known",
               "main");
  html += card("Score earned", cell_of(result, "score_earned", 1), percent_of(score, earned) + " of it delivered");
  html += card("Points detected", cell_of(result, "points_detected", 0),
               "of " + (number_if_any(attainable, "points") ? cell_of(attainable, "points", 0) + " attainable, " : "") +
                   cell_of(result, "points_total", 0) + " in all");
  html +=
      card("Mission", cell_of(result, "mission_time_s", 1) + " s", cell_of(result, "sim_time_s", 1) + " s simulated");
  html += card("Collisions", std::to_string(collisions),
               fmt::format("{} UAVs, {} faults", page.run.uavs.size(), page.run.faults.size()),
               collisions > 0 ? "bad" : "");
  html += card("Speed", "×" + cell_of(result, "real_time_factor", 1),
               "real time, in " + cell_of(result, "wall_time_s", 1) + " s");
  return html + "</div>\n";
}

std::string facts(const Json& result) {
  std::set<std::string> vendors;
  const Json dds = value_or(result, "dds", Json::object());
  for (const auto& [program, vendor] : dds.items()) {
    if (vendor.is_string()) vendors.insert(vendor.get<std::string>());
  }
  const Json rules = value_or(result, "rules", nullptr);
  std::string html = "<dl class=\"facts\">\n";
  const auto fact = [&](const std::string& name, const std::string& value) {
    html += "<div><dt>" + name + "</dt><dd>" + (value.empty() ? "–" : escaped(value)) + "</dd></div>\n";
  };
  fact("Scenario", text_in(result, "scenario"));
  fact("Planner", planners_of(result));
  fact("Seed", seed_of(result, "seed"));
  fact("Scene seed", seed_of(result, "scene_seed"));
  std::string rules_text = rules.is_string() ? rules.get<std::string>() : rules.is_null() ? "" : rules.dump();
  const Json switches = value_or(result, "rule_switches", Json::object());
  for (const auto& [name, setting] : switches.items()) rules_text += ", " + name + " " + setting.dump();
  fact("Rules", rules_text);
  fact("Clock", text_in(result, "clock"));
  fact("DDS", joined(std::vector<std::string>(vendors.begin(), vendors.end())));
  fact("Skein", text_in(result, "skein_version") + (text_in(result, "math") == "native" ? ", native mathematics" : ""));
  html += "<div class=\"long\"><dt>Digest</dt><dd><code>" +
          (text_in(result, "digest").empty() ? "none: the run is not repeatable" : escaped(text_in(result, "digest"))) +
          "</code></dd></div>\n";
  return html + "</dl>\n";
}

std::string list_of(const std::string& style, const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string html = "<div class=\"note " + style + "\"><b>" + title + "</b><ul>\n";
  for (const std::string& line : lines) html += "<li>" + escaped(line) + "</li>\n";
  return html + "</ul></div>\n";
}

std::string notes(const RunPage& page) {
  std::vector<std::string> warnings, lost;
  for (const Json& warning : value_or(page.run.result, "warnings", Json::array())) {
    warnings.push_back(warning.is_string() ? warning.get<std::string>() : warning.dump());
  }
  for (const Json& member : value_or(page.run.result, "lost_members", Json::array())) {
    lost.push_back(text_in(member, "member") + " at " + cell_of(member, "time_s", 1) +
                   " s: " + text_in(member, "reason") +
                   (value_or(member, "back_at_s", Json()).is_number()
                        ? "; it took part again from " + cell_of(member, "back_at_s", 1) + " s on"
                        : ""));
  }
  return list_of("lost", "Lost in the run", lost) + list_of("warnings", "Warnings", warnings) +
         list_of("missing", "What this page lacks", page.run.missing);
}

}  // namespace

RunPage::RunPage(results::RunRecord data)
    : run(std::move(data)),
      lanes(lanes_of(run)),
      budgets(time_budgets(run, lanes)),
      boxes(box_figures(run)),
      earned(score_steps(run.captures, kDetected, results::Counts::when_taken)),
      links(link_shares(run)),
      latency(latency_of(run)),
      maps(map_figures(run)),
      picture(picture_of(run)) {}

std::string head_section(const RunPage& page) {
  const Json& result = page.run.result;
  const std::string status = text_in(result, "status");
  static const std::map<std::string, std::string> kWords = {{"completed", "completed"},
                                                            {"no_takeoff", "no UAV took off"},
                                                            {"interrupted", "interrupted"},
                                                            {"aborted", "aborted"}};
  const auto words = kWords.find(status);
  std::string html = fmt::format(
      "<header><p class=\"soft over\">Skein run</p>\n<h1>{} <span class=\"by\">by</span> {} "
      "<span class=\"status {}\">{}</span></h1>\n",
      escaped(text_in(result, "scenario")), escaped(shortened(planners_of(result), 80)),
      status == "completed" ? "good" : "bad", words == kWords.end() ? "status unknown" : words->second);
  return html + cards(page) + facts(result) + "<pre class=\"command\">" + escaped(command_of(result)) + "</pre>\n" +
         notes(page) + "</header>\n";
}

std::string planners_of(const Json& result) {
  std::vector<std::string> names;
  const Json planners = value_or(result, "planner", Json::object());
  for (const auto& [uav, planner] : planners.items()) {
    const std::string name = planner.is_string() ? planner.get<std::string>() : "";
    if (uav != "gcs" && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return joined(names, " · ");
}

std::string command_of(const Json& result) {
  for (const char* key : {"repeat_command", "command"}) {
    if (const std::string given = text_in(result, key); !given.empty()) return given;
  }
  std::string command = "skein run " + shell_word(text_in(result, "scenario"));
  const std::string planner = planner_option(value_or(result, "planner", Json::object()));
  if (!planner.empty()) command += " --planner " + shell_word(planner);
  command += " --seed " + seed_of(result, "seed");
  if (number_in(result, "scene_seed") > 0.0) command += " --scene-seed " + seed_of(result, "scene_seed");
  if (text_in(result, "status") == "completed")
    command += " --duration " + number_text(number_in(result, "mission_time_s"));
  const Json rules = value_or(result, "rules", nullptr);
  // A preset on the command line would replace the scenario's own switches.
  const bool has_switches = !value_or(result, "rule_switches", Json::object()).empty();
  if (rules.is_string() && !has_switches) command += " --rules " + shell_word(rules.get<std::string>());
  const Json dds = value_or(result, "dds", Json::object());
  if (text_in(dds, "sim_server") == "inproc") command += " --one-process";
  if (!text_in(result, "agent").empty()) command += " --agent " + shell_word(text_in(result, "agent"));
  return command;
}

std::string table_head(const std::vector<std::string>& names) {
  std::string html = "<thead><tr>";
  for (const std::string& name : names) html += "<th>" + name + "</th>";
  return html + "</tr></thead>";
}

std::string table_row(const std::vector<std::string>& cells, const std::string& style) {
  std::string html = style.empty() ? "<tr>" : "<tr class=\"" + style + "\">";
  for (const std::string& cell : cells) html += "<td>" + cell + "</td>";
  return html + "</tr>\n";
}

std::string cell_of(const Json& object, const char* key, int digits) {
  return fixed(number_if_any(object, key), digits);
}

std::string absent(const std::string& why) { return "<p class=\"absent\">" + why + "</p>\n"; }

}  // namespace skein::report
