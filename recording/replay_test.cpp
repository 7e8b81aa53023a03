#include "recording/replay.hpp"

#include <gtest/gtest.h>

#include <random>

#include "bus/lockstep/names.hpp"
#include "core/topics.hpp"
#include "idl/cdr.hpp"
#include "idl/type_names.hpp"
#include "recording/mcap/testing.hpp"
#include "recording/recorder.hpp"
#include "results/run_folder.hpp"

namespace skein::recording {
namespace {

constexpr Tick kStep = 20;

/// A message of a UAV in a step, on one of two topics: a gimbal command, or a camera trigger.
struct Word {
  std::string uav;
  bool gimbal = false;
  mcap::Bytes payload;
  bool operator==(const Word&) const = default;
};
using Speech = std::vector<std::vector<Word>>;  ///< the words of each step

Speech random_speech(std::uint64_t seed, std::size_t steps) {
  std::mt19937_64 random(seed);
  Speech speech(steps);
  for (auto& words : speech) {
    for (const char* uav : {"jurong", "raffles"}) {
      for (std::uint64_t i = random() % 3; i > 0; --i) {
        msg::Twist twist;
        twist.linear().x(static_cast<double>(random() % 100));
        words.push_back({uav, random() % 2 == 0, encode(twist)});
      }
    }
  }
  return speech;
}

class ReplayTest : public mcap::McapFiles {
 protected:
  /// Passes a speech to a tap, as a server does. @returns the words that the tap passes on.
  template <class TapType>
  Speech hear(TapType& tap, const Speech& speech, const std::function<void(Tick)>& begin,
              const std::function<void()>& end) {
    Speech heard(speech.size());
    std::size_t step = 0;
    std::map<std::pair<std::string, bool>, bus::OnSample> take;
    for (const std::string uav : {"jurong", "raffles"}) {
      for (const bool gimbal : {false, true}) {
        const auto topic = bus::spec(gimbal ? topics::gimbal_command(uav) : topics::trigger(uav));
        take[{uav, gimbal}] = tap.taken(uav, topic, [&heard, &step, uav, gimbal](bus::Sample&& sample) {
          heard[step].push_back({uav, gimbal, std::move(sample.payload)});
        });
      }
    }
    for (; step < speech.size(); ++step) {
      begin(static_cast<Tick>(step) * kStep);
      for (const Word& word : speech[step]) take.at({word.uav, word.gimbal})({word.payload, 0});
      end();
    }
    return heard;
  }

  /// Records a speech. @returns the file of the recording
  std::filesystem::path record(const Speech& speech) {
    Recorder recorder(folder_, programs::kSimServer, Scope::run);
    EXPECT_EQ(hear(
                  recorder, speech, [&](Tick tick) { recorder.set_time(tick); }, [] {}),
              speech);
    recorder.close();
    return folder_ / run_folder::recording_part(programs::kSimServer, 0);
  }

  Speech replay(const ReplayOptions& options, const Speech& now, std::vector<Difference>& differences) {
    Recorder idle(folder_, programs::kSimServer, Scope::none);
    Replay replay(options, idle);
    Speech heard = hear(
        replay, now, [&](Tick tick) { replay.begin_step(tick); }, [&] { replay.end_step(); });
    differences = replay.differences().list();
    return heard;
  }
};

TEST_F(ReplayTest, PassesOnTheRecordedMessagesWhateverTheUavsSendNow) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    std::filesystem::remove(folder_ / run_folder::recording_part(programs::kSimServer, 0));
    const Speech then = random_speech(seed, 30), now = random_speech(seed + 100, 30);
    const std::filesystem::path file = record(then);
    std::vector<Difference> differences;
    EXPECT_EQ(replay({.file = file, .until_s = {}, .only = {}}, then, differences), then) << seed;
    EXPECT_TRUE(differences.empty());
    EXPECT_EQ(replay({.file = file, .until_s = {}, .only = {}}, now, differences), then) << seed;
    EXPECT_EQ(differences.size(), 2U) << "the first difference of each UAV is reported";
  }
}

TEST_F(ReplayTest, ReportsTheFirstDifferenceOfTheChosenUav) {
  const Speech then = random_speech(7, 40);
  const std::filesystem::path file = record(then);
  std::mt19937_64 random(8);
  for (int round = 0; round < 30; ++round) {
    Speech now = then;
    const std::size_t step = random() % now.size();
    if (now[step].empty()) continue;
    const Word said = now[step][random() % now[step].size()];
    std::erase(now[step], said);
    for (const std::string only : {"jurong", "raffles"}) {
      std::vector<Difference> differences;
      replay({.file = file, .until_s = {}, .only = {only}}, now, differences);
      ASSERT_EQ(differences.size(), only == said.uav ? 1U : 0U);
      if (differences.empty()) continue;
      EXPECT_EQ(differences[0].tick, static_cast<Tick>(step) * kStep);
      EXPECT_EQ(differences[0].node, said.uav);
    }
  }
}

