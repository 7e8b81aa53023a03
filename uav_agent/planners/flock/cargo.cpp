#include "uav_agent/planners/flock/cargo.hpp"

#include "uav_agent/planners/flock/work.hpp"

namespace skein::agent {

void FlockCargo::update(double gained, std::size_t undelivered) {
  if (undelivered < undelivered_) stake_.value *= static_cast<double>(undelivered) / static_cast<double>(undelivered_);
  undelivered_ = undelivered;
  if (undelivered > 0) stake_.value += gained;
}

void FlockCargo::note(double rate) { stake_.gain_per_s += FlockWork::kRateShare * (rate - stake_.gain_per_s); }

}  // namespace skein::agent
