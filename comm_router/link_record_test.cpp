// The record has only capture reports that a link lost or delayed, also after a restart of the router.
#include "comm_router/link_record.hpp"

#include <gtest/gtest.h>

#include "core/radio/radio_routes.hpp"
#include "tests/support/text_files.hpp"

namespace skein::router {
namespace {

/// Links with the effects that the test sets.
class ToldLinks final : public LinkModel {
 public:
  explicit ToldLinks(LinkFate fate) : fate_(fate) {}
  LinkFate fate(std::uint64_t, const RadioRoute&, Node, const SentMessage&) override { return fate_; }

 private:
  LinkFate fate_;
};

class LinkRecordTest : public testing::Test {
 protected:
  LinkRecordTest() : folder_(std::filesystem::path(testing::TempDir()) / "skein_link_record") {
    std::filesystem::create_directories(folder_);
    UavConfig uav;
    uav.name = "changi";
    scenario_.fleet.push_back(uav);
  }
  ~LinkRecordTest() override { std::filesystem::remove_all(folder_); }

  /// Starts a router whose links give each message this fate, sends one message, and ends the router.
  void send(LinkFate fate, std::uint64_t k, const std::string& topic = captures_topic("changi"),
            Node target = kStationNode) {
    RadioRoute route;
    route.source = Node{1};
    route.ros_topic = topic;
    LinkRecord record(std::make_unique<ToldLinks>(fate), scenario_, folder_, unwritten_);
    EXPECT_EQ(record.fate(k, route, target, {}).delay_steps, fate.delay_steps);
  }
  std::string written() const { return read_text(folder_ / "capture_messages.csv"); }

  std::filesystem::path folder_;
  Scenario scenario_;
  std::vector<std::string> unwritten_;
};

TEST_F(LinkRecordTest, IdealLinksLeaveNoFile) {
  send({}, 5);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "capture_messages.csv"));
}

TEST_F(LinkRecordTest, LossAndDelayOfCaptureReportsAreRecorded) {
  send({.loss = LinkLoss::fault}, 5);
  send({.delay_steps = 3}, 6);
  send({.loss = LinkLoss::overflow}, 7);
  send({.loss = LinkLoss::fault}, 8, "/broadcast");
  send({.loss = LinkLoss::fault}, 9, captures_topic("changi"), Node{2});
  EXPECT_EQ(written(), "step,uav,arrives\n5,changi,\n6,changi,10\n7,changi,\n");
}

TEST_F(LinkRecordTest, AWriteErrorIsReportedOnceAndLinksGoOn) {
  std::filesystem::create_symlink("/dev/full", folder_ / "capture_messages.csv");
  send({.delay_steps = 3}, 6);
  EXPECT_EQ(unwritten_.size(), 1U);
  EXPECT_NE(unwritten_[0].find("capture_messages.csv: No space left"), std::string::npos) << unwritten_[0];
}

}  // namespace
}  // namespace skein::router
