#include "host/domain_block.hpp"

#include <utility>

#include "core/scenario/scenario_reader.hpp"
#include "core/types.hpp"

namespace skein::cli {

void check_uavs_over_dds(std::size_t uavs) {
  if (uavs <= kMostUavsOverDds) return;
  throw InputError("a fleet of " + std::to_string(uavs) + " UAVs is too large for DDS, over which at most " +
                   std::to_string(kMostUavsOverDds) + " fly; fly it in one process (--one-process)");
}

DomainBlock::DomainBlock(std::optional<int> base, int size, std::string realm, int from) : realm_(std::move(realm)) {
  const int last_base = kLastDomain - size + 1;
  if (last_base < kFirstDomain) {
    throw InputError("the fleet needs " + std::to_string(size) + " DDS domains; Skein has " +
                     std::to_string(kLastDomain - kFirstDomain + 1));
  }
  if (base) {
    const std::string range = "must be within " + std::to_string(kFirstDomain) + ".." + std::to_string(last_base) +
                              " for this fleet of " + std::to_string(size) + " domains";
    if (*base == 0) {
      throw InputError(
          "--domain 0: the first domain is the world's, and every ROS 2 node of this host that was told no "
          "domain is in 0; it " +
          range);
    }
    if (*base < 0 || *base > last_base) throw InputError("--domain " + std::to_string(*base) + ": " + range);
    if (const auto taken = try_lock(*base, size)) throw InputError(taken_text(*base, size, *taken));
    return;
  }
  for (int candidate = from; candidate <= last_base;) {
    const auto taken = try_lock(candidate, size);
    if (!taken) return;
    candidate = *taken + 1;
  }
  throw InputError("no " + std::to_string(size) + " DDS domains in a row are free; other fleets of this host use them");
}

std::optional<int> DomainBlock::try_lock(int base, int size) {
  for (int domain = base; domain < base + size; ++domain) {
    auto lock = HostLock::try_take(lock_name(domain));
    if (!lock) {
      locks_.clear();
      return domain;
    }
    locks_.push_back(std::move(*lock));
  }
  base_ = base;
  return std::nullopt;
}

std::string DomainBlock::lock_name(int domain) const { return realm_ + domain_lock_name(domain); }

std::string DomainBlock::taken_text(int base, int size, int taken) const {
  const auto holder = HostLock::holder(lock_name(taken));
  return "--domain " + std::to_string(base) + ": this fleet needs domains " + std::to_string(base) + ".." +
         std::to_string(base + size - 1) + ", and another one of this host uses domain " + std::to_string(taken) +
         (holder ? " (process " + std::to_string(*holder) + ")" : "") +
         "; choose another, or leave --domain out to get a free block";
}

}  // namespace skein::cli
