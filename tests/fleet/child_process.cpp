#include "child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>
#include <string_view>
#include <thread>

#include "tests/support/text_files.hpp"

namespace skein::test {
namespace {

std::vector<std::string> with(const Environment& extra) {
  std::vector<std::string> result;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    if (!extra.contains(std::string(text.substr(0, text.find('='))))) result.emplace_back(text);
  }
  for (const auto& [name, value] : extra) result.push_back(name + "=" + value);
  return result;
}

std::vector<char*> pointers(const std::vector<std::string>& strings) {
  std::vector<char*> result;
  for (const std::string& text : strings) result.push_back(const_cast<char*>(text.c_str()));
  result.push_back(nullptr);
  return result;
}

int open_for_output(const std::filesystem::path& file) {
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) throw std::runtime_error("cannot write " + file.string());
  return fd;
}

}  // namespace

std::string text_of(const std::filesystem::path& file) { return read_text(file); }

ChildProcess::ChildProcess(const Arguments& argv, const Environment& environment, std::filesystem::path out,
                           std::filesystem::path err)
    : out_(std::move(out)), err_(std::move(err)) {
  const std::vector<std::string> env = with(environment);
  const std::vector<char*> argv_pointers = pointers(argv), env_pointers = pointers(env);
  const int out_fd = open_for_output(out_), err_fd = open_for_output(err_);
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) {  // from here to exec only async-signal-safe calls
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() == parent && ::dup2(out_fd, STDOUT_FILENO) >= 0 && ::dup2(err_fd, STDERR_FILENO) >= 0) {
      ::execve(argv_pointers[0], argv_pointers.data(), env_pointers.data());
    }
    ::_exit(127);
  }
  ::close(out_fd);
  ::close(err_fd);
  if (pid_ < 0) throw std::runtime_error("cannot start " + argv[0]);
  ::setpgid(pid_, pid_);  // parent and child both do this, so that it is done whichever runs first
}

ChildProcess::~ChildProcess() {
  if (ended()) return;
  ::kill(-pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

void ChildProcess::signal(int signal) const {
  if (!exit_) ::kill(pid_, signal);
}

std::optional<ExitStatus> ChildProcess::ended() {
  int status = 0;
  if (!exit_ && ::waitpid(pid_, &status, WNOHANG) == pid_) {
    exit_ = WIFEXITED(status) ? ExitStatus{WEXITSTATUS(status), 0} : ExitStatus{-1, WTERMSIG(status)};
  }
  return exit_;
}

ExitStatus ChildProcess::wait(std::chrono::seconds patience) {
  if (!eventually([this] { return ended().has_value(); }, patience)) {
    throw std::runtime_error("process " + std::to_string(pid_) + " does not end; its stderr: " + err());
  }
  return *exit_;
}

}  // namespace skein::test
