// What the server says about members that a fault takes out, one call at a time.
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
    client_.start();
    for (int turn = 0; turn < 20 && !joined_; ++turn) {
      server_inbox_.dispatch(kNow);
      joined_ = server_.at_boundary();
      client_inbox_.dispatch(kNow);
      client_.poll();
    }
  }

  std::unique_ptr<bus::Bus> bus_ = bus::make_bus({.vendor = "inproc"});
  std::unique_ptr<bus::Participant> here_ = bus_->join(7), there_ = bus_->join(7);
  bus::Inbox server_inbox_{0}, client_inbox_{0};
  bus::LockstepServer server_{server_inbox_};
  bus::LockstepClient client_{*there_, client_inbox_, "a"};
  bool joined_ = false;
};

TEST_F(OneMember, IsTakenOutAndLetBackOnce) {
  ASSERT_TRUE(joined_);
  EXPECT_FALSE(server_.let_back("a")) << "it is not out";
  EXPECT_FALSE(server_.take_out("nobody", bus::kOrderKill));
  EXPECT_TRUE(server_.is_member("a"));
  EXPECT_TRUE(server_.take_out("a", bus::kOrderStop));
  EXPECT_FALSE(server_.is_member("a"));
  EXPECT_FALSE(server_.take_out("a", bus::kOrderStop)) << "it is out already";
  EXPECT_TRUE(server_.awaited().empty()) << "nobody waits for it";
  EXPECT_TRUE(server_.at_boundary());
  EXPECT_FALSE(server_.let_back("nobody"));
  EXPECT_TRUE(server_.let_back("a"));
  EXPECT_FALSE(server_.let_back("a")) << "it was let back already";
  ASSERT_EQ(server_.awaited().size(), 1U);
  EXPECT_EQ(server_.awaited()[0].member, "a");
  EXPECT_FALSE(server_.at_boundary()) << "until it has joined";
  EXPECT_TRUE(server_.take_lost().empty());
}

TEST_F(OneMember, WhoIsLostWhileItIsOutIsNotLetBack) {
  ASSERT_TRUE(joined_);
  server_.take_out("a", bus::kOrderKill);
  server_.lost("a", "it could not be started again");
  EXPECT_FALSE(server_.let_back("a"));
  const auto lost = server_.take_lost();
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost[0].name, "a");
  EXPECT_EQ(lost[0].reason, "it could not be started again");
  EXPECT_TRUE(server_.take_lost().empty()) << "told once";
  EXPECT_TRUE(server_.at_boundary());
}

}  // namespace
}  // namespace skein::test
