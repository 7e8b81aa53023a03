#include "host/supervisor.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <deque>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "host/program_start.hpp"

namespace skein::cli {
namespace {

/// Bytes to read from one program before the others have their turn.
constexpr std::size_t kStatusLook = 64 << 10;
/// [bytes]. A report with the points of the largest scenes is shorter.
constexpr std::size_t kLongestStatusLine = 16 << 20;
/// A line is dropped if the program does not read its control pipe for this long.
constexpr int kSendPatience_ms = 2000;
/// Interval at which the sizes of logs are checked.
constexpr std::chrono::milliseconds kLogLook{200};
constexpr std::size_t kLogTail = 64 << 10, kLongestLogLine = 1000;

/// Under nohup, SIGHUP is ignored and must stay so, because the launcher is to survive the loss of the terminal.
bool is_ignored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

/// A program that writes without end must not fill the disk: of its log, the first half of the limit and the newest
/// lines stay. The program appends, so it continues after the cut; what it writes during the cut may be lost.
void trim_log(int log, std::uint64_t most_bytes) {
  struct stat file {};
  if (log < 0 || ::fstat(log, &file) != 0 || static_cast<std::uint64_t>(file.st_size) <= most_bytes) return;
  std::string end = "\n[skein] the middle of this log was removed, because it has more than " +
                    std::to_string(most_bytes >> 20) + " MiB\n";
  const std::size_t note = end.size();
  end.resize(note + kLogTail);
  const ssize_t tail = ::pread(log, end.data() + note, kLogTail, file.st_size - static_cast<off_t>(kLogTail));
  end.resize(note + static_cast<std::size_t>(std::max<ssize_t>(tail, 0)));
  if (::ftruncate(log, static_cast<off_t>(most_bytes / 2)) == 0) {
    [[maybe_unused]] const ssize_t written = ::write(log, end.data(), end.size());
  }
}

/// The same for a log that only the program has open.
void trim_log(const std::filesystem::path& log, std::uint64_t most_bytes) {
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(log, none);
  if (none || size <= most_bytes) return;
  trim_log(Fd(::open(log.c_str(), O_RDWR | O_APPEND | O_CLOEXEC)).get(), most_bytes);
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

sigset_t interrupt_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM}) sigaddset(&set, signal);
  if (!is_ignored(SIGHUP)) sigaddset(&set, SIGHUP);
  return set;
}

struct Supervisor::Child : StartedProgram {
  explicit Child(const ProgramSpec& spec)
      : StartedProgram(start_program(spec)),
        name(spec.name),
        most_status_bytes(spec.most_status_bytes),
        most_log_bytes(spec.most_log_bytes) {}

  const std::string name;
  const std::uint64_t most_status_bytes, most_log_bytes;
  std::uint64_t status_bytes = 0;
  std::string partial_line;

  /// Takes in what the program wrote to its status pipe; closes the pipe if that was too much.
  void hear(std::string_view text, std::vector<Event>& events) {
    status_bytes += text.size();
    for (std::size_t end; (end = text.find('\n')) != std::string_view::npos; text.remove_prefix(end + 1)) {
      partial_line += text.substr(0, end);
      events.push_back({Event::Kind::status_line, name, std::exchange(partial_line, {}), {}});
    }
    partial_line += text;
    const char* excess = partial_line.size() > kLongestStatusLine ? "too long a line"
                         : status_bytes > most_status_bytes       ? "more than the reports of a run need"
                                                                  : nullptr;
    if (excess == nullptr) return;
    status.reset();
    partial_line = {};
    events.push_back({Event::Kind::cut_off, name, std::string("it wrote ") + excess + " on its status pipe", {}});
  }
};

std::string ExitStatus::text() const {
  if (!lost_host.empty()) return lost_host;
  if (signal != 0) return "signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")";
  return "exit code " + std::to_string(code);
}

Supervisor::Supervisor() {
  const sigset_t set = interrupt_signals();
  if (::sigprocmask(SIG_BLOCK, &set, &former_mask_) != 0) throw_errno("sigprocmask");
  signal_fd_ = ::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
  if (signal_fd_ < 0) throw_errno("signalfd");
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  ::sigaction(SIGPIPE, &ignore, &former_pipe_action_);
}

