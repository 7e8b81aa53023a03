// Tells where the server's time goes without giving the simulation a clock of its own: it announces what it is about
// to do, and whoever wants to know takes the time.
#pragma once

#include <cstddef>

namespace skein::sim {

enum class Work {
  simulation,  ///< all of Simulation::advance(), the others included
  lidar,       ///< one scan
  camera,      ///< one exposure
  links,       ///< the radio matrix of one step
  recording,   ///< digest and files of one step; no part of the simulation
};
inline constexpr int kWorkKinds = 5;

class WorkClock {
 public:
  virtual ~WorkClock() = default;
  virtual void begin(Work work) = 0;
  /// @param pieces  of its kind that were done: scans, exposures.
  virtual void end(Work work, std::size_t pieces) = 0;
};

/// Announces work as long as it lives. @param clock  may be null. @param pieces  as WorkClock::end() has them.
class WorkSection {
 public:
  WorkSection(WorkClock* clock, Work work, std::size_t pieces = 1) : clock_(clock), work_(work), pieces_(pieces) {
    if (clock_) clock_->begin(work_);
  }
  ~WorkSection() {
    if (clock_) clock_->end(work_, pieces_);
  }
  WorkSection(const WorkSection&) = delete;
  WorkSection& operator=(const WorkSection&) = delete;

 private:
  WorkClock* const clock_;
  const Work work_;
  const std::size_t pieces_;
};

}  // namespace skein::sim
