#include "run/progress_view.hpp"

#include <algorithm>
#include <iomanip>
#include <vector>

#include "core/planners/python_spec.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "core/text/utf8.hpp"
#include "results/from_nodes.hpp"
#include "results/losses.hpp"
#include "results/run_folder.hpp"
#include "results/uav_state.hpp"

namespace skein::cli {
namespace {

constexpr std::size_t kLongestPlanner = 32;  ///< of its name in the table of UAVs; more is cut off

/// A measured number, or "-" if there is none.
std::string cell(const Json& object, const char* key, int digits) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? fixed(found->get<double>(), digits) : "-";
}

/// Prints the losses of attainable score: a row for each cause that has any, and for each part of `below_threshold`.
void print_losses(std::ostream& out, const Json& losses) {
  const char* head = "lost      ";
  const auto row = [&](const std::string& text, double score, double points) {
    if (points <= 0.0) return;
    out << head << std::left << std::setw(24) << text << std::right << std::setw(10) << fixed(score, 3) << std::setw(8)
        << fixed(points, 0) << " points\n";
    head = "          ";
  };
  for (std::size_t i = 0; i < results::kCauses.size(); ++i) {
    const Json sum = value_or(losses, results::kCauses[i].key, Json::object());
    row(results::kCauses[i].title, number_in(sum, "score"), number_in(sum, "points"));
    if (i != results::cause_of("below_threshold")) continue;
    const auto parts = results::poor_parts(losses);
    for (std::size_t part = 0; part < parts.size(); ++part) {
      row(std::string("  ") + results::kPoorParts[part].title, parts[part].score,
          static_cast<double>(parts[part].points));
    }
  }
}

/// Prints a table with the outcome of each UAV.
void print_uavs(std::ostream& out, const Json& result) {
  const Json faults = value_or(result, "faults", Json::array());
  std::vector<std::vector<std::string>> rows = {
      {"UAV", "role", "planner", "state", "score", "pictures", "distance [m]", "idle [s]"}};
  for (const Json& uav : result["uavs"]) {
    const std::string name = uav["name"];
    std::string planner = without_folders(result["planner"][name]);
    if (planner.size() > kLongestPlanner) planner = first_bytes(planner, kLongestPlanner - 2) + "..";
    rows.push_back({name, uav["role"], planner, results::uav_state(uav, faults),
                    cell(result["score_by_uav"], name.c_str(), 3), cell(uav, "captures", 0), cell(uav, "distance_m", 1),
                    cell(uav, "idle_s", 1)});
  }
  std::size_t names = 0, planners = 12;
  for (const std::vector<std::string>& row : rows) {
    names = std::max(names, row[0].size());
    planners = std::max(planners, row[2].size());
  }
  for (const std::vector<std::string>& row : rows) {
    out << std::left << std::setw(static_cast<int>(names)) << row[0] << std::right;
    for (std::size_t i = 1; i < row.size(); ++i)
      out << std::setw(i == 2 ? static_cast<int>(planners) + 2 : 14) << row[i];
    out << '\n';
  }
}

}  // namespace

void ProgressView::progress(const status::Progress& progress, double wall_s) {
  if (first_wall_s_ < 0.0) {
    first_sim_s_ = progress.time_s;
    first_wall_s_ = wall_s;
  }
  const double speed = wall_s > first_wall_s_ ? (progress.time_s - first_sim_s_) / (wall_s - first_wall_s_) : 0.0;
  // A UAV whose program is lost still hovers, perhaps in line of sight of the station, but is not in contact.
  std::vector<std::string> in_contact = progress.in_contact;
  std::erase_if(in_contact, [&](const std::string& uav) {
    return std::find(progress.lost.begin(), progress.lost.end(), uav) != progress.lost.end();
  });
  std::string text = "simulated " + fixed(progress.time_s, 1) + " s";
  text += progress.phase == Phase::waiting
              ? ", before take-off"
              : ", mission " + fixed(progress.mission_s, 0) + " of " + fixed(progress.duration_s, 0) + " s";
  text += ", x" + fixed(speed, 1) + ", points " + std::to_string(tally_.points) + ", score " + fixed(tally_.score, 1) +
          ", in contact: " + (in_contact.empty() ? "none" : joined(in_contact)) +
          (progress.lost.empty() ? "" : ", lost: " + joined(progress.lost));
  if (terminal_) return show(text);
  const int tenths = progress.duration_s > 0.0 ? static_cast<int>(10.0 * progress.mission_s / progress.duration_s) : 0;
  if (tenths <= tenths_shown_) return;
  tenths_shown_ = tenths;
  show(text);
}

