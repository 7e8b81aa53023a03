#include "host/minder.hpp"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "host/proc_table.hpp"

namespace skein::cli {
namespace {

/// The signal that the kernel sends to the minder when the launcher dies: one that also continues a stopped minder.
constexpr int kLauncherDied = SIGCONT;

/// @returns whether it killed any; false: there is no child, or none that the minder may kill.
bool kill_children() {
  bool any = false;
  for (const pid_t pid : all_processes()) {
    if (parent_of(pid) == ::getpid()) any = ::kill(pid, SIGKILL) == 0 || any;
  }
  return any;
}

/// Kills in rounds, since the children of a dead child become children of the minder.
void end_children() {
  while (kill_children() && ::waitpid(-1, nullptr, 0) > 0) {
  }
}

/// Stops this process because its program has stopped. When the program is continued or killed, or when the launcher
/// dies, SIGCONT comes to this process just afterwards. If it came before this process stops, it would be lost, and
/// this process would stop for ever. So a child stops this process, and continues it if one of these things has
/// happened until then.
void stop_with(pid_t program, pid_t launcher) {
  const pid_t minder = ::getpid(), child = ::fork();
  if (child < 0) ::kill(minder, SIGSTOP);
  if (child != 0) return;  // mind() waits for the child
  const auto is_to_stop = [&] { return has_stopped(program) && parent_of(minder) == launcher; };
  if (is_to_stop()) {
    ::kill(minder, SIGSTOP);
    if (!is_to_stop()) ::kill(minder, SIGCONT);
  }
  ::_exit(0);
}

[[noreturn]] void end_as(int status) {
  if (WIFSIGNALED(status)) {
    const rlimit no_core{};
    ::setrlimit(RLIMIT_CORE, &no_core);
    ::signal(WTERMSIG(status), SIG_DFL);
    sigset_t only;
    sigemptyset(&only);
    sigaddset(&only, WTERMSIG(status));
    ::sigprocmask(SIG_UNBLOCK, &only, nullptr);
    ::kill(::getpid(), WTERMSIG(status));
  }
  ::_exit(WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
}

}  // namespace

bool become_minder(pid_t launcher) {
  sigset_t all;
  sigfillset(&all);
  ::sigprocmask(SIG_SETMASK, &all, nullptr);  // mind() receives them one by one
  ::prctl(PR_SET_NAME, "skein-minder");
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  ::prctl(PR_SET_PDEATHSIG, kLauncherDied);
  return ::getppid() == launcher;  // else the launcher died before prctl()
}

void mind(pid_t program, pid_t launcher) {
  ::close_range(0, ~0U, 0);  // the launcher's locks and pipes among them
  sigset_t all;
  sigfillset(&all);
  for (;;) {
    int status = 0;
    for (pid_t pid = 0; (pid = ::waitpid(-1, &status, WNOHANG | WUNTRACED)) > 0;) {
      if (pid != program) continue;
      if (WIFSTOPPED(status)) {
        stop_with(program, launcher);
      } else {
        end_children();
        end_as(status);
      }
    }
    if (::getppid() != launcher) {
      end_children();
      ::_exit(128 + SIGKILL);
    }
    ::sigwaitinfo(&all, nullptr);
  }
}

}  // namespace skein::cli
