// Times the named parts of an agent's work, for `skein bench --profile`: a planner names a part of its work with a
// PartTimer. For reports only: no decision uses the times. Without a profile, a PartTimer does nothing.
// Units: s.   Threads: one for each agent.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace skein::agent {

/// CPU time of an agent's work by part. At any time, at most one part is timed: while an inner part is timed, the outer
/// one is not, so the sum over all parts is at most the time of the whole work.
class WorkParts {
 public:
  using Clock = std::function<double()>;  ///< @returns the CPU time of the calling thread [s]
  struct Part {
    std::string_view name;
    double cpu_s = 0.0;
  };

  explicit WorkParts(Clock clock) : clock_(std::move(clock)) {}
  /// The parts that were timed so far, in the order in which they were first timed.
  const std::vector<Part>& all() const { return parts_; }

 private:
  friend class PartTimer;
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  std::size_t number_of(std::string_view name) {
    const auto found = std::ranges::find(parts_, name, &Part::name);
    if (found != parts_.end()) return static_cast<std::size_t>(found - parts_.begin());
    parts_.push_back({name});
    return parts_.size() - 1;
  }
  /// From now on times the part of this number. @returns the number of the part that was timed before.
  std::size_t change_to(std::size_t part) {
    const double now_s = clock_();
    if (current_ != kNone) parts_[current_].cpu_s += now_s - since_s_;
    since_s_ = now_s;
    return std::exchange(current_, part);
  }

  const Clock clock_;
  std::vector<Part> parts_;
  std::size_t current_ = kNone;
  double since_s_ = 0.0;
};

/// Times a part of the work until the end of its scope.
class PartTimer {
 public:
  /// @param parts  PlannerInput::parts; nullptr: nothing is timed. @param name  such as "planner/views": a literal.
  PartTimer(WorkParts* parts, std::string_view name) : parts_(parts) {
    if (parts_ != nullptr) before_ = parts_->change_to(parts_->number_of(name));
  }
  ~PartTimer() {
    if (parts_ != nullptr) parts_->change_to(before_);
  }
  PartTimer(const PartTimer&) = delete;
  PartTimer& operator=(const PartTimer&) = delete;

 private:
  WorkParts* const parts_;
  std::size_t before_ = WorkParts::kNone;
};

/// Times a part of the work. @returns what `work` returns.
decltype(auto) timed(WorkParts* parts, std::string_view name, auto&& work) {
  const PartTimer timer(parts, name);
  return work();
}

}  // namespace skein::agent
