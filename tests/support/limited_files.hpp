// For tests of what a program does when it cannot write a whole file, or cannot open another one.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <exception>
#include <functional>
#include <string>

#include "core/files/write_whole.hpp"

namespace skein {

/// While it lives, no file of this process and its children can grow beyond so many bytes, as on a disk that becomes
/// full: a write that needs more fails.
class LimitedFiles {
 public:
  explicit LimitedFiles(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &usual_);
    const rlimit limited{bytes, usual_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limited);
  }
  ~LimitedFiles() {
    ::setrlimit(RLIMIT_FSIZE, &usual_);
    std::signal(SIGXFSZ, handler_);
  }
  LimitedFiles(const LimitedFiles&) = delete;
  LimitedFiles& operator=(const LimitedFiles&) = delete;

 private:
  rlimit usual_{};
  void (*handler_)(int);
};

/// While it lives, this process and its children can have only so many open files, unless they raise the limit; those
/// that are open stay.
class LimitedOpenFiles {
 public:
  explicit LimitedOpenFiles(rlim_t files) {
    ::getrlimit(RLIMIT_NOFILE, &usual_);
    const rlimit limited{files, usual_.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &limited);
  }
  ~LimitedOpenFiles() { ::setrlimit(RLIMIT_NOFILE, &usual_); }
  LimitedOpenFiles(const LimitedOpenFiles&) = delete;
  LimitedOpenFiles& operator=(const LimitedOpenFiles&) = delete;

 private:
  rlimit usual_{};
};

/// Does `work` in a child of this process that can have only so many open files, and cannot raise the limit.
/// @returns what it returns, or the message of its exception
inline std::string done_with_open_files(rlim_t files, const std::function<std::string()>& work) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return "no pipe";
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit limited{files, files};
    ::setrlimit(RLIMIT_NOFILE, &limited);
    std::string said;
    try {
      said = work();
    } catch (const std::exception& error) {
      said = error.what();
    }
    ::_exit(write_whole(ends[1], said) ? 0 : 1);
  }
  ::close(ends[1]);
  std::string said;
  std::array<char, 512> part{};
  for (ssize_t got = 0; (got = ::read(ends[0], part.data(), part.size())) > 0;) {
    said.append(part.data(), static_cast<std::size_t>(got));
  }
  ::close(ends[0]);
  ::waitpid(child, nullptr, 0);
  return said;
}

}  // namespace skein
