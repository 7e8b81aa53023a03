#include "core/run/work_time.hpp"

#include <algorithm>
#include <deque>

namespace skein {
namespace {

constexpr double kLeast = 1.0 - 1e-9;  ///< amounts are sums of rounded numbers

/// Counts the latest open seconds of one UAV in which it did less than a least amount of work.
class OpenSeconds {
 public:
  void begin_anew() {
    open_ = 0;
    worked_.clear();
  }
  void add_work(double done) {
    if (done > 0.0) worked_.push_back({open_, done});
  }
  void pass() { ++open_; }

  /// Length of the longest stretch of open seconds up to now with less than a least amount of work; 0 if the current
  /// second has that much.
  std::size_t without_work() {
    double sum = 0.0;
    for (auto one = worked_.rbegin(); one != worked_.rend(); ++one) {
      sum += one->done;
      if (sum < kLeast) continue;
      worked_.erase(worked_.begin(), std::prev(one.base()));  // older work is not needed any more
      return open_ - worked_.front().at;
    }
    return open_;
  }

 private:
  struct Work {
    std::size_t at;  ///< open seconds before it
    double done;
  };
  std::size_t open_ = 0;
  std::deque<Work> worked_;
};

bool counts(const WorkTrack& track, const WorkTime& time, std::size_t second) {
  return track.open[second] == WorkTrack::kOpen && !time.seconds[second].excused;
}

/// Computes all values of `time` except the excused seconds, which the caller has set.
void measure(const WorkTrack& track, WorkTime& time) {
  OpenSeconds seconds;
  std::vector<std::size_t> window;  // open seconds since the UAV was last away
  time.frozen_s = time.longest_s = 0;
  for (std::size_t s = 0; s < time.seconds.size(); ++s) {
    WorkSecond& second = time.seconds[s];
    second.frozen = false;
    if (track.open[s] == WorkTrack::kAway) {
      seconds.begin_anew();
      window.clear();
      second.without_work = 0;
      continue;
    }
    const bool open = counts(track, time, s);
    if (open) {
      seconds.pass();
      window.push_back(s);
    }
    seconds.add_work(track.done[s]);
    second.without_work = seconds.without_work();
    time.longest_s = std::max(time.longest_s, second.without_work);
    if (!open || second.without_work < kWorkWindow_s) continue;
    const auto from = window.end() - static_cast<std::ptrdiff_t>(std::min(kWorkWindow_s, window.size()));
    for (auto one = from; one != window.end(); ++one) time.seconds[*one].frozen = true;
  }
  for (const WorkSecond& second : time.seconds) time.frozen_s += second.frozen;
}

/// By second: whether the UAV works, so that another UAV may wait for it. It works in a second if this second is not
/// frozen, and any 60 s that contain the second have a least amount of work.
std::vector<bool> working(const WorkTrack& track, const WorkTime& time) {
  const std::size_t count = time.seconds.size();
  std::vector<bool> works(count, false);
  double sum = 0.0;
  for (std::size_t s = 0; s < count; ++s) {
    sum += track.done[s];
    if (s >= kWorkWindow_s) sum -= track.done[s - kWorkWindow_s];
    if (sum < kLeast) continue;
    for (std::size_t one = s + 1 - std::min(s + 1, kWorkWindow_s); one <= s; ++one) {
      works[one] = !time.seconds[one].frozen && track.open[one] != WorkTrack::kAway;
    }
  }
  return works;
}

void note_waits(const std::vector<WaitSpan>& spans, std::size_t uavs, std::size_t uav, WorkTime& time) {
  for (const WaitSpan& span : spans) {
    if (span.mate >= uavs || span.mate == uav) continue;
    // The UAV waits in a second if the span contains the middle of the second.
    const double from_s = std::clamp(span.from_s - 0.5, 0.0, static_cast<double>(time.seconds.size()));
    for (auto s = static_cast<std::size_t>(from_s); s < time.seconds.size(); ++s) {
      const double middle_s = static_cast<double>(s) + 0.5;
      if (middle_s >= span.until_s) break;
      if (middle_s >= span.from_s) time.seconds[s].waits_for = span.mate;
    }
  }
}

void excuse(const WorkTrack& track, const std::vector<std::vector<bool>>& works, WorkTime& time) {
  std::size_t left = kMostExcused_s;
  double done = 0.0;  // work since `left` was last reset
  for (std::size_t s = 0; s < time.seconds.size(); ++s) {
    done += track.done[s];
    if (done >= kLeast || track.open[s] == WorkTrack::kAway) {
      left = kMostExcused_s;
      done = 0.0;
    }
    WorkSecond& second = time.seconds[s];
    if (track.open[s] != WorkTrack::kOpen || !second.waits_for || left == 0) continue;
    const std::vector<bool>& mate = works[*second.waits_for];
    second.excused = s < mate.size() && mate[s];
    left -= second.excused;
    time.excused_s += second.excused;
  }
}

}  // namespace

std::vector<WorkTime> judge_work(std::span<const WorkTrack> tracks, std::span<const std::vector<WaitSpan>> waits) {
  std::vector<WorkTime> times(tracks.size());
  std::vector<std::vector<bool>> works;
  for (std::size_t uav = 0; uav < tracks.size(); ++uav) {
    times[uav].seconds.resize(std::min(tracks[uav].open.size(), tracks[uav].done.size()));
    measure(tracks[uav], times[uav]);
    works.push_back(working(tracks[uav], times[uav]));
  }
  for (std::size_t uav = 0; uav < std::min(tracks.size(), waits.size()); ++uav) {
    note_waits(waits[uav], tracks.size(), uav, times[uav]);
    excuse(tracks[uav], works, times[uav]);
    measure(tracks[uav], times[uav]);
  }
  return times;
}

}  // namespace skein
