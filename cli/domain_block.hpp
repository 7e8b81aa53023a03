// A fleet's block of DDS domains: world, ground station, then one domain a UAV. Lock files in the temporary folder
// keep two fleets of one host out of each other's blocks; the kernel drops a lock when its launcher ends, however.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/program.hpp"

namespace skein::cli {

/// Above this domain the standard's ports reach those that the kernel hands out to clients.
inline constexpr int kLastQuietDomain = 101;

/// Holds the domains base .. base + size - 1 for as long as it lives.
class DomainBlock {
 public:
  /// @param base the user's choice; without one the first block is taken that is free as a whole.
  /// @param size number of domains. @param lock_dir folder of the lock files, the same for all launchers of a host.
  /// @throws InputError when `base` is out of range or taken, or no block of this size is free.
  DomainBlock(std::optional<int> base, int size,
              const std::filesystem::path& lock_dir = std::filesystem::temp_directory_path());
  ~DomainBlock();
  DomainBlock(const DomainBlock&) = delete;
  DomainBlock& operator=(const DomainBlock&) = delete;

  int base() const { return base_; }
  int last() const { return base_ + static_cast<int>(locks_.size()) - 1; }

 private:
  /// @returns whether all domains of the block at `base` could be locked; otherwise none is.
  bool try_lock(int base, int size, const std::filesystem::path& lock_dir);
  void unlock();

  int base_ = 0;
  std::vector<int> locks_;  ///< open, locked files, one a domain
};

}  // namespace skein::cli
