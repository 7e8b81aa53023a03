#include "cli/place/placed_fleet.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <fstream>

#include "cli/place/host_service.hpp"
#include "core/config/network_config.hpp"
#include "core/files/file_bytes.hpp"
#include "core/text/suggestion.hpp"
#include "core/topics.hpp"
#include "process/host/environment.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr int kFileMode = 0644, kProgramMode = 0755, kKeyMode = 0400;
constexpr const char* kDoctorSeconds = "8";

std::string domain_of(const std::string& program) { return programs::member_name(program); }

}  // namespace

struct PlacedFleet::There {
  There(const PlacedHost& host, const fs::path& log) : programs(host.programs), link(host, log) {}

  std::vector<std::string> programs;  ///< placed on this host
  HostLink link;
  HostFolders folders;
  std::string machine, user, launcher_address, address;
  bool is_root = false, same_machine = false;
  std::set<std::string> running, stopped;
  std::map<std::string, Use> use;
  bool collected = false;
  std::vector<Frame> files;
};

PlacedFleet::PlacedFleet(const FleetPlan& plan, const std::vector<PlacedHost>& hosts)
    : plan_(plan), hosts_(connect(hosts)), network_(network_of_hosts()) {}

PlacedFleet::~PlacedFleet() = default;

// ---- before the flight ------------------------------------------------------------------------------------------

/// Connects to all hosts at the same time, since each login takes a while.
std::vector<std::unique_ptr<PlacedFleet::There>> PlacedFleet::connect(const std::vector<PlacedHost>& hosts) const {
  std::vector<std::unique_ptr<There>> all;
  for (const PlacedHost& host : hosts) {
    all.push_back(std::make_unique<There>(host, scratch_.path() / ("connection-" + std::to_string(all.size()))));
  }
  for (const auto& there : all) meet(*there, all);
  return all;
}

void PlacedFleet::meet(There& there, const std::vector<std::unique_ptr<There>>& all) const {
  const Frame hello = there.link.answer("hello");
  const std::string name = there.link.name();
  if (hello.text("build") != build_digest(plan_.bin_dir)) {
    throw InputError("--place: " + name + " has another build of Skein (version " + hello.text("version") + ", in " +
                     hello.text("bin") + "); install this one there, or say with --skein-path where it is");
  }
  there.folders = {hello.text("bin"), hello.text("config"), hello.text("root")};
  there.machine = hello.text("machine");
  there.user = hello.text("user");
  there.is_root = value_or(hello.head, "is_root", false).get<bool>();
  there.launcher_address = hello.text("launcher_address");
  there.address = hello.text("address");
  there.same_machine = there.machine == machine_identity();
  for (const auto& other : all) {
    if (other.get() == &there || other->machine != there.machine) continue;
    throw InputError("--place: " + other->link.name() + " and " + name + " are one machine; give it one name");
  }
}

void PlacedFleet::take_domains(std::optional<int> base, int size) {
  for (int from = kFirstDomain;; from = domains_->base() + 1) {
    domains_.reset();
    domains_.emplace(base, size, "", from);
    std::string taken;
    for (const auto& there : hosts_) {
      if (there->same_machine || !taken.empty()) continue;
      there->link.send({{"do", "domains"}, {"base", domains_->base()}, {"size", size}});
      const std::string why = there->link.answer("domains").text("taken");
      if (!why.empty()) taken = "on " + there->link.name() + ": " + why;
    }
    if (taken.empty()) return;
    if (base) throw InputError(taken);
  }
}

std::optional<std::string> PlacedFleet::network_of_hosts() const {
  if (plan_.options.network) return plan_.options.network;
  std::string text;
  for (const auto& there : hosts_) {
    if (there->same_machine) continue;
    const std::string other = there->address.empty() ? there->link.name() : there->address;
    if (there->launcher_address.empty()) {
      throw InputError("--place: " + there->link.name() +
                       " does not know by which address it was reached; say with --network how the hosts reach each "
                       "other");
    }
    for (const std::string& program : there->programs) {
      text += fmt::format("{}'{}': {{peers: ['{}', '{}']}}", text.empty() ? "" : ", ", domain_of(program),
                          there->launcher_address, other);
    }
  }
  return text.empty() ? std::nullopt : std::optional("{" + text + "}");
}

