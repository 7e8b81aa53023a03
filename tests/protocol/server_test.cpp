// The server's decisions about members that join, are absent by a fault, or are lost, tested call by call.
#include "bus/lockstep/server.hpp"

#include <gtest/gtest.h>

#include "bus/lockstep/client.hpp"
#include "bus/lockstep/names.hpp"

namespace skein::test {
namespace {

constexpr std::chrono::milliseconds kNow{0};

class OneMember : public testing::Test {
 protected:
  OneMember() {
    server_.add_domain("", *here_);
    server_.add_place("a", 0, true);
    server_.add_place("b", 0, false);
    client_.start();
    joined_ = boundary();
  }

  /// Runs a boundary between two steps until no member waits to join.
  bool boundary() {
    bool closed = false;
    for (int turn = 0; turn < 20; ++turn) {
      server_inbox_.dispatch(kNow);
      closed = server_.at_boundary();
      client_inbox_.dispatch(kNow);
      client_.poll();
      other_.poll();
    }
    return closed;
  }
  /// Runs one step, which all members answer. @returns the epoch that the first member received with it.
  std::uint32_t step() {
    server_.publish({.k = k_, .tick = static_cast<std::int64_t>(20 * k_), .links = {}, .ledger_upto = 0});
    for (int turn = 0; turn < 20 && !server_.answered(); ++turn) {
      client_inbox_.dispatch(kNow);
      for (bus::LockstepClient* client : {&client_, &other_}) {
        if (client->poll() == bus::LockstepClient::Event::think) client->done();
      }
      server_inbox_.dispatch(kNow);
    }
    EXPECT_TRUE(server_.awaited().empty()) << "step " << k_;
    EXPECT_EQ(client_.step().k(), k_++);
    return client_.step().epoch();
  }

