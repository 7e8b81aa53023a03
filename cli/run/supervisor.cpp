#include "cli/run/supervisor.hpp"

#include <fcntl.h>
#include <grp.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
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

#include "cli/run/minder.hpp"

extern "C" {  // glibc 2.36's header forgets it
#include <sys/pidfd.h>
}

namespace skein::cli {
namespace {

/// Read from one program before the others have their turn.
constexpr std::size_t kStatusLook = 64 << 10;
/// A report with the points of the largest scenes is shorter.
constexpr std::size_t kLongestStatusLine = 16 << 20;
constexpr std::size_t kLogTail = 64 << 10, kLongestLogLine = 1000;

[[noreturn]] void throw_errno(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// A file descriptor that closes itself.
class Fd {
 public:
  Fd() = default;
  explicit Fd(int fd) : fd_(fd) {}
  Fd(Fd&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Fd& operator=(Fd&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Fd() { reset(); }
  int get() const { return fd_; }
  void reset() {
    if (fd_ >= 0) ::close(std::exchange(fd_, -1));
  }

 private:
  int fd_ = -1;
};

struct Pipe {
  Fd read, write;
};

/// Both ends are above the numbers that a child's descriptors get, so that dup2 never overwrites one of them.
Pipe make_pipe() {
  int fds[2];
  if (::pipe2(fds, O_CLOEXEC) != 0) throw_errno("pipe");
  Fd low_read(fds[0]), low_write(fds[1]);
  Pipe pipe{Fd(::fcntl(fds[0], F_DUPFD_CLOEXEC, kControlFd + 1)), Fd(::fcntl(fds[1], F_DUPFD_CLOEXEC, kControlFd + 1))};
  if (pipe.read.get() < 0 || pipe.write.get() < 0) throw_errno("pipe");
  return pipe;
}

Fd open_high(const std::filesystem::path& file, int flags) {
  const Fd low(::open(file.c_str(), flags | O_CLOEXEC, 0644));
  if (low.get() < 0) throw_errno(file.string());
  Fd high(::fcntl(low.get(), F_DUPFD_CLOEXEC, kControlFd + 1));
  if (high.get() < 0) throw_errno(file.string());
  return high;
}

/// Whoever starts us with nohup wants us to live on without the terminal.
bool is_ignored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

sigset_t interrupt_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM}) sigaddset(&set, signal);
  if (!is_ignored(SIGHUP)) sigaddset(&set, SIGHUP);
  return set;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

std::vector<char*> pointers(const std::vector<std::string>& strings) {
  std::vector<char*> result;
  for (const std::string& s : strings) result.push_back(const_cast<char*>(s.c_str()));
  result.push_back(nullptr);
  return result;
}

/// What the child does between fork and exec: only calls that are safe there. Writes its process id to `news`, then, when it
/// cannot go on, errno.
struct ChildSetup {
  pid_t parent;                           ///< the launcher, or the program's minder
  int input, log, status, control, news;  ///< log: -1 keeps the launcher's
  char* const* argv;
  char* const* env;
  const UserId* user;  ///< null: the launcher's

  [[noreturn]] void exec() const {
    ::setpgid(0, 0);
    tell(::getpid());
    bool ready =
        user == nullptr || (::setgroups(0, nullptr) == 0 && ::setgid(user->gid) == 0 && ::setuid(user->uid) == 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);       // after setuid, which would undo it
    if (::getppid() != parent) ::_exit(127);  // it died before prctl could tell
    sigset_t none;
    sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    for (int signal = 1; signal < SIGRTMIN; ++signal) ::signal(signal, SIG_DFL);  // what our shell ignored, too
    const std::array<std::pair<int, int>, 5> files = {
        {{input, 0}, {log, 1}, {log, 2}, {status, kStatusFd}, {control, kControlFd}}};
    for (const auto& [from, to] : files) ready = ready && (from < 0 || ::dup2(from, to) >= 0);
    if (ready) ::execve(argv[0], argv, env);
    tell(errno);
    ::_exit(127);
  }

  void tell(int number) const { [[maybe_unused]] const ssize_t written = ::write(news, &number, sizeof number); }
};

/// The same with a minder in between.
[[noreturn]] void exec_minded(ChildSetup setup) {
  ::setpgid(0, 0);
  const pid_t launcher = std::exchange(setup.parent, ::getpid());
  if (!become_minder(launcher)) ::_exit(127);
  const pid_t program = ::fork();
  if (program == 0) setup.exec();
  if (program > 0) mind(program, launcher);
  setup.tell(0);  // no process, and why
  setup.tell(errno);
  ::_exit(127);
}

/// What a child told; nullopt when it said no more.
std::optional<int> next_news(const Fd& from) {
  int number = 0;
  ssize_t size = 0;
  do {
    size = ::read(from.get(), &number, sizeof number);
  } while (size < 0 && errno == EINTR);
  return size == sizeof number ? std::optional(number) : std::nullopt;
}

}  // namespace

struct Supervisor::Child {
  std::string name;
  pid_t pid = -1;      ///< our child: the program, or its minder
  pid_t program = -1;  ///< leads a process group
  Fd pidfd, status, control;
  std::uint64_t most_status_bytes = 0, status_bytes = 0;
  std::string partial_line;