TEST_F(ReplayTest, PassesOnThePresentMessagesFromItsEndOn) {
  const Speech then = random_speech(1, 40), now = random_speech(2, 40);
  const std::filesystem::path file = record(then);
  for (const std::size_t step : {0U, 1U, 17U, 39U}) {
    Speech expected = then;
    std::copy(now.begin() + static_cast<std::ptrdiff_t>(step), now.end(),
              expected.begin() + static_cast<std::ptrdiff_t>(step));
    std::vector<Difference> differences;
    const double until_s = seconds(static_cast<Tick>(step) * kStep);
    EXPECT_EQ(replay({.file = file, .until_s = until_s, .only = {}}, now, differences), expected) << step;
  }
}

/// The messages in which a UAV's program reports its own state in each step, and those that a replay passes on.
class TellsOfItself : public ReplayTest {
 protected:
  using Told = std::vector<mcap::Bytes>;

  static mcap::Bytes activity(const std::string& mode, double cpu_s) {
    msg::Activity message;
    message.mode(mode);
    message.cpu_s(cpu_s);
    return encode(message);
  }
  static mcap::Bytes debug(double value) {
    msg::Float64 message;
    message.data(value);
    return encode(message);
  }
  Told take(bus::Tap& tap, const topics::WireTopic& topic, const Told& said, const std::function<void(Tick)>& begin,
            const std::function<void()>& end) {
    Told heard;
    const auto on_sample = tap.taken("jurong", bus::spec(topic),
                                     [&heard](bus::Sample&& sample) { heard.push_back(std::move(sample.payload)); });
    for (std::size_t step = 0; step < said.size(); ++step) {
      begin(static_cast<Tick>(step) * kStep);
      on_sample({said[step], 0});
      end();
    }
    return heard;
  }
  /// Records the messages `then`, and replays them in a run in which the program says `now`. Sets `differences_`.
  /// @returns the messages that the replay passes on
  Told retold(const topics::WireTopic& then_on, const Told& then, const topics::WireTopic& now_on, const Told& now) {
    const auto part = folder_ / run_folder::recording_part(programs::kSimServer, 0);
    std::filesystem::remove(part);
    Recorder recorder(folder_, programs::kSimServer, Scope::run);
    take(
        recorder, then_on, then, [&](Tick tick) { recorder.set_time(tick); }, [] {});
    recorder.close();
    Recorder idle(folder_, programs::kSimServer, Scope::none);
    Replay replay({.file = part, .until_s = {}, .only = {}}, idle);
    Told heard = take(
        replay, now_on, now, [&](Tick tick) { replay.begin_step(tick); }, [&] { replay.end_step(); });
    differences_ = replay.differences().list().size();
    return heard;
  }
  std::size_t differences_ = 0;
};

TEST_F(TellsOfItself, AnActivityIsTakenFromTheRecordingAndIsNoDifference) {
  const Told then = {activity("takes off", 0.1), activity("delivers", 0.2)};
  const Told now = {activity("takes off", 0.3), activity("has no goal", 0.4)};
  const auto topic = topics::activity("jurong");
  const Told recorded = {activity("takes off", 0.0), activity("delivers", 0.0)};
  EXPECT_EQ(retold(topic, then, topic, now), recorded) << "a recording has no CPU times, which differ from run to run";
  EXPECT_EQ(differences_, 0U) << "activities are information for people, so no difference counts";
  EXPECT_EQ(retold(topics::trigger("jurong"), {debug(1.0), debug(1.0)}, topic, now), now)
      << "an earlier version recorded no activities";
  EXPECT_EQ(differences_, 0U);
}

TEST_F(TellsOfItself, DebugValuesAreTakenFromTheRecordingAndComparedLikeCommands) {
  const auto topic = topics::debug("jurong", "boxes_left");
  const Told then = {debug(3.0), debug(2.0)};
  EXPECT_EQ(retold(topic, then, topic, then), then);
  EXPECT_EQ(differences_, 0U);
  EXPECT_EQ(retold(topic, then, topic, {debug(3.0), debug(1.0)}), then);
  EXPECT_EQ(differences_, 1U);
}

TEST_F(ReplayTest, AFileThatIsCutOffIsRefused) {
  const std::filesystem::path file = record(random_speech(1, 10));
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 9);
  Recorder idle(folder_, programs::kSimServer, Scope::none);
  EXPECT_THROW(Replay({.file = file, .until_s = {}, .only = {}}, idle), InputError);
}

TEST(ReplayDifference, IsDescribedInValidUtf8) {
  msg::String text;
  text.data(std::string("\xFF\x00plan", 6));
  EXPECT_NE(describe(type_name<msg::String>(), encode(text)).find("bytes"), std::string::npos);
  text.data("hello");
  EXPECT_EQ(describe(type_name<msg::String>(), encode(text)), "'hello'");
  EXPECT_NE(describe("their_msgs::msg::dds_::Odd_", encode(text)).find("bytes"), std::string::npos);
}

}  // namespace
}  // namespace skein::recording
