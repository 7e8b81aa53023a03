#include "cli/sweep/slurm.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "cli/sweep/engines.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"
#include "host/preflight.hpp"
#include "host/supervisor.hpp"
#include "process/files/atomic_file.hpp"
#include "process/host/environment.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kUsualArraySize = 1001;  ///< Slurm's own default of MaxArraySize
constexpr std::size_t kMostSilent = 40;        ///< failed queries in a row: about ten minutes
constexpr std::chrono::milliseconds kFirstLook{250}, kLongestLook{15000};  ///< periods of queries to Slurm
constexpr std::chrono::milliseconds kGlance{500};      ///< period of looks at the folder of finished units
constexpr std::chrono::seconds kStrandedFor{60};       ///< missing nodes are not expected back after that
constexpr std::chrono::milliseconds kLeastLook{2000};  ///< least time to a query that a finished unit causes
/// Slurm sends a unit SIGTERM 30 s before its time limit. The flight in progress then is flown again.
constexpr const char* kNotice = "B:TERM@30";

/// The jobs of a sweep are found by their names, which also contain the number of the list of units. So the process
/// that submitted them need not run any more.
std::string job_prefix(const SweepSettings& settings) { return "skein-" + settings.token + "-"; }

/// Standard output of a shell command. @throws InputError with the command's own messages if it fails.
std::string output_of(const std::string& command) {
  const ScratchDir scratch;
  const fs::path out = scratch.path() / "out", log = scratch.path() / "log";
  const ExitStatus exit =
      run_to_end({"slurm", {"/bin/sh", "-c", command + " >" + shell_word(out)}, environment_with({}), log});
  if (!exit.ok()) {
    throw InputError("'" + command.substr(0, command.find(' ')) + "' ended with " + exit.text() + ":" +
                     last_lines_below(log, 3));
  }
  std::ifstream in(out);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Slurm's MaxArraySize: all task indices of an array must be less.
std::size_t max_array_size() {
  std::istringstream lines(output_of("scontrol show config"));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("MaxArraySize")) continue;
    const auto value = parse_number(line.substr(line.find_last_of("= ") + 1));
    if (value && *value >= 2.0 && *value <= 1e9) return static_cast<std::size_t>(*value);
  }
  return kUsualArraySize;
}

class SlurmEngine : public SweepEngine {
 public:
  SlurmEngine(const SweepOptions& options, std::optional<int> jobs, const SweepFolder& folder, const Console& console)
      : options_(sbatch_options(options.slurm.value_or(""))),
        detach_(options.detach),
        jobs_(jobs),
        folder_(folder),
        console_(console) {
    for (const char* program : {"sbatch", "squeue", "scontrol", "scancel"}) {
      if (!is_installed(program)) {
        throw InputError(std::string("--executor slurm: there is no ") + program +
                         ": this must be a machine from which Slurm takes jobs");
      }
    }
  }

  bool fly(const EngineWork& work, const Meanwhile& meanwhile) override {
    std::set<std::size_t> held;
    for (const EngineJob& job : jobs()) held.insert(job.unit);
    EngineWork given{{}, work.not_on};
    std::ranges::copy_if(work.units, std::back_inserter(given.units),
                         [&](std::size_t unit) { return !held.contains(unit); });
    token_ = folder_.settings().value().token;
    arrays_.clear();
    merge_.clear();
    if (!given.units.empty()) submit(given, jobs_);
    if (!held.empty()) console_.err << held.size() << " units are with Slurm already" << std::endl;
    if (detach_) return false;
    return follow(work.units, meanwhile);
  }

  std::vector<EngineJob> jobs() override {
    const auto settings = folder_.settings();
    if (!settings) return {};
    const std::string prefix = job_prefix(*settings);
    std::vector<EngineJob> jobs;
    std::map<std::string, std::vector<std::size_t>> lists;
    for (const std::vector<std::string>& job : queue(prefix)) {
      const auto index = parse_number(job[2]);
      if (!index) continue;  // the job that merges
      const std::string list = job[1].substr(prefix.size());
      if (!lists.contains(list)) lists[list] = units_in(list);
      const auto at = static_cast<std::size_t>(*index);
      if (at < lists[list].size()) jobs.push_back({lists[list][at], job[3] + (job[4].empty() ? "" : " on " + job[4])});
    }
    return jobs;
  }