Supervisor::~Supervisor() {
  for (const auto& [name, child] : children_) {
    signal_program(*child, SIGKILL);
    ::waitpid(child->pid, nullptr, 0);
    take_terminal_back(*child);
  }
  ::close(signal_fd_);
  ::sigaction(SIGPIPE, &former_pipe_action_, nullptr);
  ::sigprocmask(SIG_SETMASK, &former_mask_, nullptr);
}

void Supervisor::start(const ProgramSpec& spec) { children_[spec.name] = std::make_unique<Child>(spec); }

std::vector<Event> Supervisor::wait(std::chrono::milliseconds limit) {
  std::vector<pollfd> polled = {{signal_fd_, POLLIN, 0}};
  std::vector<Child*> order;
  for (const auto& [name, child] : children_) {
    order.push_back(child.get());
    polled.push_back({child->status.get(), POLLIN, 0});
    polled.push_back({child->pidfd.get(), POLLIN, 0});
  }
  for (const int descriptor : also_watched_) polled.push_back({descriptor, POLLIN, 0});
  std::vector<Event> events;
  if (poll_and_trim(polled, limit) <= 0) return events;
  signalfd_siginfo info;
  while (::read(signal_fd_, &info, sizeof info) == sizeof info) events.push_back({Event::Kind::interrupt, {}, {}, {}});
  const auto ended = [&](std::size_t i) { return polled[2 + 2 * i].revents != 0; };
  bool any_ended = false;
  for (std::size_t i = 0; i < order.size(); ++i) any_ended = any_ended || ended(i);
  // If one program has ended, reads from all: another one may have written the reason after poll() looked at it.
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (any_ended || polled[1 + 2 * i].revents != 0) read_status(*order[i], kStatusLook, events);
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (ended(i)) reap(*order[i], events);
  }
  return events;
}

void Supervisor::trim_logs() const {
  for (const auto& [name, child] : children_) trim_log(child->log.get(), child->most_log_bytes);
  for (const auto& [log, most_bytes] : also_limited_) trim_log(log, most_bytes);
}

int Supervisor::poll_and_trim(std::vector<pollfd>& polled, std::chrono::milliseconds limit) const {
  while (true) {
    const bool last = limit.count() >= 0 && limit <= kLogLook;
    const int ready = ::poll(polled.data(), polled.size(), static_cast<int>((last ? limit : kLogLook).count()));
    trim_logs();
    if (ready != 0 || last) return ready;
    if (limit.count() >= 0) limit -= kLogLook;
  }
}

void Supervisor::read_status(Child& child, std::size_t most, std::vector<Event>& events) {
  std::array<char, 4096> buffer;
  for (std::size_t taken = 0; child.status.get() >= 0 && taken < most;) {
    const ssize_t n = ::read(child.status.get(), buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return;                 // nothing more for now
    if (n == 0) child.status.reset();  // poll ignores a negative descriptor from here on
    taken += static_cast<std::size_t>(n);
    child.hear({buffer.data(), static_cast<std::size_t>(n)}, events);
  }
}

void Supervisor::reap(Child& child, std::vector<Event>& events) {
  // First kills the rest of its process group: until the zombie is reaped, no other group can have this number. A
  // minder has already killed its descendants.
  ::kill(-child.pid, SIGKILL);
  // Reads no more than the pipe can hold: a process that has left the group may still write.
  const int left = child.status.get() < 0 ? 0 : ::fcntl(child.status.get(), F_GETPIPE_SZ);
  read_status(child, static_cast<std::size_t>(std::max(left, 0)), events);
  trim_logs();
  int status = 0;
  rusage usage{};
  if (::wait4(child.pid, &status, 0, &usage) != child.pid) throw_errno("wait4");
  ExitStatus exit;
  if (WIFEXITED(status)) exit.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) exit.signal = WTERMSIG(status);
  exit.pid = child.program;
  exit.peak_memory_mb = static_cast<double>(usage.ru_maxrss) / 1024.0;
  exit.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  take_terminal_back(child);
  events.push_back({Event::Kind::exited, child.name, {}, exit});
  children_.erase(events.back().program);
}