/// A doctor process on this host. @param name  its name among the doctors.
ProgramSpec PlacedFleet::doctor(const std::string& name, const std::vector<std::string>& domains) const {
  std::vector<std::string> argv = {plan_.bin_dir / programs::kDoctor,
                                   "--scenario",
                                   fs::absolute(plan_.scenario.file),
                                   "--dds",
                                   plan_.options.dds,
                                   "--domain",
                                   std::to_string(domains_->base()),
                                   "--network",
                                   *network_,
                                   "--as",
                                   name,
                                   "--only",
                                   joined(domains, ","),
                                   "--seconds",
                                   kDoctorSeconds,
                                   "--net",
                                   "--until-heard"};
  if (plan_.options.uavs) argv.insert(argv.end(), {"--uavs", std::to_string(*plan_.options.uavs)});
  return {"doctor-" + name, std::move(argv), fleet_environment(false),
          scratch_.path() / run_folder::log_file("doctor-" + name)};
}

void PlacedFleet::ask_doctors(const std::function<void(const std::string&)>& tell) {
  std::vector<std::string> all;
  for (const auto& there : hosts_) {
    if (there->same_machine) continue;
    std::vector<std::string> own;
    for (const std::string& program : there->programs) own.push_back(domain_of(program));
    all.insert(all.end(), own.begin(), own.end());
    const ProgramSpec spec = doctor(there->link.name(), own);
    PlacedProgram placed = place_program(plan_, {there->programs.front(), {""}, {}, {}}, there->folders, {});
    placed.argv = spec.argv;
    placed.argv[0] = there->folders.bin / programs::kDoctor;
    placed.argv[2] = (there->folders.root / "files" / fs::path(spec.argv[2]).relative_path()).string();
    launch(*there, spec, placed);
  }
  if (all.empty()) return;
  here_.start(doctor("launcher", all));
  tell("asking the hosts whether they hear each other");
  std::string trouble;
  while (!running().empty()) {
    for (const Event& event : wait(kSpeak)) {
      if (event.kind == Event::Kind::interrupt) throw Interrupted{};
      if (event.kind != Event::Kind::exited || event.exit.ok()) continue;
      trouble += "\n" + event.program + ": " + event.exit.text() +
                 last_lines_below(scratch_.path() / run_folder::log_file(event.program), 20);
    }
  }
  if (!trouble.empty()) {
    throw InputError(
        "--place: the hosts do not hear each other as a fleet must (docs/doctor.md; --no-check flies all "
        "the same):" +
        trouble);
  }
}

std::vector<std::string> PlacedFleet::security_warnings() const {
  std::vector<std::string> warnings;
  for (const auto& there : hosts_) {
    if (there->is_root) continue;
    warnings.push_back(
        fmt::format("--secure on {}: the launcher does not log in as root there, so {} runs as the user {}, without a "
                    "user id of its "
                    "own (docs/security.md)",
                    there->link.name(), joined(there->programs), there->user));
  }
  return warnings;
}

std::string PlacedFleet::text() const {
  std::vector<std::string> parts;
  for (const auto& there : hosts_) {
    std::vector<std::string> members;
    for (const std::string& program : there->programs) members.push_back(programs::member_name(program));
    parts.push_back(joined(members) + " on " + there->link.name());
  }
  return joined(parts, "; ");
}

// ---- programs ---------------------------------------------------------------------------------------------------

PlacedFleet::There* PlacedFleet::of(const std::string& program) const {
  for (const auto& there : hosts_) {
    if (there->running.contains(program) || std::ranges::find(there->programs, program) != there->programs.end()) {
      return there.get();
    }
  }
  return nullptr;
}