  void cancel() override {
    const auto settings = folder_.settings();
    if (!settings) return;
    std::set<std::string> ids;
    for (const std::vector<std::string>& job : queue(job_prefix(*settings))) ids.insert(job[0]);
    for (const std::string& id : ids) output_of("scancel " + id);
  }

  bool has_other_nodes() const override { return true; }
  bool lacks_nodes() const override { return lacks_nodes_; }

 private:
  /// The jobs whose names begin with `prefix`: id, name, index in its array, state, node, reason why it waits.
  std::vector<std::vector<std::string>> queue(const std::string& prefix) const {
    std::vector<std::vector<std::string>> jobs;
    std::istringstream lines(output_of("squeue --noheader --array --format='%F|%j|%K|%T|%N|%r'"));
    for (std::string line; std::getline(lines, line);) {
      std::vector<std::string> parts = split(line, '|');
      if (parts.size() == 6 && parts[1].starts_with(prefix)) jobs.push_back(std::move(parts));
    }
    return jobs;
  }

  std::vector<std::size_t> units_in(const std::string& list) const {
    std::vector<std::size_t> units;
    std::ifstream lines(folder_.dir() / "lists" / list);
    for (std::size_t unit = 0; lines >> unit;) units.push_back(unit);
    return units;
  }

  /// @param at_once  units that may fly at the same time; none: as many as Slurm likes
  void submit(const EngineWork& work, std::optional<int> at_once) {
    std::vector<std::string> ids;
    try {
      submit_arrays(work, at_once, ids);
    } catch (const InputError&) {
      // The sweep must go on after the arrays before the one that was rejected, too.
      if (!ids.empty()) merge_ = submit_merge();
      throw;
    }
    merge_ = submit_merge();
    console_.err << fmt::format("{} units are with Slurm, job{} {}", work.units.size(), ids.size() == 1 ? "" : "s",
                                joined(ids))
                 << std::endl;
  }

  /// @param ids  receives the arrays that Slurm has taken, also if it rejects a later one
  void submit_arrays(const EngineWork& work, std::optional<int> at_once, std::vector<std::string>& ids) {
    const std::size_t most = max_array_size();
    for (std::size_t i = 0; i < work.units.size(); i += most) {
      const auto begin = work.units.begin() + static_cast<std::ptrdiff_t>(i);
      const auto end = work.units.begin() + static_cast<std::ptrdiff_t>(std::min(i + most, work.units.size()));
      // Slurm applies `at_once` to each array, so arrays with such a limit run one after the other.
      ids.push_back(submit_array({{begin, end}, work.not_on}, at_once, at_once && !ids.empty() ? ids.back() : ""));
      arrays_.push_back(ids.back());
    }
  }

  /// Submits more units while others fly. If Slurm, being busy, rejects them, the next call of fly() submits them.
  void submit_more(const EngineWork& work, std::optional<int> at_once) try {
    if (work.units.empty()) return;
    const std::string former = merge_;
    try {
      submit(work, at_once);
    } catch (const InputError& error) {
      console_.err << error.what() << std::endl;
    }
    // The new merge job, if there is one, waits for all arrays.
    if (!former.empty() && merge_ != former) output_of("scancel " + former);
  } catch (const InputError& error) {
    console_.err << error.what() << std::endl;
  }

  std::string submit_array(const EngineWork& work, std::optional<int> at_once, const std::string& after) {
    const auto settings = *folder_.settings();
    const fs::path lists = folder_.dir() / "lists";
    int number = 1;
    while (fs::exists(lists / std::to_string(number))) ++number;
    const std::string list = std::to_string(number);
    std::string lines;
    for (const std::size_t unit : work.units) lines += std::to_string(unit) + "\n";
    write_file_atomically(lists / list, lines);
    write_file_atomically(lists / (list + ".sh"), "#!/bin/sh\nexec /bin/sh " + shell_word(fly_script(folder_)) +
                                                      " \"$(sed -n \"$((SLURM_ARRAY_TASK_ID + 1))p\" " +
                                                      shell_word(lists / list) + ")\"\n");
    std::string command = "sbatch --parsable --requeue --signal=" + std::string(kNotice) +
                          fmt::format(" --array=0-{}{} --job-name={}{}", work.units.size() - 1,
                                      at_once ? "%" + std::to_string(*at_once) : "", job_prefix(settings), list);
    if (!work.not_on.empty()) {
      command += " --exclude=" + shell_word(joined({work.not_on.begin(), work.not_on.end()}, ","));
    }
    if (!after.empty()) command += " --dependency=afterany:" + after;
    const std::string id = submitted(command, lists / (list + ".sh"));
    if (!work.not_on.empty()) excluding_.insert(id);
    return id;
  }

