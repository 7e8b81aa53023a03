#include "one_process/session.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "core/files/write_whole.hpp"
#include "core/text/number_checks.hpp"
#include "one_process/death_notice.hpp"
#include "process/health/crash_notes.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "sim_server/server_program.hpp"

namespace skein::one_process {
namespace {

/// The descriptors for a copy, in their order in a message.
enum File : std::size_t { kSocketFile, kBlockFile, kLogFile, kFiles };

/// The programs' output is kept to explain failures, for which its newest part is enough: a longer log is emptied.
constexpr off_t kLongestLog = 4 << 20;      ///< bytes
constexpr std::uint64_t kLookAtLog = 1024;  ///< answers from one check of the log's length to the next

[[noreturn]] void throw_errno(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

/// @param at  address of the block; null: any.
std::byte* map_block(int file, std::size_t bytes, std::byte* at = nullptr) {
  void* const block = ::mmap(at, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | (at != nullptr ? MAP_FIXED : 0), file, 0);
  if (block == MAP_FAILED) throw_errno("mmap");
  return static_cast<std::byte*>(block);
}

void write_to_file(int file, const std::string& text) {
  if (!write_whole(file, text)) throw_errno("write");
}

void close_all(const std::vector<int>& files) {
  for (const int file : files) ::close(file);
}

nlohmann::json layout_json(const BlockLayout& layout) {
  nlohmann::json fields = nlohmann::json::array();
  for (const BlockField& field : layout.fields()) {
    fields.push_back({field.name, field.type, field.shape, field.offset});
  }
  return fields;
}

}  // namespace

SessionPlan read_session_plan(const std::filesystem::path& file) {
  std::ifstream in(file);
  const nlohmann::json json = nlohmann::json::parse(in);
  SessionPlan plan;
  plan.about = json.at("about");
  json.at("uavs").get_to(plan.uavs);
  for (const nlohmann::json& program : json.at("programs")) {
    plan.programs.push_back({program.at("program"), program.at("argv"), "", false});
  }
  return plan;
}

Session::Session(SessionPlan plan, int socket, double patience_s)
    : plan_(std::move(plan)), socket_(socket), guard_(patience_s) {
  ::prctl(PR_SET_PDEATHSIG, 0);        // no signal when the starting thread ends, which may be before the fleet's end
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);  // adopts copies whose parent has ended
  std::signal(SIGCHLD, SIG_IGN);       // no process waits for copies
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  DeathNotice::watch(socket);
  guard_.watch(socket);
}

Session::~Session() = default;

/// Loads the scene in advance, so that copies need not load it.
void Session::load_scene() {
  const auto server = std::ranges::find(plan_.programs, programs::kSimServer, &shared_lines::Start::program);
  if (server == plan_.programs.end()) throw std::runtime_error("there is no sim_server in the plan");
  std::vector<const char*> argv;
  for (const std::string& word : server->argv) argv.push_back(word.c_str());
  sim::ServerProgram program;
  const auto options = parse_program(programs::kSimServer, static_cast<int>(argv.size()), argv.data(),
                                     [&](CLI::App& app) { program.add_options(app); });
  if (const auto* parsed = std::get_if<ProgramOptions>(&options)) shelf_->put(sim::ServerProgram::load_ahead(*parsed));
}

int Session::serve() {
  try {
    load_scene();
    hello();
  } catch (const std::exception& error) {
    fail({"", 0, 0, error.what()});
    throw;  // run_session() prints the error, and its kind decides the exit code
  }
  try {
    while (const auto message = socket_.receive()) answer(*message);
  } catch (const FleetFailed& failed) {
    fail(failed);
    return kExitProcessFailed;
  } catch (const std::exception& error) {
    fail({"", 0, 0, error.what()});
    return kExitProcessFailed;
  }
  return kExitDone;
}

void Session::answer(const SessionMessage& message) {
  if (++answers_ % kLookAtLog == 0) cut_log();
  if (message.text.starts_with("s ")) {
    std::uint64_t steps = 0;
    std::from_chars(message.text.data() + 2, message.text.data() + message.text.size(), steps);
    if (steps == 0 || !fleet_ || fleet_->over()) throw std::logic_error("there is nothing to step");
    fleet_->step(steps);
    return socket_.send(fleet_->over() ? "e" : "k");
  }
  const nlohmann::json order = nlohmann::json::parse(message.text);
  const std::string what = order.at("do");
  if (what == "reset" || what == "fork") {
    if (copy(message)) return socket_.send("k");
    if (what == "reset") begin(order.at("seed"));
    return hello();
  }
  if (what != "result" && what != "scene") {
    throw std::logic_error("there is no order \"" + what + "\"; the orders are reset, fork, result and scene");
  }
  if (!fleet_ || message.files.empty()) throw std::logic_error("there is no fleet, or no file for the answer");
  write_to_file(message.files[0], (what == "scene" ? fleet_->scene() : fleet_->result()).dump());
  close_all(message.files);
  socket_.send("k");
}

bool Session::copy(const SessionMessage& message) {
  if (message.files.size() != kFiles)
    throw std::logic_error("a copy needs a socket, a memory block and a log of its own");
  // Copies the block before fork(), since afterwards the parent may change its own.
  if (fleet_) {
    const std::size_t bytes = fleet_->layout().bytes();
    if (::ftruncate(message.files[kBlockFile], static_cast<off_t>(bytes)) != 0) throw_errno("ftruncate");
    std::byte* const theirs = map_block(message.files[kBlockFile], bytes);
    std::memcpy(theirs, block_, bytes);
    ::munmap(theirs, bytes);
  }
  std::fflush(stdout);
  const pid_t pid = ::fork();
  if (pid < 0) throw_errno("fork");
  if (pid > 0) {
    close_all(message.files);
    return true;
  }
  socket_.become(message.files[kSocketFile]);
  ::dup2(message.files[kLogFile], STDOUT_FILENO);
  ::dup2(message.files[kLogFile], STDERR_FILENO);
  ::close(message.files[kLogFile]);
  block_fd_ = message.files[kBlockFile];
  if (fleet_) {
    map_block(block_fd_, fleet_->layout().bytes(), block_);  // at the address that the fleet uses
    ::close(std::exchange(block_fd_, -1));
  }
  guard_.watch(socket_.descriptor());  // timers are not copied
  return false;
}

void Session::begin(std::uint64_t seed) {
  fleet_ = std::make_unique<SteppedFleet>(plan_.programs, plan_.uavs, seed, shelf_);
  guard_.look_after(fleet_.get());
  const std::size_t bytes = fleet_->layout().bytes();
  if (::ftruncate(block_fd_, static_cast<off_t>(bytes)) != 0) throw_errno("ftruncate");
  block_ = map_block(block_fd_, bytes);
  ::close(std::exchange(block_fd_, -1));
  fleet_->begin(block_);
}

/// Tells the program that steps the fleet that this process is ready, and describes its memory block.
void Session::hello() {
  if (!fleet_) return socket_.send(nlohmann::json({{"pid", ::getpid()}, {"about", plan_.about}}).dump());
  const BlockLayout& layout = fleet_->layout();
  const nlohmann::json hello = {{"pid", ::getpid()}, {"bytes", layout.bytes()}, {"fields", layout_json(layout)}};
  socket_.send(hello.dump());
}

void Session::fail(const FleetFailed& failed) {
  std::fflush(stdout);
  socket_.send(
      nlohmann::json(
          {{"failed", failed.why}, {"program", failed.program}, {"code", failed.code}, {"signal", failed.signal}})
          .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

void Session::cut_log() const {
  if (::lseek(STDERR_FILENO, 0, SEEK_END) <= kLongestLog || ::ftruncate(STDERR_FILENO, 0) != 0) return;
  ::lseek(STDERR_FILENO, 0, SEEK_SET);  // otherwise the next line would follow zeros as long as the old log
}

int run_session(int argc, const char* const* argv) {
  int socket = -1;
  double patience_s = 60.0;
  std::string plan;
  const auto add_options = [&](CLI::App& app) {
    app.description("Skein: process of a fleet that an external program steps");
    app.add_option("--session", socket, "Descriptor of the socket to the program that steps the fleet")
        ->group("Launcher");
    app.add_option("--plan", plan, "File in which the launcher describes the fleet")->group("Launcher");
    app.add_option("--agent-timeout", patience_s, "Wall time that a program may take for one step [s], 0: no limit")
        ->check(CLI::Validator(check_timeout_or_none, ""));
  };
  const auto options = parse_program(programs::kOneProcess, argc, argv, add_options);
  if (const int* code = std::get_if<int>(&options)) return *code;
  note_crashes("/");  // no core dumps
  return guarded(programs::kOneProcess, [&] { return Session(read_session_plan(plan), socket, patience_s).serve(); });
}

}  // namespace skein::one_process
