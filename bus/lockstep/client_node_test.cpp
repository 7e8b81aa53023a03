// A program that waits says for what.
#include "bus/lockstep/client_node.hpp"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <sstream>

namespace skein::bus {
namespace {

/// Somebody to whom no server ever speaks.
class Lonely final : public ClientNode {
 public:
  Lonely(Bus& bus, StopSignal& stop)
      : participant_(bus.join(0)), client_(*participant_, inbox_, "jurong"), stop_(stop) {}
  Inbox& inbox() override { return inbox_; }

 private:
  LockstepClient& client() override { return client_; }
  void think() override {}
  bool serve() override {
    if (++looks_ == 200) stop_.stop();  // of 2 ms each
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

TEST(ClientNode, SaysWhatItWaitsForNowAndThen) {
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
  EXPECT_LE(times, 20U) << "each time after twice as long";
}

}  // namespace
}  // namespace skein::bus
