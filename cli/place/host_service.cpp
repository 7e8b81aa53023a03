#include "cli/place/host_service.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <poll.h>
#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <system_error>

#include "cli/place/frames.hpp"
#include "cli/secure/user_ids.hpp"
#include "core/config/config_files.hpp"
#include "core/files/file_bytes.hpp"
#include "core/text/sha256.hpp"
#include "core/text/text.hpp"
#include "host/domain_block.hpp"
#include "host/preflight.hpp"
#include "host/supervisor.hpp"
#include "process/host/environment.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_plan.hpp"
#include "run/open_files.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kTick{50}, kGrace{1000};
/// Timeout for the launcher's first frame. A launcher with many hosts first connects to all of them.
constexpr milliseconds kFirstFrame{60000};
constexpr std::size_t kMostOfALog = 256 << 10;  // bytes in one frame

std::string user_name() {
  const passwd* user = ::getpwuid(::geteuid());
  return user == nullptr ? "uid " + std::to_string(::geteuid()) : user->pw_name;
}

/// The addresses of the launcher and of this host, as ssh or Slurm report them; empty: unknown.
std::pair<std::string, std::string> addresses() {
  if (const char* connection = std::getenv("SSH_CONNECTION")) {
    const std::vector<std::string> words = split(connection, ' ');
    if (words.size() == 4) return {words[0], words[2]};
  }
  const char* launcher = std::getenv("SLURM_LAUNCH_NODE_IPADDR");
  return {launcher == nullptr ? "" : launcher, ""};
}

