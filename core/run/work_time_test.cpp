// Compares judge_work() on random records with a simple search through all windows of 60 s, and tests its rules on
// records made for them.
#include "core/run/work_time.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/math/random_stream.hpp"

namespace skein {
namespace {

constexpr int kDraws = 60;

WorkTrack open_track(std::size_t seconds) {
  return {std::string(seconds, WorkTrack::kOpen), std::vector<double>(seconds, 0.0)};
}

/// @param often  probability of work in a second.
WorkTrack drawn_track(RandomStream& random, std::size_t seconds, double often) {
  WorkTrack track = open_track(seconds);
  char state = WorkTrack::kOpen;
  for (std::size_t s = 0; s < seconds; ++s) {
    if (random.uniform() < 0.02) state = "1110-"[random.bits() % 5];
    track.open[s] = state;
    if (state != WorkTrack::kAway && random.uniform() < often) track.done[s] = random.uniform(0.0, 1.5);
  }
  return track;
}

std::vector<bool> frozen(const WorkTime& time) {
  std::vector<bool> seconds;
  for (const WorkSecond& second : time.seconds) seconds.push_back(second.frozen);
  return seconds;
}

/// The frozen seconds, found by a search through all windows of 60 open seconds. A window does not extend over a time
/// in which the program was away. Work in a second that is not open counts for the last open second before it.
std::vector<bool> frozen_by_windows(const WorkTrack& track) {
  std::vector<bool> marked(track.open.size(), false);
  std::vector<std::size_t> open;
  std::vector<double> done;
  const auto end_presence = [&] {
    for (std::size_t from = 0; from + kWorkWindow_s <= open.size(); ++from) {
      double sum = 0.0;
      for (std::size_t i = from; i < from + kWorkWindow_s; ++i) sum += done[i];
      // Work after the last open second does not count for this window.
      const std::size_t last = open[from + kWorkWindow_s - 1];
      sum += track.done[last] - done[from + kWorkWindow_s - 1];
      for (std::size_t i = from; sum < 1.0 - 1e-9 && i < from + kWorkWindow_s; ++i) marked[open[i]] = true;
    }
    open.clear();
    done.clear();
  };
  for (std::size_t s = 0; s < track.open.size(); ++s) {
    if (track.open[s] == WorkTrack::kAway) end_presence();
    if (track.open[s] == WorkTrack::kOpen) {
      open.push_back(s);
      done.push_back(0.0);
    }
    if (!done.empty()) done.back() += track.done[s];
  }
  end_presence();
  return marked;
}

TEST(WorkTime, AgreesWithASearchThroughAllWindows) {
  std::size_t some = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    RandomStream random(1, "work_time", draw);
    const WorkTrack track = drawn_track(random, 50 + random.bits() % 500, random.uniform(0.0, 0.06));
    const WorkTime time = judge_work(std::vector{track}, {}).at(0);
    EXPECT_EQ(frozen(time), frozen_by_windows(track)) << draw;
    EXPECT_EQ(time.frozen_s, static_cast<std::size_t>(std::ranges::count(frozen(time), true)));
    EXPECT_EQ(time.frozen_s > 0, time.longest_s >= kWorkWindow_s) << draw;
    EXPECT_EQ(time.excused_s, 0u);
    some += time.frozen_s > 0;
  }
  EXPECT_GT(some, 10u);
  EXPECT_LT(some, kDraws - 5u) << "the random records must include some with and some without frozen seconds";
}

TEST(WorkTime, AUavWithoutOpenWorkIsNeverFrozen) {
  for (int draw = 0; draw < kDraws; ++draw) {
    RandomStream random(2, "work_time", draw);
    WorkTrack track = drawn_track(random, 300, 0.01);
    std::ranges::replace(track.open, WorkTrack::kOpen, WorkTrack::kNothingOpen);
    const WorkTime time = judge_work(std::vector{track}, {}).at(0);
    EXPECT_EQ(time.frozen_s, 0u);
    EXPECT_EQ(time.longest_s, 0u);
  }
}

TEST(WorkTime, AStretchWithoutWorkCountsAsAWholeFrom60SecondsOn) {
  for (const std::size_t stretch : {59u, 60u, 61u, 200u}) {
    WorkTrack track = open_track(stretch + 20);
    for (std::size_t s = 0; s < 10; ++s) track.done[s] = track.done[stretch + 10 + s] = 1.0;
    const WorkTime time = judge_work(std::vector{track}, {}).at(0);
    EXPECT_EQ(time.frozen_s, stretch < kWorkWindow_s ? 0u : stretch) << stretch;
    EXPECT_EQ(time.longest_s, stretch);
  }
}

TEST(WorkTime, TheCountRestartsWhenAProgramComesBack) {
  for (int draw = 0; draw < kDraws; ++draw) {
    RandomStream random(3, "work_time", draw);
    WorkTrack track = open_track(150);
    const std::size_t gone = 20 + random.bits() % 39, back = gone + 1 + random.bits() % 20;
    for (std::size_t s = gone; s < back; ++s) track.open[s] = WorkTrack::kAway;
    for (std::size_t s = back + 59; s < track.done.size(); ++s) track.done[s] = 1.0;
    EXPECT_EQ(judge_work(std::vector{track}, {}).at(0).frozen_s, 0u) << gone << ' ' << back;
  }
}

TEST(WorkTime, AUavThatWaitsForAWorkingUavIsExcusedFor45Seconds) {
  for (int draw = 0; draw < kDraws; ++draw) {
    RandomStream random(4, "work_time", draw);
    const std::size_t wait = 1 + random.bits() % 200, count = 320, begin = 10;
    WorkTrack waits = open_track(count), works = open_track(count);
    for (std::size_t s = 0; s < count; ++s) {
      works.done[s] = s % 20 == 0 ? 1.0 : 0.0;
      if (s < begin || s >= begin + wait) waits.done[s] = 1.0;
    }
    const std::vector<std::vector<WaitSpan>> spans = {{{10.0, 10.0 + static_cast<double>(wait), 1}}, {}};
    const auto times = judge_work(std::vector{waits, works}, spans);
    EXPECT_EQ(times[0].excused_s, std::min(wait, kMostExcused_s));
    EXPECT_EQ(times[0].frozen_s, wait < kMostExcused_s + kWorkWindow_s ? 0u : wait - kMostExcused_s) << wait;
    EXPECT_EQ(times[1].frozen_s, 0u);
  }
}

TEST(WorkTime, AUavThatWaitsManyTimesIsExcusedFor45SecondsInAll) {
  WorkTrack waits = open_track(300), works = open_track(300);
  std::ranges::fill(works.done, 0.2);
  waits.done[0] = 1.0;
  std::vector<WaitSpan> pieces;
  for (int s = 1; s < 300; s += 3) pieces.push_back({1.0 * s, s + 2.0, 1});
  EXPECT_EQ(judge_work(std::vector{waits, works}, std::vector<std::vector<WaitSpan>>{pieces, {}})[0].excused_s,
            kMostExcused_s);
}

TEST(WorkTime, AUavThatWaitsForAUavWithoutWorkIsFrozen) {
  for (int draw = 0; draw < kDraws; ++draw) {
    RandomStream random(5, "work_time", draw);
    const std::size_t count = 150 + random.bits() % 200, stands = random.bits() % 20;
    WorkTrack waits = open_track(count), mate = open_track(count);
    for (std::size_t s = 0; s < stands; ++s) mate.done[s] = 1.0;
    if (random.uniform() < 0.3) mate.open.assign(count, WorkTrack::kNothingOpen);  // it has nothing to do
    if (random.uniform() < 0.3) mate.open.assign(count, WorkTrack::kAway);         // it is dead
    const auto end_s = static_cast<double>(count);
    const std::vector<std::vector<WaitSpan>> spans = {{{100.0, end_s, 1}}, {{100.0, end_s, 0}}};
    const auto times = judge_work(std::vector{waits, mate}, spans);
    EXPECT_EQ(times[0].excused_s, 0u) << draw;
    EXPECT_EQ(times[0].frozen_s, count);
  }
}

TEST(WorkTime, InvalidRecordsAndWaitsAreIgnored) {
  EXPECT_TRUE(judge_work({}, {}).empty());
  const std::vector<WorkTrack> tracks = {{"11-", {0.0}}, {"", {1.0, 1.0}}};
  const std::vector<std::vector<WaitSpan>> spans = {
      {{0.0, 1e9, 1}, {-5.0, 9.0, 7}, {3.0, 1.0, 1}, {0.0, 9.0, 0}}, {{0.0, 9.0, 0}}, {{0.0, 1.0, 0}}};
  EXPECT_EQ(judge_work(tracks, spans).size(), 2u);
}

}  // namespace
}  // namespace skein
