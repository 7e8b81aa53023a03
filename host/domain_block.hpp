// A fleet's block of DDS domains: one for the world, one for the ground station, then one for each UAV. A lock on each
// domain prevents two fleets in the same network namespace from using the same domain, also fleets of different users.
// Threads: the launcher's one.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "process/host/host_lock.hpp"
#include "process/program.hpp"

namespace skein::cli {

/// Above this domain, the UDP ports that the DDS standard prescribes reach into Linux's ephemeral port range.
inline constexpr int kLastQuietDomain = 101;

/// @throws InputError for a fleet of more UAVs than fly over DDS (kMostUavsOverDds).
void check_uavs_over_dds(std::size_t uavs);

/// Holds the domains base .. base + size - 1 for as long as it lives.
class DomainBlock {
 public:
  /// @param base  first domain, if the user chose one; nullopt: takes the first block that is completely free.
  /// @param size  number of domains. @param realm  for tests: blocks conflict only within the same realm.
  /// @param from  if `base` is nullopt: the lowest first domain to try.
  /// @throws InputError if `base` is out of range, if a domain of its block is taken (the message names the process, if
  ///   it can be seen), or if no block of this size is free.
  DomainBlock(std::optional<int> base, int size, std::string realm = {}, int from = kFirstDomain);

  /// Call it now and then while a fleet flies: see HostLock.
  void forget_visitors() const {
    for (const HostLock& lock : locks_) lock.forget_visitors();
  }

  int base() const { return base_; }
  int last() const { return base_ + static_cast<int>(locks_.size()) - 1; }

 private:
  /// Takes the locks without testing them first: between a test and a lock, another fleet could take the domain. If the
  /// block is not free as a whole, this object holds its first domains for some microseconds. Another fleet that wants
  /// these domains meanwhile is refused or goes to the next block, but two fleets never share a domain.
  /// @returns the first domain of the block at `base` that is already locked; nullopt: this object now holds all locks.
  std::optional<int> try_lock(int base, int size);
  std::string lock_name(int domain) const;
  std::string taken_text(int base, int size, int taken) const;

  const std::string realm_;
  int base_ = 0;
  std::vector<HostLock> locks_;  ///< one for each domain
};

}  // namespace skein::cli