void PlacedFleet::start(const ProgramSpec& spec) {
  There* const there = of(spec.name);
  if (there == nullptr) return here_.start(spec);
  launch(*there, spec, place_program(plan_, spec, there->folders, network_.value_or("")));
}

void PlacedFleet::launch(There& there, const ProgramSpec& spec, const PlacedProgram& placed) {
  if (there.link.lost()) throw std::runtime_error(there.link.why());
  logs_[spec.name] = spec.log;
  if (!std::ofstream(spec.log, spec.append_log ? std::ios::app : std::ios::trunc)) {
    throw std::system_error(errno, std::generic_category(), spec.log.string());
  }
  for (const auto& [to, from] : placed.files) {
    const bool key = !placed.keys.empty() && to.parent_path() == placed.keys;
    const int mode = key ? kKeyMode : to.string() == placed.argv[0] ? kProgramMode : kFileMode;
    there.link.send({{"do", "file"}, {"path", to.string()}, {"mode", mode}}, read_file_bytes(from, kLargestPlacedFile));
  }
  there.link.send({{"do", "start"},
                   {"name", spec.name},
                   {"argv", placed.argv},
                   {"variables", placed.variables},
                   {"native", plan_.options.native},
                   {"append_log", spec.append_log},
                   {"minded", spec.minded},
                   {"keys", placed.keys.string()}});
  there.running.insert(spec.name);
  there.stopped.erase(spec.name);
}

std::vector<Event> PlacedFleet::wait(milliseconds limit) {
  std::vector<int> descriptors;
  for (const auto& there : hosts_) descriptors.push_back(there->link.descriptor());
  here_.watch_too(descriptors);
  std::vector<Event> events = here_.wait(limit.count() < 0 ? kSpeak : std::min(limit, kSpeak));
  take_news(events);
  return events;
}

void PlacedFleet::take_news(std::vector<Event>& events) {
  for (const auto& there : hosts_) {
    for (const Frame& frame : there->link.take()) hear(*there, frame, events);
    if (!there->link.lost()) continue;
    for (const std::string& program : std::exchange(there->running, {})) {
      ExitStatus lost;
      lost.lost_host = "its host " + there->link.why();
      events.push_back({Event::Kind::exited, program, {}, lost});
    }
  }
}

void PlacedFleet::hear(There& there, const Frame& frame, std::vector<Event>& events) {
  const std::string say = frame.text("say"), name = frame.text("name");
  const auto is_placed = [&](const std::string& program) {
    return std::ranges::find(there.programs, program) != there.programs.end();
  };
  // Takes only frames about programs that are placed on the host: an agent's host must not speak for the server.
  if (!name.empty() && say != "file" && !there.running.contains(name) && !is_placed(name)) return;
  if ((say == "file" || say == "left") && !is_placed(frame.text("program"))) return;
  const auto number = [&](const char* key) { return number_in(frame.head, key); };
  if (say == "log") keep_log(frame);
  if (say == "status") events.push_back({Event::Kind::status_line, name, frame.text("line"), {}});
  if (say == "cut_off") events.push_back({Event::Kind::cut_off, name, frame.text("line"), {}});
  if (say == "stopped") there.stopped.insert(name);
  if (say == "collected") there.collected = true;
  if (say == "file" || say == "left") there.files.push_back(frame);
  if (say == "trouble") there.link.lose(frame.text("text"));
  if (say == "use") {
    const Json programs = value_or(frame.head, "programs", Json::object());
    for (const auto& [program, use] : programs.items()) {
      const bool numbers = use.is_array() && use.size() == 2 && use[0].is_number() && use[1].is_number();
      if (numbers) there.use[program] = {use[0].get<double>(), use[1].get<double>()};
    }
  }
  if (say != "exited" && say != "failed") return;
  if (there.running.erase(name) == 0) return;
  ExitStatus exit;
  exit.code = value_or(frame.head, "code", 0).get<int>();
  exit.signal = value_or(frame.head, "signal", 0).get<int>();
  exit.peak_memory_mb = number("peak_memory_mb");
  exit.cpu_s = number("cpu_s");
  if (say == "failed") exit.lost_host = "it cannot be started on " + there.link.name() + ": " + frame.text("text");
  events.push_back({Event::Kind::exited, name, {}, exit});
}

