#include "cli/film/piped_program.hpp"

#include <poll.h>
#include <sys/signalfd.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <stdexcept>

#include "host/preflight.hpp"
#include "host/supervisor.hpp"

namespace skein::cli {
namespace {

/// Timeout of each wait for the program: far longer than any request takes on a busy machine.
constexpr int kPatience_ms = 300'000;
constexpr std::size_t kLogLines = 8;

}  // namespace

HeldSignals::HeldSignals() {
  const sigset_t set = interrupt_signals();
  if (::sigprocmask(SIG_BLOCK, &set, &former_mask_) != 0) throw_errno("sigprocmask");
  fd_ = Fd(::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK));
  if (fd_.get() < 0) throw_errno("signalfd");
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  ::sigaction(SIGPIPE, &ignore, &former_pipe_action_);
}

HeldSignals::~HeldSignals() {
  // Discards the signals that have arrived: unblocked, they would end this process before it has cleaned up.
  signalfd_siginfo info;
  while (::read(fd_.get(), &info, sizeof info) == sizeof info) continue;
  ::sigaction(SIGPIPE, &former_pipe_action_, nullptr);
  ::sigprocmask(SIG_SETMASK, &former_mask_, nullptr);
}

PipedProgram::PipedProgram(const ProgramSpec& spec, const HeldSignals& signals)
    : spec_(spec), signals_(signals), program_(start_program(spec)) {}

PipedProgram::~PipedProgram() {
  if (program_.pid <= 0) return;
  signal_program(program_, SIGKILL);
  ::waitpid(program_.pid, nullptr, 0);  // its minder, which ends all remaining descendants
}

std::string PipedProgram::last_words() const { return last_lines_below(spec_.log, kLogLines); }

void PipedProgram::wait_for(int fd, short events) const {
  std::array<pollfd, 2> polled = {{{signals_.fd(), POLLIN, 0}, {fd, events, 0}}};
  const int ready = ::poll(polled.data(), polled.size(), kPatience_ms);
  if (ready < 0 && errno != EINTR) throw_errno("poll");
  if (polled[0].revents != 0) throw Interrupted{};
  if (ready == 0) throw std::runtime_error(spec_.name + " does not answer" + last_words());
}

void PipedProgram::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t taken = ::write(program_.control.get(), bytes.data(), bytes.size());
    if (taken < 0 && errno != EAGAIN && errno != EINTR) {
      throw std::runtime_error(spec_.name + " has ended early" + last_words());
    }
    if (taken > 0) bytes.remove_prefix(static_cast<std::size_t>(taken));
    if (taken < 0) wait_for(program_.control.get(), POLLOUT);
  }
}

std::string PipedProgram::read() {
  std::array<char, 64 << 10> buffer;
  while (true) {
    const ssize_t size = ::read(program_.status.get(), buffer.data(), buffer.size());
    if (size > 0) return {buffer.data(), static_cast<std::size_t>(size)};
    if (size == 0) throw std::runtime_error(spec_.name + " has ended early" + last_words());
    if (errno != EAGAIN && errno != EINTR) throw_errno(spec_.name);
    wait_for(program_.status.get(), POLLIN);
  }
}

ExitStatus PipedProgram::finish() {
  program_.control.reset();
  wait_for(program_.pidfd.get(), POLLIN);
  int status = 0;
  if (::waitpid(program_.pid, &status, 0) != program_.pid) throw_errno("waitpid");
  program_.pid = -1;
  ExitStatus exit;
  if (WIFSIGNALED(status)) exit.signal = WTERMSIG(status);
  if (WIFEXITED(status)) exit.code = WEXITSTATUS(status);
  return exit;
}

}  // namespace skein::cli
