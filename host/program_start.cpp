#include "host/program_start.hpp"

#include <fcntl.h>
#include <grp.h>
#include <sys/prctl.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>

#include "host/minder.hpp"
#include "process/files/closed_to_agents.hpp"

extern "C" {  // missing in glibc 2.36's header
#include <sys/pidfd.h>
}

namespace skein::cli {

void reset_signals() {
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  for (int signal = 1; signal < SIGRTMIN; ++signal) ::signal(signal, SIG_DFL);
}

namespace {

struct Pipe {
  Fd read, write;
};

/// Both ends are above the numbers that a child's descriptors get, so that dup2 never overwrites one of them.
Pipe make_pipe() {
  int fds[2];
  if (::pipe2(fds, O_CLOEXEC) != 0) throw_errno("pipe");
  Fd low_read(fds[0]), low_write(fds[1]);
  Pipe pipe{Fd(::fcntl(fds[0], F_DUPFD_CLOEXEC, kViewFd + 1)), Fd(::fcntl(fds[1], F_DUPFD_CLOEXEC, kViewFd + 1))};
  if (pipe.read.get() < 0 || pipe.write.get() < 0) throw_errno("pipe");
  return pipe;
}

Fd open_high(const std::filesystem::path& file, int flags) {
  const Fd low(::open(file.c_str(), flags | O_CLOEXEC, 0644));
  if (low.get() < 0) throw_errno(file.string());
  Fd high(::fcntl(low.get(), F_DUPFD_CLOEXEC, kViewFd + 1));
  if (high.get() < 0) throw_errno(file.string());
  return high;
}

std::vector<char*> pointers(const std::vector<std::string>& strings) {
  std::vector<char*> result;
  for (const std::string& s : strings) result.push_back(const_cast<char*>(s.c_str()));
  result.push_back(nullptr);
  return result;
}

/// The child's work between fork and exec, which uses only async-signal-safe calls. The child writes its process id to
/// the pipe `news`, then errno if it cannot start the program.
struct ChildSetup {
  pid_t parent;                                 ///< the launcher, or the program's minder
  int input, log, status, control, view, news;  ///< input, log: -1 keeps the launcher's; view: -1 is none
  char* const* argv;
  char* const* env;
  const UserId* user;  ///< null: the launcher's
  bool foreground;     ///< the program gets the terminal

  [[noreturn]] void exec() const {
    ::setpgid(0, 0);
    if (foreground) give_terminal_to(::getpid());
    tell(::getpid());
    bool ready =
        user == nullptr || (::setgroups(1, &kAgentsGroup) == 0 && ::setgid(user->gid) == 0 && ::setuid(user->uid) == 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);       // after setuid, which would undo it
    if (::getppid() != parent) ::_exit(127);  // the parent died before prctl()
    reset_signals();
    const std::array<std::pair<int, int>, 6> files = {
        {{input, 0}, {log, 1}, {log, 2}, {status, kStatusFd}, {control, kControlFd}, {view, kViewFd}}};
    for (const auto& [from, to] : files) ready = ready && (from < 0 || ::dup2(from, to) >= 0);
    if (ready) ::execve(argv[0], argv, env);
    tell(errno);
    ::_exit(127);
  }