  /// Takes in what the program wrote; closes the pipe when it was too much.
  void hear(std::string_view text, std::vector<Event>& events) {
    status_bytes += text.size();
    for (std::size_t end; (end = text.find('\n')) != std::string_view::npos; text.remove_prefix(end + 1)) {
      partial_line += text.substr(0, end);
      events.push_back({Event::Kind::status_line, name, std::exchange(partial_line, {}), {}});
    }
    partial_line += text;
    const char* excess = partial_line.size() > kLongestStatusLine ? "a line without an end"
                         : status_bytes > most_status_bytes       ? "more than a report and its news"
                                                                  : nullptr;
    if (excess == nullptr) return;
    status.reset();
    partial_line = {};
    events.push_back({Event::Kind::cut_off, name, std::string("it wrote ") + excess + " on its status pipe", {}});
  }
};

std::string ExitStatus::text() const {
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
    ::kill(-child->program, SIGKILL);
    ::waitpid(child->pid, nullptr, 0);
  }
  ::close(signal_fd_);
  ::sigaction(SIGPIPE, &former_pipe_action_, nullptr);
  ::sigprocmask(SIG_SETMASK, &former_mask_, nullptr);
}

void Supervisor::start(const ProgramSpec& spec) {
  const Fd log =
      spec.log.empty() ? Fd() : open_high(spec.log, O_WRONLY | O_CREAT | (spec.append_log ? O_APPEND : O_TRUNC));
  const Fd input = open_high("/dev/null", O_RDONLY);
  Pipe status = make_pipe(), control = make_pipe(), news = make_pipe();
  const std::vector<char*> argv = pointers(spec.argv), env = pointers(spec.env);
  const ChildSetup setup{::getpid(),         input.get(),        log.get(),
                         status.write.get(), control.read.get(), news.write.get(),
                         argv.data(),        env.data(),         spec.user ? &*spec.user : nullptr};
  const pid_t pid = ::fork();
  if (pid < 0) throw_errno("fork");
  if (pid == 0) spec.minded ? exec_minded(setup) : setup.exec();
  news.write.reset();
  const pid_t program = next_news(news.read).value_or(0);
  const std::optional<int> error = next_news(news.read);
  if (program == 0 || error) {
    ::waitpid(pid, nullptr, 0);
    throw std::system_error(error.value_or(ECHILD), std::generic_category(), "cannot start " + spec.argv[0]);
  }
  auto child = std::make_unique<Child>();
  child->name = spec.name;
  child->most_status_bytes = spec.most_status_bytes;
  child->pid = pid;
  child->program = program;
  child->pidfd = Fd(::pidfd_open(pid, 0));
  if (child->pidfd.get() < 0) {
    const int reason = errno;
    ::kill(-program, SIGKILL);
    ::waitpid(pid, nullptr, 0);
    throw std::system_error(reason, std::generic_category(), "pidfd_open");
  }
  child->status = std::move(status.read);
  child->control = std::move(control.write);
  ::fcntl(child->status.get(), F_SETFL, O_NONBLOCK);
  ::fcntl(child->control.get(), F_SETFL, O_NONBLOCK);
  children_[spec.name] = std::move(child);
}

std::vector<Event> Supervisor::wait(std::chrono::milliseconds limit) {
  std::vector<pollfd> polled = {{signal_fd_, POLLIN, 0}};
  std::vector<Child*> order;
  for (const auto& [name, child] : children_) {
    order.push_back(child.get());
    polled.push_back({child->status.get(), POLLIN, 0});
    polled.push_back({child->pidfd.get(), POLLIN, 0});
  }
  std::vector<Event> events;
  if (::poll(polled.data(), polled.size(), static_cast<int>(limit.count())) <= 0) return events;
  signalfd_siginfo info;
  while (::read(signal_fd_, &info, sizeof info) == sizeof info) events.push_back({Event::Kind::interrupt, {}, {}, {}});
  const auto ended = [&](std::size_t i) { return polled[2 + 2 * i].revents != 0; };
  bool any_ended = false;
  for (std::size_t i = 0; i < order.size(); ++i) any_ended = any_ended || ended(i);
  // Of all programs when one has ended: another one may have said why after it was polled.
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (any_ended || polled[1 + 2 * i].revents != 0) read_status(*order[i], kStatusLook, events);
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (ended(i)) reap(*order[i], events);
  }
  return events;
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
  // Its own children first: as long as the zombie is not reaped, its group's number cannot belong to anyone else. A minder
  // has ended all that was below it.
  ::kill(-child.pid, SIGKILL);
  // All that it can have left: a process that got away from the group may still write.
  const int left = child.status.get() < 0 ? 0 : ::fcntl(child.status.get(), F_GETPIPE_SZ);
  read_status(child, static_cast<std::size_t>(std::max(left, 0)), events);
  int status = 0;
  rusage usage{};
  if (::wait4(child.pid, &status, 0, &usage) != child.pid) throw_errno("wait4");
  ExitStatus exit;
  if (WIFEXITED(status)) exit.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) exit.signal = WTERMSIG(status);
  exit.peak_memory_mb = static_cast<double>(usage.ru_maxrss) / 1024.0;
  exit.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
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
  [[maybe_unused]] const ssize_t written = ::write(found->second->control.get(), text.data(), text.size());
}

void Supervisor::signal(const std::string& program, int signal) {
  const auto found = children_.find(program);
  if (found != children_.end()) signal_child(*found->second, signal);
}

bool Supervisor::has_stopped(const std::string& program) {
  const auto found = children_.find(program);
  siginfo_t info{};
  return found != children_.end() &&
         ::waitid(P_PID, static_cast<id_t>(found->second->pid), &info, WSTOPPED | WNOHANG) == 0 && info.si_pid != 0;
}

// A minder stops by itself when its program does, but cannot wake itself.
void Supervisor::signal_child(const Child& child, int signal) {
  ::kill(-child.program, signal);
  if (signal == SIGCONT && child.program != child.pid) ::kill(child.pid, signal);
}

void Supervisor::signal_all(int signal) {
  for (const auto& [name, child] : children_) signal_child(*child, signal);
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
  bool cut = skipped > 0;  // the first line is the end of one
  for (std::string line; std::getline(in, line); cut = false) {
    if (cut && !in.eof()) continue;
    if (line.size() > kLongestLogLine) line = line.substr(0, kLongestLogLine) + " ...";
    tail.push_back(line);
    if (tail.size() > count) tail.pop_front();
  }
  return {tail.begin(), tail.end()};
}

}  // namespace skein::cli
