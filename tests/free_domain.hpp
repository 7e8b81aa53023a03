// Domain ids for tests, so that test programs that run at the same time never meet.
#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "bus/bus.hpp"

namespace skein::test {

/// Reserves consecutive domain ids for its lifetime, by locks on files in the folder for temporary files. The locks go
/// with the process, however it ends; the empty files stay. They are those of the launcher (cli/domain_block.hpp), so that
/// no fleet comes in between. Domains below kFirst are left to users.
class FreeDomains {
 public:
  static constexpr int kFirst = 10;

  /// @throws std::runtime_error when no `count` consecutive ids are free
  explicit FreeDomains(int count) {
    // Neighbouring processes begin in different places. Only where ports stay below the ephemeral range, if possible.
    const int choices = bus::kMaxDomain - count + 1 - kFirst + 1;
    const int low_choices = count < 80 ? 100 - count - kFirst : choices;
    const int start = static_cast<int>(getpid() * 7L % low_choices);
    for (int i = 0; i < choices; ++i) {
      base_ = kFirst + (start + i) % choices;
      if (lock_all(count)) return;
    }
    throw std::runtime_error("no " + std::to_string(count) + " consecutive DDS domain ids are free");
  }
  ~FreeDomains() { unlock_all(); }
  FreeDomains(const FreeDomains&) = delete;
  FreeDomains& operator=(const FreeDomains&) = delete;

  int base() const { return base_; }

 private:
  bool lock_all(int count) {
    for (int domain = base_; domain < base_ + count; ++domain) {
      const auto path = std::filesystem::temp_directory_path() / ("skein-domain-" + std::to_string(domain) + ".lock");
      const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
      if (file < 0) throw std::runtime_error("cannot create " + path.string());
      files_.push_back(file);
      if (flock(file, LOCK_EX | LOCK_NB) != 0) {
        unlock_all();
        return false;
      }
    }
    return true;
  }

  void unlock_all() {
    for (const int file : files_) close(file);
    files_.clear();
  }

  int base_ = kFirst;
  std::vector<int> files_;
};

}  // namespace skein::test