  /// Submits the job that continues the sweep after all arrays, even if this process has ended by then: it submits
  /// failed units again, or merges the results. @returns its id.
  std::string submit_merge() const {
    const auto settings = *folder_.settings();
    std::vector<std::string> words = settings.command;
    if (std::ranges::count(words, "--detach") == 0) words.emplace_back("--detach");
    std::string script = "#!/bin/sh\ncd " + shell_word(settings.working_folder) + " || exit 3\nexport " +
                         kMergeVariable + "=1\nexec " + shell_word(launcher_file()) + " " + shell_line(words) + "\n";
    const fs::path file = folder_.dir() / "lists" / "merge.sh";
    write_file_atomically(file, script);
    return submitted(
        "sbatch --parsable --job-name=" + job_prefix(settings) + "merge --dependency=afterany:" + joined(arrays_, ":"),
        file);
  }

  std::string submitted(std::string command, const fs::path& script) const {
    for (const std::string& option : options_) command += " " + shell_word(option);
    command +=
        " --output=" + shell_word(folder_.dir() / "log" / "slurm.log") + " --open-mode=append " + shell_word(script);
    const std::string id = output_of(command);
    return id.substr(0, id.find_first_of(";\n"));  // with several clusters, the cluster's name follows
  }

  /// Waits until Slurm holds no unit any more. Queries Slurm less and less often while nothing changes, but soon after
  /// a unit has finished. @returns false if the user interrupted it.
  bool follow(const std::vector<std::size_t>& units, const Meanwhile& meanwhile) try {
    Supervisor signals;
    std::chrono::milliseconds look = kFirstLook;
    std::size_t before = 0, silent = 0, silent_of_stranded = 0;
    bool may_ask = true;
    for (;;) {
      const auto left = jobs_left(silent);
      if (left && left->empty()) return true;
      meanwhile.tell();
      if (left) give_up_stranded(*left, silent_of_stranded);
      if (left && may_ask && idle_slots(*left) > 0) {
        may_ask = false;
        submit_more(meanwhile.more(), jobs_ ? std::optional(idle_slots(*left)) : std::nullopt);
      }
      look = !left || left->size() == before ? std::min(2 * look, kLongestLook) : kFirstLook;
      before = left ? left->size() : before;
      wait_for_next_look(signals, units, look);
    }
  } catch (const Interrupted&) {
    console_.err << "Slurm goes on flying, and merges; the same command follows again" << std::endl;
    return false;
  }

  /// Cancels units that wait for nodes that are gone, because Slurm would wait for ever. If Slurm, being busy, does not
  /// answer, the next look tries again. @param silent  counts failed tries in a row
  void give_up_stranded(const std::vector<EngineJob>& left, std::size_t& silent) try {
    const std::set<std::string> arrays = stranded_arrays(left);
    if (stranded_for_long(!arrays.empty())) {
      for (const std::string& id : arrays) output_of("scancel " + id);
      stranded_since_.reset();
      lacks_nodes_ = true;
      console_.err << "no node is left for job " << joined({arrays.begin(), arrays.end()})
                   << ", which must not fly on others: cancelled" << std::endl;
    }
    silent = 0;
  } catch (const InputError&) {
    if (++silent > kMostSilent) throw;
  }

  bool stranded_for_long(bool stranded) {
    const auto now = std::chrono::steady_clock::now();
    if (!stranded) {
      stranded_since_.reset();
    } else if (!stranded_since_) {
      stranded_since_ = now;
    }
    return stranded_since_ && now - *stranded_since_ >= kStrandedFor;
  }