void ProgressView::waiting_for(const status::WaitingFor& wait) {
  if (!terminal_ && !wait.due) return;
  show("waiting for " + joined_first(wait.members) + " " + wait.what + " (" + fixed(wait.seconds, 0) + " s)" +
       (wait.missing.empty() ? "" : ": " + joined_first(wait.missing)));
}

void ProgressView::write_to(std::ostream& out, bool terminal) {
  finish();
  out_ = &out;
  terminal_ = terminal;
}

void ProgressView::message(const std::string& text) {
  finish();
  *out_ << text << std::endl;
}

void ProgressView::finish() {
  if (!shown_.empty()) *out_ << std::endl;
  shown_.clear();
}

void ProgressView::show(const std::string& text) {
  if (!terminal_) {
    *out_ << text << std::endl;
    return;
  }
  const std::size_t blanks = shown_.size() > text.size() ? shown_.size() - text.size() : 0;
  *out_ << '\r' << text << std::string(blanks, ' ') << std::flush;
  shown_ = text;
}

void print_summary(std::ostream& out, const Json& result, const std::filesystem::path& dir) {
  const double score = number_in(result, "score"), earned = number_in(result, "score_earned");
  const Json attainable = value_or(result, "attainable", Json::object());
  const double possible = number_in(attainable, "score");
  out << '\n'
      << "score     " << fixed(score, 3) << " of " << fixed(earned, 3) << " earned"
      << (earned > 0.0 ? " (" + fixed(100.0 * score / earned, 1) + " % delivered)" : "")
      << (possible > 0.0 ? ", " + fixed(100.0 * score / possible, 1) + " % of attainable" : "") << '\n'
      << "points    " << cell(result, "points_detected", 0) << " of " << cell(result, "points_total", 0)
      << (possible > 0.0 ? ", " + cell(attainable, "points", 0) + " attainable" : "") << '\n';
  print_losses(out, value_or(result, "losses", Json::object()));
  out << "status    " << result["status"].get<std::string>() << ", mission " << cell(result, "mission_time_s", 1)
      << " s, " << counted(result["collisions"].size(), "collision") << '\n'
      << "speed     x" << cell(result, "real_time_factor", 1) << " (" << cell(result, "sim_time_s", 1)
      << " s simulated in " << cell(result, "wall_time_s", 1) << " s), "
      << (number_in(result, "memory_mb") > 0.0 ? "memory " + cell(result, "memory_mb", 0) + " MB, "
                                               : "")  // measured by the launcher
      << "LiDAR " << cell(result.contains("timing") ? result["timing"] : result, "lidar_ms_per_scan", 2)
      << " ms a scan\n"
      << "digest    " << (result["digest"].is_string() ? result["digest"].get<std::string>() : "none") << "\n\n";
  print_uavs(out, result);
  if (const std::string nodes = results::free_nodes_table(result["uavs"]); !nodes.empty()) out << '\n' << nodes;
  for (const Json& warning : result["warnings"])
    out << "warning: " << (warning.is_string() ? warning.get<std::string>() : warning.dump()) << '\n';
  out << "\nresults   " << dir.string() << '\n';
  const std::filesystem::path page = dir / run_folder::kPage;
  if (std::filesystem::exists(page)) out << "report    " << page.string() << '\n';
}

}  // namespace skein::cli