  void tell(int number) const { [[maybe_unused]] const ssize_t written = ::write(news, &number, sizeof number); }
};

/// The same, with a minder as the program's parent.
[[noreturn]] void exec_minded(ChildSetup setup) {
  ::setpgid(0, 0);
  const pid_t launcher = std::exchange(setup.parent, ::getpid());
  if (!become_minder(launcher)) ::_exit(127);
  const pid_t program = ::fork();
  if (program == 0) setup.exec();
  if (program > 0) mind(program, launcher);
  setup.tell(0);  // in place of a process id; then the reason
  setup.tell(errno);
  ::_exit(127);
}

/// The command line that starts a program. The programs of a pack, which contains its own loader and libraries
/// (cli/pack_command.cpp), are started by that loader.
std::vector<std::string> loaded(const std::vector<std::string>& argv) {
  const char* loader = std::getenv("SKEIN_LOADER");
  const std::filesystem::path libraries = std::filesystem::path(loader == nullptr ? "" : loader).parent_path();
  const bool is_packed = loader != nullptr && argv[0].starts_with(libraries.parent_path().string() + "/bin/");
  if (!is_packed) return argv;
  std::vector<std::string> words = {loader, "--library-path", libraries, "--argv0", argv[0]};
  words.insert(words.end(), argv.begin(), argv.end());
  return words;
}

/// The next number that a child wrote to its pipe `news`; nullopt: there is none.
std::optional<int> next_news(const Fd& from) {
  int number = 0;
  ssize_t size = 0;
  do {
    size = ::read(from.get(), &number, sizeof number);
  } while (size < 0 && errno == EINTR);
  return size == sizeof number ? std::optional(number) : std::nullopt;
}

/// Opens the pidfd that signals a child's end. @throws std::system_error if that fails; the program is killed then.
Fd watch(pid_t pid, pid_t program) {
  Fd pidfd(::pidfd_open(pid, 0));
  if (pidfd.get() >= 0) return pidfd;
  const int reason = errno;
  ::kill(-program, SIGKILL);
  ::waitpid(pid, nullptr, 0);
  throw std::system_error(reason, std::generic_category(), "pidfd_open");
}

}  // namespace

bool owns_terminal() { return ::isatty(STDIN_FILENO) == 1 && ::tcgetpgrp(STDIN_FILENO) == ::getpgrp(); }

void give_terminal_to(pid_t group) {
  sigset_t output, former;
  sigemptyset(&output);
  sigaddset(&output, SIGTTOU);  // else tcsetpgrp() stops a process in the background
  ::sigprocmask(SIG_BLOCK, &output, &former);
  ::tcsetpgrp(STDIN_FILENO, group);
  ::sigprocmask(SIG_SETMASK, &former, nullptr);
}

void throw_errno(const std::string& what) { throw std::system_error(errno, std::generic_category(), what); }

StartedProgram start_program(const ProgramSpec& spec) {
  Fd log = spec.log.empty() || spec.here
               ? Fd()
               : open_high(spec.log, O_RDWR | O_CREAT | O_APPEND | (spec.append_log ? 0 : O_TRUNC));
  const Fd input = spec.here ? Fd() : open_high("/dev/null", O_RDONLY);
  const Fd view = spec.listener < 0 ? Fd() : Fd(::fcntl(spec.listener, F_DUPFD_CLOEXEC, kViewFd + 1));
  if (spec.listener >= 0 && view.get() < 0) throw_errno("the socket of the page");
  Pipe status = make_pipe(), control = make_pipe(), news = make_pipe();
  const std::vector<std::string> words = loaded(spec.argv);
  const std::vector<char*> argv = pointers(words), env = pointers(spec.env);
  const ChildSetup setup{::getpid(),
                         input.get(),
                         log.get(),
                         status.write.get(),
                         control.read.get(),
                         view.get(),
                         news.write.get(),
                         argv.data(),
                         env.data(),
                         spec.user ? &*spec.user : nullptr,
                         spec.here && owns_terminal()};
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
  StartedProgram started{
      pid,           program, setup.foreground, watch(pid, program), std::move(status.read), std::move(control.write),
      std::move(log)};
  ::fcntl(started.status.get(), F_SETFL, O_NONBLOCK);
  ::fcntl(started.control.get(), F_SETFL, O_NONBLOCK);
  return started;
}

// A minder stops by itself when its program does, but does not go on by itself, not even when its program ends.
void signal_program(const StartedProgram& program, int signal) {
  ::kill(-program.program, signal);
  const bool is_minded = program.program != program.pid;
  if (is_minded && (signal == SIGCONT || signal == SIGKILL)) ::kill(program.pid, SIGCONT);
}

}  // namespace skein::cli