  /// Arrays that exclude nodes, if only their units are left, and Slurm reports that all other nodes are gone.
  std::set<std::string> stranded_arrays(const std::vector<EngineJob>& left) const {
    const auto waits = [](const EngineJob& job) { return job.state == "PENDING"; };
    if (excluding_.empty() || left.empty() || !std::ranges::all_of(left, waits)) return {};
    std::set<std::string> arrays;
    for (const std::vector<std::string>& job : queue(job_prefix(*folder_.settings()))) {
      if (!parse_number(job[2])) continue;  // the job that merges
      const bool no_node = job[5].starts_with("ReqNodeNotAvail") || job[5].starts_with("Nodes required");
      if (!no_node || !excluding_.contains(job[0])) return {};
      arrays.insert(job[0]);
    }
    return arrays;
  }

  /// Number of slots for which no unit is left, while other units still fly.
  int idle_slots(const std::vector<EngineJob>& left) const {
    const bool waits = std::ranges::any_of(left, [](const EngineJob& job) { return job.state.starts_with("PENDING"); });
    if (waits || left.empty()) return 0;
    return jobs_ ? std::max(*jobs_ - static_cast<int>(left.size()), 0) : 1;
  }

  /// Waits for `look`, or until a unit has finished. @throws Interrupted
  void wait_for_next_look(Supervisor& signals, const std::vector<std::size_t>& units, std::chrono::milliseconds look) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now(), until = begin + look;
    auto changed = folder_.done_changed(token_);  // to list a folder of many files twice a second costs too much
    const std::size_t done = done_of(units);
    std::size_t now = done;
    for (auto left = look; left.count() > 0;
         left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now())) {
      for (const Event& event : signals.wait(std::min(left, kGlance))) {
        if (event.kind == Event::Kind::interrupt) throw Interrupted{};
      }
      if (const auto latest = folder_.done_changed(token_); latest != changed) {
        changed = latest;
        now = done_of(units);
      }
      if (now != done && (now == units.size() || Clock::now() - begin > kLeastLook)) return;
    }
  }

  std::size_t done_of(const std::vector<std::size_t>& units) const {
    const std::set<std::size_t> done = folder_.done(token_);
    return static_cast<std::size_t>(
        std::ranges::count_if(units, [&](std::size_t unit) { return done.contains(unit); }));
  }

  /// nullopt: Slurm does not answer, as happens when it is busy. @param silent  counts failed queries in a row
  std::optional<std::vector<EngineJob>> jobs_left(std::size_t& silent) try {
    std::vector<EngineJob> left = jobs();
    silent = 0;
    return left;
  } catch (const InputError&) {
    if (++silent > kMostSilent) throw;
    return std::nullopt;
  }

  const std::vector<std::string> options_;
  const bool detach_;
  const std::optional<int> jobs_;
  const SweepFolder& folder_;
  const Console console_;
  std::string token_;                ///< of the sweep
  std::vector<std::string> arrays_;  ///< jobs of the units that fly() gave to Slurm
  std::set<std::string> excluding_;  ///< jobs of units that exclude nodes
  std::optional<std::chrono::steady_clock::time_point> stranded_since_;
  bool lacks_nodes_ = false;
  std::string merge_;  ///< job that continues the sweep after the arrays; empty: none
};

}  // namespace

std::vector<std::string> sbatch_options(const std::string& text) {
  const std::set<std::string> ours = {"array",      "job-name", "output",     "open-mode", "parsable", "requeue",
                                      "no-requeue", "signal",   "dependency", "wrap",      "wait"};
  std::vector<std::string> options;
  if (text.empty()) return options;
  for (const std::string& piece : split(text)) {
    const std::size_t equals = piece.find('=');
    if (equals == std::string::npos) {
      if (options.empty())
        throw InputError("--slurm " + text + ": must be NAME=VALUE,..., as partition=debug,time=10:00");
      options.back() += "," + piece;
      continue;
    }
    const std::string name = piece.substr(0, equals);
    if (name.empty() || name.front() == '-' ||
        name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") != std::string::npos) {
      throw InputError("--slurm " + text + ": '" + name + "' is not an option of sbatch; give long ones, without --");
    }
    if (ours.contains(name)) throw InputError("--slurm " + text + ": Skein sets " + name + " itself");
    options.push_back("--" + piece);
  }
  return options;
}

std::unique_ptr<SweepEngine> make_slurm_engine(const SweepOptions& options, std::optional<int> jobs,
                                               const SweepFolder& folder, const Console& console) {
  return std::make_unique<SlurmEngine>(options, jobs, folder, console);
}

}  // namespace skein::cli
