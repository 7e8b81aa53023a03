// A waiting program reports what it waits for.
#include "bus/lockstep/client_node.hpp"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <sstream>

#include "bus/lockstep/names.hpp"
#include "core/topics.hpp"

namespace skein::bus {
namespace {

/// A client to which no server ever speaks.
class Lonely final : public ClientNode {
 public:
  Lonely(Bus& bus, StopSignal& stop)
      : participant_(bus.join(0)), client_(*participant_, inbox_, "jurong"), stop_(stop) {}
  Inbox& inbox() override { return inbox_; }
  ParticipantId id() const { return participant_->id(); }

 private:
  LockstepClient& client() override { return client_; }
  void think() override {}
  bool serve() override {
    if (++looks_ == 200) stop_.stop();  // a look takes 2 ms
    return true;
  }
  bool answered_last() const override { return false; }
  std::chrono::milliseconds first_word() const override { return std::chrono::milliseconds(10); }

  Inbox inbox_{0};
  std::unique_ptr<Participant> participant_;
  LockstepClient client_;
  StopSignal& stop_;
  int looks_ = 0;
};

TEST(ClientNode, LogsWhatItWaitsForLessAndLessOften) {
  std::ostringstream text;
  const auto before = spdlog::default_logger();
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text)));
  const auto bus = make_bus({.vendor = "inproc"});
  StopSignal stop;
  Lonely node(*bus, stop);
  EXPECT_EQ(run_node(node, &stop), NodeEnd::stopped);
  spdlog::set_default_logger(before);
  const std::string said = text.str(), word = "waiting for an invitation from sim_server";
  std::size_t times = 0;
  for (std::size_t at = said.find(word); at != std::string::npos; at = said.find(word, at + 1)) ++times;
  EXPECT_GE(times, 2U) << said;
  EXPECT_LE(times, 20U) << "the pause between two messages doubles each time";
}

/// A server that sends only its invitation. `matches`: whether the endpoints of the two have found each other by then.
class Host {
 public:
  Host(Bus& bus, bool matches) : participant_(bus.join(0)) {
    if (!matches) return;
    step_ = std::make_unique<CountedWriter>(*participant_, spec(topics::step()));
    done_ = participant_->create_reader(done_spec("jurong"), [](Sample&&) {});
  }
  void invite(ParticipantId member) {
    auto resync = message_of<msg::Resync>(RunId{});
    resync.source(member);
    resync_.begin_step();
    resync_.write(resync);
  }

 private:
  std::unique_ptr<Participant> participant_;
  CountedWriter resync_{*participant_, spec(topics::resync())};
  std::unique_ptr<CountedWriter> step_;
  std::unique_ptr<Reader> done_;
};

/// How the run ends for a member whose first idle turn comes after the server has invited it and left.
std::optional<NodeEnd> end_without_idle_turns(bool matches) {
  const auto bus = make_bus({.vendor = "inproc"});
  StopSignal stop;
  Lonely node(*bus, stop);
  node.start();
  auto host = std::make_unique<Host>(*bus, matches);
  host->invite(node.id());
  EXPECT_TRUE(node.inbox().dispatch(std::chrono::seconds(10)));
  node.turn(true);
  EXPECT_EQ(node.end(), std::nullopt);
  host.reset();
  node.turn(false);
  return node.end();
}

TEST(ClientNode, AMemberThatNeverHadAnIdleTurnFindsThatTheServerHasGone) {
  EXPECT_EQ(end_without_idle_turns(true), NodeEnd::finished)
      << "the node ends without an error, because it was not a member yet";
}

TEST(ClientNode, ANodeThatIsInvitedBeforeItHasFoundTheServerKeepsWaiting) {
  EXPECT_EQ(end_without_idle_turns(false), std::nullopt) << "a server that has not been found yet cannot have gone";
}

}  // namespace
}  // namespace skein::bus
