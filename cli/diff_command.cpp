#include "cli/diff_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <optional>
#include <ranges>

#include "core/files/file_bytes.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"
#include "process/program.hpp"
#include "recording/mcap/reader.hpp"
#include "results/diff.hpp"
#include "results/result_file.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// The keys of result.json that are the same in all runs with the same digest: no measured time, and nothing that
/// depends on the machine, the DDS vendor or the way the run was started.
constexpr std::array kSettled = {"status",         "deterministic",   "digest",      "sim_time_s",   "points_total",
                                 "mission_time_s", "points_detected", "score",       "score_earned", "score_by_uav",
                                 "collisions",     "faults",          "flight_check"};
/// More of these keys: what the runs were told to do. A difference here explains all others, so it is reported first.
constexpr std::array kInputs = {"seed", "scene_seed", "exchange_period_s", "rules", "conditions"};
constexpr std::array kSettledOfUavs = {"name",     "role",   "alive",    "distance_m",       "max_speed_mps",
                                       "captures", "idle_s", "frozen_s", "commands_rejected"};
constexpr std::array kTables = {run_folder::kCaptures, run_folder::kEvents, run_folder::kScore,
                                run_folder::kScoreTimeline, run_folder::kTrajectories};

/// Files that every run has. Only whether they are there is compared.
constexpr std::array kOtherFiles = {run_folder::kActivity, run_folder::kCaptureMessages, run_folder::kScene,
                                    run_folder::kTracking};

std::string shown(const Json& value) {
  constexpr std::size_t kLongest = 80;
  const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

/// Names each key in an object that differs: shown() cuts long objects, whose beginnings may look the same.
void compare(const Json& a, const Json& b, const std::string& key, const std::string& of,
             std::vector<std::string>& found) {
  const Json one = value_or(a, key.c_str(), nullptr), other = value_or(b, key.c_str(), nullptr);
  if (one == other) return;
  if (!one.is_object() || !other.is_object()) {
    found.push_back("result.json: " + of + key + " " + shown(one) + ", and " + shown(other));
    return;
  }
  Json keys = one;
  keys.update(other);
  for (const auto& [inner, value] : keys.items()) compare(one, other, inner, of + key + ".", found);
}

/// The run's result.json; nullopt when the run has none because its launcher was killed.
std::optional<Json> result_of(const fs::path& run) {
  if (!fs::exists(run / run_folder::kResult)) return std::nullopt;
  return results::read_result_file(run);
}

/// @param inputs  differences of what the runs were told to do
void compare_results(const DiffOptions& options, std::vector<std::string>& inputs, std::vector<std::string>& found) {
  const auto a = result_of(options.run_a), b = result_of(options.run_b);
  if (!a || !b) {
    if (a.has_value() != b.has_value()) {
      found.push_back(std::string("result.json: only in the ") + (a ? "first" : "second") + " run");
    }
    return;
  }
  for (const char* key : kInputs) compare(*a, *b, key, "", inputs);
  for (const char* key : kSettled) compare(*a, *b, key, "", found);
  const Json uavs_a = value_or(*a, "uavs", Json::array()), uavs_b = value_or(*b, "uavs", Json::array());
  if (uavs_a.size() != uavs_b.size()) {
    found.push_back("result.json: " + std::to_string(uavs_a.size()) + " UAVs, and " + std::to_string(uavs_b.size()));
    return;
  }
  for (std::size_t i = 0; i < uavs_a.size(); ++i) {
    const std::string of = text_in(uavs_a[i], "name") + " ";
    for (const char* key : kSettledOfUavs) compare(uavs_a[i], uavs_b[i], key, of, found);
  }
}

/// "first" or "second", if only that run has this file.
std::optional<std::string> only_owner(const DiffOptions& options, const char* file) {
  const bool in_a = fs::exists(options.run_a / file), in_b = fs::exists(options.run_b / file);
  return in_a == in_b ? std::nullopt : std::optional<std::string>(in_a ? "first" : "second");
}

/// Whether a run's command line told it to record nothing. A run without a command line should have a recording.
bool records_nothing(const fs::path& run) try {
  const std::vector<std::string> words = shell_words(text_in(result_of(run).value_or(Json()), "command"));
  for (const std::string& word : words | std::views::reverse) {  // the last one counts
    if (word == "--record" || word.starts_with("--record=")) return word == "--record=none";
  }
  return false;
} catch (const InputError&) {  // the command is not in the shell's syntax
  return false;
}

/// Options decide how much is recorded, so recordings of two identical runs may differ, and one of them may have none.
/// But the recording of a run that was told to record must be there.
void compare_owners_of_recordings(const DiffOptions& options, std::vector<std::string>& found,
                                  std::vector<std::string>& notes) {
  const auto owner = only_owner(options, run_folder::kRecording);
  if (!owner) return;
  const bool chosen = records_nothing(*owner == "first" ? options.run_b : options.run_a);
  chosen ? notes.push_back(std::string("not compared: ") + run_folder::kRecording + ", which only the " + *owner +
                           " run has; the other one was told to record nothing")
         : found.push_back(std::string(run_folder::kRecording) + ": only in the " + *owner + " run");
}

std::ifstream opened(const fs::path& file) {
  std::ifstream in = open_text(file);
  if (!in) throw InputError(file.string() + ": cannot be read");
  return in;
}

/// The first line in which a table of two runs differs.
void compare_tables(const DiffOptions& options, const char* table, std::vector<std::string>& found) {
  if (const auto owner = only_owner(options, table)) {
    found.push_back(std::string(table) + ": only in the " + *owner + " run");
    return;
  }
  if (!fs::exists(options.run_a / table)) return;  // a program that died did not write its table
  std::ifstream a = opened(options.run_a / table), b = opened(options.run_b / table);
  std::string one, other;
  for (int line = 1;; ++line) {
    const bool more_a = static_cast<bool>(next_line(a, one, options.run_a / table));
    const bool more_b = static_cast<bool>(next_line(b, other, options.run_b / table));
    if (!more_a && !more_b) return;
    if (more_a && more_b && one == other) continue;
    const std::string end = "the end";
    found.push_back(std::string(table) + ", line " + std::to_string(line) + ": " + (more_a ? one : end) + " | " +
                    (more_b ? other : end));
    return;
  }
}

/// Messages by time, then topic.
using Messages = std::map<std::uint64_t, std::map<std::string, std::vector<mcap::Bytes>>>;

/// The commands and radio messages that programs sent in a run. Topics that Skein itself derives are left out.
std::optional<Messages> messages_of(const fs::path& run) {
  const fs::path file = run / run_folder::kRecording;
  if (!fs::exists(file)) return std::nullopt;
  Messages messages;
  mcap::Reader::whole(file).messages([&](const mcap::Channel& channel, const mcap::Message& message) {
    const std::string& topic = channel.topic;
    if (topic.starts_with("/tf") || topic.starts_with("/viz/") || topic.starts_with("/skein/")) return;
    messages[message.log_time][topic].emplace_back(message.data.begin(), message.data.end());
  });
  return messages;
}

/// Reports the differences of the recordings at the first time at which they differ.
void compare_recordings(const DiffOptions& options, std::vector<std::string>& found) {
  if (only_owner(options, run_folder::kRecording)) return;
  const auto a = messages_of(options.run_a), b = messages_of(options.run_b);
  if (!a || !b) return;
  static const std::map<std::string, std::vector<mcap::Bytes>> kNothing;
  auto one = a->begin(), other = b->begin();
  while (one != a->end() && other != b->end() && *one == *other) ++one, ++other;
  if (one == a->end() && other == b->end()) return;
  const bool has_one = one != a->end() && (other == b->end() || one->first <= other->first);
  const bool has_other = other != b->end() && (one == a->end() || other->first <= one->first);
  const auto& said_a = has_one ? one->second : kNothing;
  const auto& said_b = has_other ? other->second : kNothing;
  const std::string at =
      "recording.mcap, at " + fixed(1e-9 * static_cast<double>(has_one ? one->first : other->first), 2) + " s: ";
  std::map<std::string, std::pair<std::vector<mcap::Bytes>, std::vector<mcap::Bytes>>> topics;
  for (const auto& [topic, messages] : said_a) topics[topic].first = messages;
  for (const auto& [topic, messages] : said_b) topics[topic].second = messages;
  for (const auto& [topic, both] : topics) {
    const auto& [then, now] = both;
    if (then == now) continue;
    found.push_back(at + topic + ": " +
                    (then.size() == now.size()
                         ? counted(then.size(), "message") + " with different content"
                         : counted(then.size(), "message") + ", and " + counted(now.size(), "message")));
  }
}

/// Runs with the same digests sent the same messages, so only damage of their recordings matters. @throws InputError
void require_whole_recordings(const DiffOptions& options) {
  if (only_owner(options, run_folder::kRecording)) return;
  for (const fs::path& run : {options.run_a, options.run_b}) {
    if (fs::exists(run / run_folder::kRecording)) mcap::Reader::whole(run / run_folder::kRecording);
  }
}

}  // namespace