  std::unique_ptr<bus::Bus> bus_ = bus::make_bus({.vendor = "inproc"});
  std::unique_ptr<bus::Participant> here_ = bus_->join(7), there_ = bus_->join(7), elsewhere_ = bus_->join(7);
  bus::Inbox server_inbox_{0}, client_inbox_{0};
  bus::LockstepServer server_{server_inbox_};
  bus::LockstepClient client_{*there_, client_inbox_, "a"}, other_{*elsewhere_, client_inbox_, "b"};
  std::uint64_t k_ = 0;
  bool joined_ = false;
};

TEST_F(OneMember, IsTakenOutAndLetBackOnce) {
  ASSERT_TRUE(joined_);
  EXPECT_FALSE(server_.let_back("a")) << "a member that is not out was let back";
  EXPECT_FALSE(server_.take_out("nobody", bus::kOrderKill));
  EXPECT_TRUE(server_.is_member("a"));
  EXPECT_TRUE(server_.take_out("a", bus::kOrderStop));
  EXPECT_FALSE(server_.is_member("a"));
  EXPECT_FALSE(server_.take_out("a", bus::kOrderStop)) << "a member was taken out twice";
  EXPECT_TRUE(server_.awaited().empty()) << "the server waits for a member that is out";
  EXPECT_TRUE(server_.at_boundary());
  EXPECT_FALSE(server_.let_back("nobody"));
  EXPECT_TRUE(server_.let_back("a"));
  EXPECT_FALSE(server_.let_back("a")) << "a member was let back twice";
  ASSERT_EQ(server_.awaited().size(), 1U);
  EXPECT_EQ(server_.awaited()[0].member, "a");
  EXPECT_FALSE(server_.at_boundary()) << "the step begins although the member has not joined yet";
  EXPECT_TRUE(server_.take_lost().empty());
}

TEST_F(OneMember, AnEpochLastsAsLongAsTheMembersStayTheSame) {
  ASSERT_TRUE(joined_);
  const std::uint32_t alone = step();
  ASSERT_TRUE(boundary());
  EXPECT_EQ(step(), alone);
  other_.start();
  ASSERT_TRUE(boundary());
  ASSERT_TRUE(server_.is_member("b"));
  EXPECT_EQ(step(), alone + 1);
  ASSERT_TRUE(boundary());
  EXPECT_EQ(step(), alone + 1);
  ASSERT_TRUE(server_.take_out("b", bus::kOrderKill));
  ASSERT_TRUE(boundary());
  other_.obey_with([](bus::LockstepClient::Order) {});
  EXPECT_EQ(step(), alone + 2);
}

TEST_F(OneMember, AMemberThatIsLostWhileItIsOutIsNotLetBack) {
  ASSERT_TRUE(joined_);
  server_.take_out("a", bus::kOrderKill);
  server_.lost("a", "it could not be started again");
  EXPECT_FALSE(server_.let_back("a"));
  const auto lost = server_.take_lost();
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost[0].name, "a");
  EXPECT_EQ(lost[0].reason, "it could not be started again");
  EXPECT_TRUE(server_.take_lost().empty()) << "the loss was reported twice";
  EXPECT_TRUE(server_.at_boundary());
}

/// The second member hangs after its hello, or before its declaration, and the server gives it up: before the first
/// step, or after some steps.
class GivenUp : public OneMember, public testing::WithParamInterface<std::tuple<bool, std::uint64_t>> {
 protected:
  GivenUp() {
    const auto [matching, steps] = GetParam();
    while (k_ < steps) step();
    other_.start();
    server_inbox_.dispatch(kNow);
    EXPECT_FALSE(server_.at_boundary()) << "the server must wait for the second member, which it has invited";
    if (matching) client_inbox_.dispatch(kNow);
    server_.lost("b", "did not join in time");
  }
};

TEST_P(GivenUp, TheMemberIsToldThatTheFleetContinuesWithoutIt) {
  ASSERT_EQ(server_.take_lost().size(), 1U);
  EXPECT_TRUE(boundary()) << "the server waits for a member that it has given up";
  EXPECT_TRUE(server_.awaited().empty());
  step();
  step();
  EXPECT_EQ(other_.poll(), bus::LockstepClient::Event::dropped) << other_.waiting_for();
  EXPECT_TRUE(boundary());
  EXPECT_FALSE(server_.is_member("b")) << "a participant that was given up must not join again";
  EXPECT_TRUE(server_.take_lost().empty()) << "the loss was reported twice";
  EXPECT_TRUE(server_.take_rejoined().empty());
}

TEST_P(GivenUp, AProgramThatIsStartedInItsPlaceJoinsLikeARestartedOne) {
  ASSERT_EQ(server_.take_lost().size(), 1U);
  ASSERT_TRUE(boundary());
  step();
  const auto anew = bus_->join(7);
  bus::LockstepClient successor(*anew, client_inbox_, "b");
  successor.start();
  bool closed = false;
  for (int turn = 0; turn < 20; ++turn) {
    closed = boundary();
    successor.poll();
  }
  EXPECT_TRUE(closed);
  EXPECT_TRUE(server_.is_member("b"));
  EXPECT_EQ(server_.take_rejoined(), std::vector<std::string>{"b"}) << "the return of b must be reported";
  EXPECT_TRUE(server_.take_lost().empty());
  server_.lost("b", "its process ended");
  EXPECT_EQ(server_.take_lost().size(), 1U);
}

TEST_P(GivenUp, AMemberThatJoinsAndIsLostAtOneBoundaryHasNotComeBack) {
  const auto anew = bus_->join(7);
  bus::LockstepClient successor(*anew, client_inbox_, "b");
  successor.start();
  for (int turn = 0; turn < 20; ++turn) {
    boundary();
    successor.poll();
  }
  ASSERT_TRUE(server_.is_member("b"));
  server_.lost("b", "its process ended");
  EXPECT_EQ(server_.take_lost().size(), 2U);
  EXPECT_TRUE(server_.take_rejoined().empty());
}

INSTANTIATE_TEST_SUITE_P(Cases, GivenUp, testing::Combine(testing::Bool(), testing::Values(0, 1, 5)));

}  // namespace
}  // namespace skein::test
