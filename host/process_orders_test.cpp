#include "host/process_orders.hpp"

#include <gtest/gtest.h>

#include <csignal>

#include "host/supervisor.hpp"
#include "host/testing/fake_programs.hpp"
#include "process/host/environment.hpp"

namespace skein::cli {
namespace {

constexpr std::chrono::milliseconds kForever{-1};

class ProcessOrdersTest : public ::testing::Test {
 protected:
  void start(const std::string& script) {
    supervisor_.start({"a", {"/bin/sh", "-c", script}, environment_with({}), scratch_.path() / "a.log"});
  }
  /// Waits for the program's end. @returns whether the end was ordered.
  bool end_was_ordered() {
    while (true) {
      for (const Event& event : supervisor_.wait(kForever)) {
        if (event.kind == Event::Kind::exited) return orders_.on_exit(event.program, event.exit);
      }
    }
  }
  std::vector<std::string> wait_for_returning() {
    while (true) {
      supervisor_.wait(orders_.limit(kForever));
      if (const auto programs = orders_.take_returning(); !programs.empty()) return programs;
    }
  }

  ScratchDir scratch_;
  Supervisor supervisor_;
  ProcessOrders orders_{supervisor_};
  const std::vector<std::string> a_{"a"};
};

TEST_F(ProcessOrdersTest, AnOrderedDeathIsNoFailureAndTheProgramMayReturn) {
  start("read line <&4; kill -KILL $$");
  orders_.take_out("a", true, false);
  orders_.let_back("a");
  EXPECT_TRUE(orders_.take_returning().empty()) << "the program still lives";
  supervisor_.send("a", "go");
  EXPECT_TRUE(end_was_ordered());
  EXPECT_EQ(orders_.take_returning(), a_);
  EXPECT_TRUE(orders_.take_returning().empty()) << "each return is reported once";
  EXPECT_TRUE(orders_.out().contains("a")) << "a program is out until it has joined again";
  orders_.returned("a");
  EXPECT_TRUE(orders_.out().empty());
}

TEST_F(ProcessOrdersTest, AnyOtherEndIsAFailure) {
  start("exit 5");
  orders_.take_out("a", true, false);
  EXPECT_FALSE(end_was_ordered());
  EXPECT_TRUE(orders_.out().empty());
  start("read line <&4; exit 5");
  orders_.take_out("a", false, false);
  supervisor_.signal("a", SIGKILL);
  EXPECT_FALSE(end_was_ordered()) << "the order was to stop, not to die";
}

TEST_F(ProcessOrdersTest, ASecondDeathWithoutAnOrderIsAFailure) {
  start("kill -KILL $$");
  orders_.take_out("a", true, false);
  EXPECT_TRUE(end_was_ordered());
  orders_.let_back("a");
  EXPECT_EQ(orders_.take_returning(), a_);
  start("kill -KILL $$");
  EXPECT_FALSE(end_was_ordered());
}

TEST_F(ProcessOrdersTest, AProgramReturnsOnlyAfterItWasSeenToBeStopped) {
  start("read line <&4; kill -STOP $$; read line <&4");
  orders_.take_out("a", false, false);
  orders_.let_back("a");
  EXPECT_TRUE(orders_.take_returning().empty()) << "a SIGCONT before the stop would be lost";
  supervisor_.send("a", "go");
  EXPECT_EQ(wait_for_returning(), a_);
  supervisor_.signal("a", SIGCONT);
  supervisor_.send("a", "go");
  while (supervisor_.running("a")) supervisor_.wait(kForever);
}

TEST_F(ProcessOrdersTest, TheLauncherKillsAndStopsAProgramThatKnowsNoOrders) {
  start("read line <&4");
  orders_.take_out("a", false, true);
  orders_.let_back("a");
  EXPECT_EQ(wait_for_returning(), a_);
  orders_.take_out("a", true, true);
  EXPECT_TRUE(end_was_ordered());
}

TEST_F(ProcessOrdersTest, AProgramThatIsOutAtTheEndOfTheRunIsKilledAndIsNoFailure) {
  start("kill -STOP $$");
  orders_.take_out("a", false, false);
  orders_.end();
  EXPECT_TRUE(end_was_ordered());
}

}  // namespace
}  // namespace skein::cli