void add_diff(CLI::App& app, DiffOptions& diff) {
  CLI::App* command = app.add_subcommand(
      "diff", "Show the first step, entity and field in which two runs differ, and which of their files differ");
  command->add_option("RUN_A", diff.run_a, "Results folder")->required();
  command->add_option("RUN_B", diff.run_b, "Results folder to compare with it")->required();
  command->footer("Example:\n  skein diff runs/towers-kios-0 runs/again");
}

int diff_runs(const DiffOptions& options, const Console& console) {
  const std::optional<results::RunDifference> difference = results::first_difference(options.run_a, options.run_b);
  std::vector<std::string> inputs, found, notes;
  compare_results(options, inputs, found);
  for (const char* table : kTables) compare_tables(options, table, found);
  for (const char* file : kOtherFiles) {
    if (const auto owner = only_owner(options, file)) {
      found.push_back(std::string(file) + ": only in the " + *owner + " run");
    }
  }
  compare_owners_of_recordings(options, found, notes);
  if (!inputs.empty()) console.out << "the runs had different inputs:\n";
  for (const std::string& one : inputs) console.out << "  " << one << '\n';
  if (difference) {
    console.out << "first difference at step " << difference->step << " (" << difference->time_s << " s):\n";
    for (const std::string& field : difference->fields) console.out << "  " << field << '\n';
  }
  if (difference) {
    std::vector<std::string> said;
    compare_recordings(options, said);
    found.insert(found.begin(), said.begin(), said.end());
  } else {
    require_whole_recordings(options);
  }
  if (difference && !found.empty()) console.out << "besides:\n";
  if (!difference && !found.empty()) console.out << "the digests are the same, but other results differ:\n";
  for (const std::string& one : found) console.out << "  " << one << '\n';
  if (!difference && found.empty()) {
    console.out << (inputs.empty() ? "the runs are the same\n" : "the results are the same\n");
  }
  for (const std::string& note : notes) console.out << note << '\n';
  console.out << std::flush;
  return difference || !found.empty() || !inputs.empty() ? kExitCheckFailed : kExitDone;
}

}  // namespace skein::cli
