#include "comm_router/count_store.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>
#include <system_error>

namespace skein::router {
namespace {

/// The radio routes of two UAVs, "a" (node 1) and "b" (node 2); "a" sends /talk to all nodes.
std::vector<RadioRoute> routes() {
  Scenario scenario;
  scenario.fleet.resize(2);
  scenario.fleet[0].name = "a";
  scenario.fleet[1].name = "b";
  scenario.radio.push_back({"/talk", "std_msgs/msg/String", {"a"}, {"all"}});
  return radio_routes(scenario);
}

/// Delays message n by n steps.
class SlowLinks final : public LinkModel {
 public:
  LinkFate fate(std::uint64_t, const RadioRoute&, Node, const SentMessage& message) override {
    return {.delay_steps = message.sequence};
  }
};

class CountStoreTest : public testing::Test {
 protected:
  CountStoreTest() { std::filesystem::remove(file_); }
  ~CountStoreTest() override { std::filesystem::remove(file_); }

  std::size_t talk() const {
    return static_cast<std::size_t>(std::ranges::find(routes_, "/talk", &RadioRoute::ros_topic) - routes_.begin());
  }
  SentMessage message(std::uint64_t sequence) const {
    return {talk(), sequence, std::make_shared<const std::vector<std::uint8_t>>(8, std::uint8_t{1})};
  }

  /// Opens the file in a process of its own, which may write files of at most `most_bytes`, and expects a failure.
  void open_in_vain(std::size_t nodes, RunId run, rlim_t most_bytes) const {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      ::signal(SIGXFSZ, SIG_IGN);
      const rlimit limit{most_bytes, most_bytes};
      ::setrlimit(RLIMIT_FSIZE, &limit);
      try {
        const CountStore store(file_, nodes, run);
      } catch (const std::system_error& error) {
        ::_exit(std::string(error.what()).find(file_) != std::string::npos ? 42 : 1);
      }
      ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 42);
  }

  const std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) / ("skein_counts_" + std::to_string(::getpid()));
  const Links linked_{3, {0, 1, 1, 1, 0, 1, 1, 1, 0}};
  const std::vector<RadioRoute> routes_ = routes();
};

TEST_F(CountStoreTest, ANewFileHasNoCounts) {
  const CountStore store(file_, 3);
  EXPECT_EQ(store.earlier_counts(), LinkMatrix<LinkCounts>(3));
}

TEST_F(CountStoreTest, MessagesUnderWayWhenTheRouterDiesCountAsLost) {
  LinkGate gate(routes_, 3, std::make_unique<SlowLinks>());
  {
    CountStore store(file_, 3);
    store.save(gate, gate.gate(0, linked_, {message(0)}));
    store.save(gate, gate.gate(1, linked_, {message(1), message(2)}));  // they arrive one and two steps later
    store.save(gate, gate.gate(2, linked_, {}));  // the router delivers the first of them, and dies
  }
  const LinkCounts to_b = CountStore(file_, 3).earlier_counts().at(Node{1}, Node{2});
  EXPECT_EQ(to_b.sent, 3U);
  EXPECT_EQ(to_b.delivered, 1U);
  EXPECT_EQ(to_b.dropped_fault, 2U);
  EXPECT_EQ(to_b.sent_bytes, 24U);
  EXPECT_EQ(to_b.delivered_bytes, 8U);

  gate.restore(CountStore(file_, 3).earlier_counts());
  EXPECT_EQ(gate.counts().at(Node{1}, Node{2}), to_b);
}

TEST_F(CountStoreTest, ARouterIgnoresTheCountsOfAnotherRun) {
  LinkGate gate(routes_, 3, std::make_unique<SlowLinks>());
  {
    CountStore store(file_, 3, RunId{7});
    store.save(gate, gate.gate(0, linked_, {message(0)}));
  }
  EXPECT_EQ(CountStore(file_, 3, RunId{7}).earlier_counts().at(Node{1}, Node{2}).sent, 1U);
  EXPECT_EQ(CountStore(file_, 3, RunId{8}).earlier_counts().at(Node{1}, Node{2}), LinkCounts{});
  EXPECT_EQ(CountStore(file_, 3, RunId{7}).earlier_counts().at(Node{1}, Node{2}), LinkCounts{})
      << "the file belongs to the other run now";
}

TEST_F(CountStoreTest, OpeningTheFileFailsIfTheDiskIsFull) { open_in_vain(64, RunId::none, 1000); }

TEST_F(CountStoreTest, ARouterThatEndsBeforeTheFileIsWholeLeavesNoCountsOfAnotherRun) {
  LinkGate gate(routes_, 3, std::make_unique<SlowLinks>());
  CountStore(file_, 3, RunId{7}).save(gate, gate.gate(0, linked_, {message(0)}));
  open_in_vain(3, RunId{8}, 100);
  EXPECT_EQ(CountStore(file_, 3, RunId{8}).earlier_counts(), LinkMatrix<LinkCounts>(3));
}

TEST_F(CountStoreTest, ANewFileIsFullyAllocatedSoThatLaterWritesDoNotNeedFreeSpace) {
  const CountStore store(file_, 64);
  struct stat status {};
  ASSERT_EQ(::stat(file_.c_str(), &status), 0);
  EXPECT_GE(status.st_blocks * 512, status.st_size);
}

}  // namespace
}  // namespace skein::router