class HostService {
 public:
  HostService() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO}) {
      ::fcntl(stream, F_SETFL, ::fcntl(stream, F_GETFL) | O_NONBLOCK);
    }
    supervisor_.watch_too({STDIN_FILENO});
    fs::create_directories(out());
    // Agents that run under user ids of their own must be able to enter this folder, which contains theirs.
    fs::permissions(scratch_.path(), fs::perms::others_exec | fs::perms::group_exec, fs::perm_options::add);
  }

  int serve() {
    unsent_ = std::string(kHostGreeting) + "\n";
    greet();
    while (!over_) {
      for (const Event& event : supervisor_.wait(kTick)) tell(event);
      listen();
      tell_news();
      if (domains_) domains_->forget_visitors();
      flush(milliseconds(0));
      over_ = over_ || Clock::now() - heard_ > (has_heard_ ? kSilence : kFirstFrame);
    }
    supervisor_.end_all(kGrace);
    return kExitDone;
  }

 private:
  fs::path out() const { return scratch_.path() / "out"; }

  void greet() {
    const auto [launcher, own] = addresses();
    say({{"say", "hello"},
         {"version", SKEIN_VERSION},
         {"build", build_digest(program_dir())},
         {"machine", machine_identity()},
         {"bin", program_dir().string()},
         {"config", fs::absolute(default_config_dir()).lexically_normal().string()},
         {"root", scratch_.path().string()},
         {"user", user_name()},
         {"is_root", ::geteuid() == 0},
         {"launcher_address", launcher},
         {"address", own}});
  }

  // ---- frames from the launcher --------------------------------------------------------------------------------

  void listen() {
    std::array<char, 65536> buffer;
    for (int i = 0; i < 64; ++i) {
      const ssize_t n = ::read(STDIN_FILENO, buffer.data(), buffer.size());
      if (n < 0 && errno == EINTR) continue;
      if (n == 0) over_ = true;
      if (n <= 0) break;
      heard_ = Clock::now();
      has_heard_ = true;
      reader_.add({buffer.data(), static_cast<std::size_t>(n)});
    }
    try {
      while (const auto frame = reader_.next()) obey(*frame);
    } catch (const std::exception& error) {
      say({{"say", "trouble"}, {"text", error.what()}});
    }
  }

  void obey(const Frame& frame) {
    const std::string what = frame.text("do"), name = frame.text("name");
    if (what == "domains") take_domains(frame.head);
    if (what == "file") write(frame);
    if (what == "start") start(frame.head);
    if (what == "send") supervisor_.send(name, frame.text("line"));
    if (what == "signal") supervisor_.signal(name, value_or(frame.head, "signal", 0).get<int>());
    if (what == "end") end(milliseconds(value_or(frame.head, "grace_ms", 0).get<int>()));
    if (what == "collect") collect();
  }

  void take_domains(const Json& head) {
    domains_.reset();
    const int size = value_or(head, "size", 0).get<int>();
    domain_count_ = static_cast<std::uint64_t>(std::max(size, 0));
    raise_open_files_limit(open_files_of_watcher(1, domain_count_));
    std::string taken;
    try {
      domains_.emplace(value_or(head, "base", 0).get<int>(), size);
    } catch (const InputError& error) {
      taken = error.what();
    }
    say({{"say", "domains"}, {"taken", taken}});
  }

  /// A path that the launcher chose. @throws std::runtime_error if it is not below this process's folder.
  fs::path below_root(const std::string& text) const {
    const fs::path path = fs::path(text).lexically_normal();
    const fs::path below = path.lexically_relative(scratch_.path());
    if (below.empty() || *below.begin() == "..") throw std::runtime_error(text + " is not below this host's folder");
    return path;
  }

  void write(const Frame& frame) {
    const fs::path file = below_root(frame.text("path"));
    fs::create_directories(file.parent_path());
    fs::remove(file);
    const auto mode = static_cast<fs::perms>(value_or(frame.head, "mode", 0).get<int>());
    std::ofstream made(file, std::ios::binary);
    fs::permissions(file, mode);
    if (!(made << frame.body << std::flush)) throw std::runtime_error(file.string() + " cannot be written");
  }

  void start(const Json& head) {
    ProgramSpec spec;
    spec.name = text_in(head, "name");
    spec.argv = value_or(head, "argv", Json::array()).get<std::vector<std::string>>();
    spec.env = fleet_environment(value_or(head, "native", false).get<bool>(),
                                 value_or(head, "variables", Json::object()).get<std::map<std::string, std::string>>());
    spec.log = scratch_.path() / "logs" / run_folder::log_file(spec.name);
    spec.append_log = value_or(head, "append_log", false).get<bool>();
    spec.minded = value_or(head, "minded", false).get<bool>();
    fs::create_directories(spec.log.parent_path());
    fs::create_directories(own_out(spec.name));
    const fs::path keys = text_in(head, "keys");
    if (!keys.empty() && ::geteuid() == 0) spec.user = own_user(spec.name, keys);
    if (!spec.append_log) shipped_[spec.name] = 0;
    // The limit of a login may be lower than that of the launcher. The programs raise theirs themselves.
    raise_open_files_limit(open_files_of_watcher(logs_.size() + 1, domain_count_));
    try {
      supervisor_.start(spec);
      logs_[spec.name] = spec.log;
    } catch (const std::system_error& error) {
      say({{"say", "failed"}, {"name", spec.name}, {"text", error.what() + open_files_hint(error.code())}});
    } catch (const std::exception& error) {
      say({{"say", "failed"}, {"name", spec.name}, {"text", error.what()}});
    }
  }

  /// The user id of an agent in a secured run. Only this user can read the agent's keys and write to its folder.
  UserId own_user(const std::string& program, const fs::path& keys) {
    auto& user = users_[program];
    if (!user) user = std::make_unique<UserIds>(1);
    const UserId id = user->at(0);
    for (const fs::path& folder : {below_root(keys), own_out(program)}) {
      fs::permissions(folder, fs::perms::owner_all);
      for (const auto& entry : fs::directory_iterator(folder)) give(entry.path(), id);
      give(folder, id);
    }
    return id;
  }
  static void give(const fs::path& path, UserId id) {
    if (::lchown(path.c_str(), id.uid, id.gid) != 0) throw std::system_error(errno, std::generic_category(), path);
  }
  fs::path own_out(const std::string& program) const { return out() / program; }

  void end(milliseconds grace) {
    for (const Event& event : supervisor_.end_all(grace)) tell(event);
  }

  /// Sends the regular files that programs wrote to their folders, one frame for each.
  void collect() {
    tell_news();
    for (const auto& folder : fs::directory_iterator(out())) {
      if (!fs::is_directory(folder.symlink_status())) continue;
      for (const auto& entry : fs::directory_iterator(folder.path())) {
        if (!fs::is_regular_file(entry.symlink_status()) || fs::hard_link_count(entry.path()) != 1) continue;
        try {
          say({{"say", "file"},
               {"program", folder.path().filename().string()},
               {"name", entry.path().filename().string()}},
              read_file_bytes(entry.path(), kLargestPlacedFile));
        } catch (const std::exception& error) {
          say({{"say", "left"}, {"program", folder.path().filename().string()}, {"text", error.what()}});
        }
        flush(kSilence);
      }
    }
    say({{"say", "collected"}});
  }

  // ---- frames to the launcher ----------------------------------------------------------------------------------

  void say(const Json& head, std::string_view body = {}) { unsent_ += bytes_of(head, body); }

  void tell(const Event& event) {
    if (event.kind == Event::Kind::interrupt) over_ = true;
    if (event.kind == Event::Kind::status_line) {
      say({{"say", "status"}, {"name", event.program}, {"line", event.line}});
    }
    if (event.kind == Event::Kind::cut_off) say({{"say", "cut_off"}, {"name", event.program}, {"line", event.line}});
    if (event.kind != Event::Kind::exited) return;
    ship_log(event.program);
    say({{"say", "exited"},
         {"name", event.program},
         {"code", event.exit.code},
         {"signal", event.exit.signal},
         {"peak_memory_mb", event.exit.peak_memory_mb},
         {"cpu_s", event.exit.cpu_s},
         {"pid", event.exit.pid}});
  }

  void tell_news() {
    for (const std::string& program : supervisor_.running()) {
      if (supervisor_.has_stopped(program)) say({{"say", "stopped"}, {"name", program}});
    }
    for (const auto& [program, log] : logs_) ship_log(program);
    if (Clock::now() - told_use_ < kSpeak) return;
    told_use_ = Clock::now();
    Json use = Json::object();
    for (const std::string& program : supervisor_.running()) {
      use[program] = {supervisor_.cpu_s(program), supervisor_.memory_share_mb(program)};
    }
    say({{"say", use.empty() ? "alive" : "use"}, {"programs", use}});
  }

  /// Sends what a program has appended to its log. After the log was trimmed, continues at its new end.
  void ship_log(const std::string& program) {
    const auto log = logs_.find(program);
    if (log == logs_.end()) return;
    std::ifstream in(log->second, std::ios::binary | std::ios::ate);
    const auto size = static_cast<std::uintmax_t>(std::max<std::streamoff>(in.tellg(), 0));
    std::uintmax_t& shipped = shipped_[program];
    if (size < shipped) shipped = size;
    while (shipped < size) {
      std::string part(std::min<std::uintmax_t>(size - shipped, kMostOfALog), '\0');
      in.seekg(static_cast<std::streamoff>(shipped));
      if (!in.read(part.data(), static_cast<std::streamsize>(part.size()))) return;
      shipped += part.size();
      say({{"say", "log"}, {"name", program}}, part);
    }
  }

  /// Sends frames. Stops when the launcher has not read for `patience`; the rest is sent later.
  void flush(milliseconds patience) {
    std::size_t sent = 0;
    while (sent < unsent_.size()) {
      const ssize_t n = ::write(STDOUT_FILENO, unsent_.data() + sent, unsent_.size() - sent);
      if (n > 0) sent += static_cast<std::size_t>(n);
      if (n > 0 || errno == EINTR) continue;
      pollfd writable{STDOUT_FILENO, POLLOUT, 0};
      if (errno == EAGAIN && ::poll(&writable, 1, static_cast<int>(patience.count())) > 0) continue;
      if (errno != EAGAIN) over_ = true;
      break;
    }
    unsent_.erase(0, sent);
  }

  ScratchDir scratch_;
  std::map<std::string, std::unique_ptr<UserIds>> users_;  ///< of agents in a secured run, if this process is root
  Supervisor supervisor_;
  std::optional<DomainBlock> domains_;
  std::uint64_t domain_count_ = 0;
  FrameReader reader_{true};
  std::string unsent_;
  std::map<std::string, fs::path> logs_;
  std::map<std::string, std::uintmax_t> shipped_;  ///< bytes sent of each log
  Clock::time_point heard_ = Clock::now(), told_use_ = Clock::now();
  bool has_heard_ = false, over_ = false;
};

}  // namespace

std::string build_digest(const fs::path& bin_dir) {
  Sha256 hash;
  for (const char* name : {"skein", programs::kAgent}) hash.add(read_file_bytes(bin_dir / name, kLargestPlacedFile));
  return hash.hex();
}

std::string machine_identity() {
  std::ifstream in("/proc/sys/kernel/random/boot_id");
  std::string boot;
  std::getline(in, boot);
  std::error_code error;
  return boot + " " + fs::read_symlink("/proc/self/ns/net", error).string();
}

int serve_host() { return HostService().serve(); }

}  // namespace skein::cli
