// DDS domain ids for tests, so that test programs that run at the same time never share a domain.
#pragma once

#include <unistd.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bus/bus.hpp"
#include "process/host/host_lock.hpp"

namespace skein::test {

/// Reserves consecutive domain ids for its lifetime, by the launcher's locks (host/domain_block.hpp), so that no
/// fleet takes them. The locks end with the process, however it ends. Domains below kFirst are left to users.
class FreeDomains {
 public:
  static constexpr int kFirst = 10;

  /// @throws std::runtime_error when no `count` consecutive ids are free
  explicit FreeDomains(int count) {
    // Processes with neighbouring ids begin at different domains; first at those with ports below the ephemeral range.
    const int choices = bus::kMaxDomain - count + 1 - kFirst + 1;
    const int low_choices = count < 80 ? 100 - count - kFirst : choices;
    const int start = static_cast<int>(getpid() * 7L % low_choices);
    for (int i = 0; i < choices; ++i) {
      base_ = kFirst + (start + i) % choices;
      if (lock_all(count)) return;
    }
    throw std::runtime_error("no " + std::to_string(count) + " consecutive DDS domain ids are free");
  }

  int base() const { return base_; }

 private:
  bool lock_all(int count) {
    for (int domain = base_; domain < base_ + count; ++domain) {
      auto lock = HostLock::try_take(domain_lock_name(domain));
      if (!lock) {
        locks_.clear();
        return false;
      }
      locks_.push_back(std::move(*lock));
    }
    return true;
  }

  int base_ = kFirst;
  std::vector<HostLock> locks_;
};

}  // namespace skein::test