void PlacedFleet::keep_log(const Frame& frame) {
  const auto log = logs_.find(frame.text("name"));
  if (log != logs_.end()) std::ofstream(log->second, std::ios::app | std::ios::binary) << frame.body;
}

void PlacedFleet::send(const std::string& program, const std::string& line) {
  There* const there = of(program);
  if (there == nullptr) return here_.send(program, line);
  there->link.send({{"do", "send"}, {"name", program}, {"line", line}});
}

void PlacedFleet::signal(const std::string& program, int signal) {
  There* const there = of(program);
  if (there == nullptr) return here_.signal(program, signal);
  there->link.send({{"do", "signal"}, {"name", program}, {"signal", signal}});
}

bool PlacedFleet::has_stopped(const std::string& program) {
  There* const there = of(program);
  return there == nullptr ? here_.has_stopped(program) : there->stopped.erase(program) > 0;
}

std::vector<Event> PlacedFleet::end_all(milliseconds grace) {
  for (const auto& there : hosts_) {
    if (!there->running.empty()) there->link.send({{"do", "end"}, {"grace_ms", grace.count()}});
  }
  std::vector<Event> all = here_.end_all(grace);
  const auto deadline = Clock::now() + grace + kSilence;
  while (!running().empty()) {
    for (Event& event : wait(kSpeak)) all.push_back(std::move(event));
    if (Clock::now() < deadline) continue;
    for (const auto& there : hosts_) {
      if (!there->running.empty()) there->link.lose("it does not end its programs");
    }
  }
  return all;
}

std::vector<std::string> PlacedFleet::running() const {
  std::vector<std::string> all = here_.running();
  for (const auto& there : hosts_) all.insert(all.end(), there->running.begin(), there->running.end());
  std::ranges::sort(all);
  return all;
}

bool PlacedFleet::running(const std::string& program) const {
  const There* const there = of(program);
  return there == nullptr ? here_.running(program) : there->running.contains(program);
}

double PlacedFleet::cpu_s(const std::string& process) const {
  const There* const there = of(process);
  if (there == nullptr) return here_.cpu_s(process);
  return there->use.contains(process) ? there->use.at(process).cpu_s : 0.0;
}

double PlacedFleet::memory_share_mb(const std::string& process) const {
  const There* const there = of(process);
  if (there == nullptr) return here_.memory_share_mb(process);
  return there->use.contains(process) ? there->use.at(process).memory_mb : 0.0;
}

// ---- after the flight -------------------------------------------------------------------------------------------

std::vector<std::string> PlacedFleet::collect(const fs::path& out) {
  for (const auto& there : hosts_) there->link.send({{"do", "collect"}});
  const auto missing = [&] {
    return std::ranges::any_of(hosts_, [](const auto& there) { return !there->collected && !there->link.lost(); });
  };
  while (missing()) {
    for (const Event& event : wait(kSpeak)) {
      if (event.kind == Event::Kind::interrupt) return {"the files of programs on other hosts were not collected"};
    }
  }
  std::vector<std::string> left;
  for (const auto& there : hosts_) {
    for (const Frame& frame : there->files) {
      if (frame.text("say") == "file") keep_file(frame, out);
      if (frame.text("say") == "left") left.push_back(frame.text("program") + ": " + frame.text("text"));
    }
    if (there->collected) continue;
    left.push_back("what " + joined(there->programs) + " wrote is lost: " + there->link.why());
  }
  return left;
}

/// Saves a file that a program wrote.
void PlacedFleet::keep_file(const Frame& frame, const fs::path& out) {
  const std::string name = fs::path(frame.text("name")).filename();
  std::ofstream(out / run_folder::collected_file(frame.text("program"), name), std::ios::binary) << frame.body;
}

}  // namespace skein::cli
