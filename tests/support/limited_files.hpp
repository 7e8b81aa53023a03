// For tests of what a program does when it cannot write a whole file.
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

}  // namespace skein
