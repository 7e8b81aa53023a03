// For tests of what a program does when it cannot write a whole file, or cannot open another one.
#pragma once

#include <sys/resource.h>

#include <csignal>

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

/// While it lives, this process and its children can have only so many open files; those that are open stay.
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

}  // namespace skein
