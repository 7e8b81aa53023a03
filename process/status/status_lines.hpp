// Messages from programs to the launcher on status pipes (status_pipe.hpp) during a run: one JSON object per line,
// whose "type" names one of the structs below. Times are in seconds. Also the launcher's orders on control pipes.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/run/run_state.hpp"
#include "process/json_text.hpp"

namespace skein::status {

/// From sim_server, several times a second.
struct Progress {
  static constexpr const char* kType = "progress";
  double time_s = 0.0, mission_s = 0.0;  ///< simulated time since the start, and since the first takeoff
  double duration_s = 0.0;               ///< of the mission
  Phase phase = Phase::waiting;
  std::vector<std::string> in_contact = {};  ///< UAVs with a link to the ground station
  std::size_t alive = 0;                     ///< number of UAVs that are not out of the run
  std::vector<std::string> lost = {};        ///< names of lost members
};

/// From the station, when the score has changed.
struct Tally {
  static constexpr const char* kType = "tally";
  int points = 0;
  double score = 0.0, earned = 0.0;
};

/// From sim_server, while the fleet waits: the members for which it waits.
struct WaitingFor {
  static constexpr const char* kType = "waiting_for";
  std::vector<std::string> members = {}, missing = {};  ///< missing: for each member, what has not arrived
  std::string what = {};                                ///< "to join"
  double seconds = 0.0;                                 ///< wall time of the wait so far
  bool due = false;                                     ///< true: the launcher should print a line about the wait
};

/// From sim_server: a fault takes a member out of the run, or lets it back.
struct Order {
  static constexpr const char* kType = "order";
  enum class What { kill, stop, start, resume };
  std::string member = {};
  What order = What::resume;
  double time_s = 0.0;
};
constexpr std::array<EnumName<Order::What>, 4> enum_names(Order::What) {
  return {{{"kill", Order::What::kill},
           {"stop", Order::What::stop},
           {"start", Order::What::start},
           {"continue", Order::What::resume}}};
}

/// From sim_server: a warning that the user should see at once.
struct Warning {
  static constexpr const char* kType = "warning";
  std::string text = {};
};

/// From sim_server: a member has joined again.
struct Rejoined {
  static constexpr const char* kType = "rejoined";
  std::string member = {};
};

/// From sim_server, after its report: the run is over.
struct Ended {
  static constexpr const char* kType = "ended";
  RunStatus status = RunStatus::completed;
  std::vector<std::string> stalled = {};  ///< members that had not answered when the user ended the run
};

/// From every program, at its end (reports.hpp).
struct Report {
  static constexpr const char* kType = "report";
  Json report = Json::object();
};

using Line = std::variant<Progress, Tally, WaitingFor, Order, Warning, Rejoined, Ended, Report>;

/// For StatusPipe::send().
nlohmann::json line_json(const Line& line);

/// @returns nullopt if the text is none of these. Members that a line lacks, or has with another type, keep the
/// defaults above. Never throws: a user's command may write anything.
std::optional<Line> read_line(const std::string& text);

}  // namespace skein::status

namespace skein::orders {

/// Order: end the run at the next step.
struct Stop {};
/// Message: the process of a member has ended.
struct Lost {
  std::string member = {};
};

/// From the launcher to sim_server.
using Line = std::variant<Stop, Lost>;

/// "stop", "lost NAME": for Supervisor::send().
std::string text_of(const Line& line);
/// @returns nullopt when the text is none of these.
std::optional<Line> read_line(const std::string& text);

}  // namespace skein::orders