double Supervisor::cpu_s(const std::string& program) const {
  const auto found = children_.find(program);
  clockid_t clock{};
  timespec time{};
  if (found == children_.end() || ::clock_getcpuclockid(found->second->program, &clock) != 0 ||
      ::clock_gettime(clock, &time) != 0) {
    return 0.0;
  }
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double Supervisor::memory_share_mb(const std::string& program) const {
  const auto found = children_.find(program);
  if (found == children_.end()) return 0.0;
  std::ifstream in("/proc/" + std::to_string(found->second->program) + "/smaps_rollup");
  double kilobytes = 0.0;
  for (std::string word; in >> word;) {
    if (word == "Pss:" && in >> kilobytes) break;
  }
  return kilobytes / 1024.0;
}

void Supervisor::send(const std::string& program, const std::string& line) {
  const auto found = children_.find(program);
  if (found == children_.end()) return;
  const std::string text = line + "\n";
  std::string_view left = text;
  while (!left.empty()) {
    const ssize_t written = ::write(found->second->control.get(), left.data(), left.size());
    if (written > 0) left.remove_prefix(static_cast<std::size_t>(written));
    if (written > 0 || errno == EINTR) continue;
    pollfd waiting{found->second->control.get(), POLLOUT, 0};
    if (errno != EAGAIN || ::poll(&waiting, 1, kSendPatience_ms) <= 0) return;
  }
}

void Supervisor::hang_up(const std::string& program) {
  const auto found = children_.find(program);
  if (found != children_.end()) found->second->control.reset();
}

void Supervisor::signal(const std::string& program, int signal) {
  const auto found = children_.find(program);
  if (found != children_.end()) signal_program(*found->second, signal);
}

bool Supervisor::has_stopped(const std::string& program) {
  const auto found = children_.find(program);
  siginfo_t info{};
  return found != children_.end() &&
         ::waitid(P_PID, static_cast<id_t>(found->second->pid), &info, WSTOPPED | WNOHANG) == 0 && info.si_pid != 0;
}

void Supervisor::take_terminal_back(const Child& child) {
  if (child.foreground) give_terminal_to(::getpgrp());
}

void Supervisor::follow_job_control() {
  for (const auto& [name, child] : children_) {
    if (!child->foreground || !has_stopped(name)) continue;
    take_terminal_back(*child);
    ::raise(SIGSTOP);  // until the shell's `fg`
    if (owns_terminal()) give_terminal_to(child->program);
    signal_program(*child, SIGCONT);
  }
}

void Supervisor::signal_all(int signal) {
  for (const auto& [name, child] : children_) signal_program(*child, signal);
}

std::vector<Event> Supervisor::end_all(std::chrono::milliseconds grace) {
  using Clock = std::chrono::steady_clock;
  std::vector<Event> all;
  signal_all(SIGTERM);
  signal_all(SIGCONT);  // a stopped program cannot hear SIGTERM
  const Clock::time_point deadline = Clock::now() + grace;
  bool killed = false;
  while (!children_.empty()) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
    bool kill_now = left.count() <= 0;
    // After SIGKILL the end is certain: wait for it without a limit.
    for (Event& event : wait(killed ? std::chrono::milliseconds(-1) : std::max(left, std::chrono::milliseconds(0)))) {
      kill_now = kill_now || event.kind == Event::Kind::interrupt;
      all.push_back(std::move(event));
    }
    if (kill_now && !killed) {
      signal_all(SIGKILL);
      killed = true;
    }
  }
  return all;
}

std::vector<std::string> Supervisor::running() const {
  std::vector<std::string> names;
  for (const auto& [name, child] : children_) names.push_back(name);
  return names;
}

std::vector<std::string> last_lines(const std::filesystem::path& file, std::size_t count) {
  std::ifstream in(file, std::ios::ate);
  const std::streamoff size = in.tellg(),
                       skipped = std::max<std::streamoff>(size - static_cast<std::streamoff>(kLogTail), 0);
  in.seekg(skipped);
  std::deque<std::string> tail;
  bool cut = skipped > 0;  // the beginning of the first line is missing
  for (std::string line; std::getline(in, line); cut = false) {
    if (cut && !in.eof()) {
      if (in.peek() != std::ifstream::traits_type::eof()) continue;
      line = "... " + line.substr(line.size() - std::min(line.size(), kLongestLogLine));  // the file has no other line
    }
    if (line.size() > kLongestLogLine && !line.starts_with("... ")) line = line.substr(0, kLongestLogLine) + " ...";
    tail.push_back(line);
    if (tail.size() > count) tail.pop_front();
  }
  return {tail.begin(), tail.end()};
}

std::string last_lines_below(const std::filesystem::path& file, std::size_t count) {
  std::string text;
  for (const std::string& line : last_lines(file, count)) text += "\n    " + line;
  return text;
}

}  // namespace skein::cli
