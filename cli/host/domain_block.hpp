// A fleet's block of DDS domains: world, ground station, then one domain a UAV. Locks keep two fleets out of each
// other's blocks wherever their domains would collide: in one network namespace, whoever runs them and whatever their
// TMPDIR.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "process/host/host_lock.hpp"
#include "process/program.hpp"

namespace skein::cli {

/// Above this domain the standard's ports reach those that the kernel hands out to clients.
inline constexpr int kLastQuietDomain = 101;

/// Holds the domains base .. base + size - 1 for as long as it lives.
class DomainBlock {
 public:
  /// @param base the user's choice; without one the first block is taken that is free as a whole.
  /// @param size number of domains. @param realm  for tests: blocks of other realms are not in the way.
  /// @param from  without a choice, no block before it.
  /// @throws InputError when `base` is out of range or taken (it says by which process), or no block of this size is
  /// free.
  DomainBlock(std::optional<int> base, int size, std::string realm = {}, int from = kFirstDomain);

  int base() const { return base_; }
  int last() const { return base_ + static_cast<int>(locks_.size()) - 1; }

 private:
  /// @returns the first domain of the block at `base` that somebody else holds; nullopt when all are ours now.
  std::optional<int> try_lock(int base, int size);
  std::string lock_name(int domain) const;
  std::string taken_text(int base, int size, int taken) const;

  const std::string realm_;
  int base_ = 0;
  std::vector<HostLock> locks_;  ///< one a domain
};

}  // namespace skein::cli
