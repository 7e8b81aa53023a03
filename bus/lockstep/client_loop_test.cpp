// A program that waits says for what.
#include "bus/lockstep/client_loop.hpp"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <sstream>

namespace skein::bus {
namespace {

TEST(ClientLoop, SaysWhatItWaitsForNowAndThen) {
  std::ostringstream text;
  const auto before = spdlog::default_logger();
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text)));
  const auto bus = make_bus({.vendor = "inproc"});
  const auto participant = bus->join(0);
  Inbox inbox(0);
  LockstepClient client(*participant, inbox, "jurong");
  StopSignal stop;
  stop.on_stop([&] { inbox.wake(); });
  int looks = 0;
  const auto serve = [&] {
    if (++looks == 200) stop.stop();  // of 2 ms each
    return true;
  };
  const ClientLoop loop{.think = [] {},
                        .serve = serve,
                        .answered_last = [] { return false; },
                        .first_word = std::chrono::milliseconds(10)};
  EXPECT_EQ(run_client(client, inbox, loop, stop), LoopEnd::stopped);
  spdlog::set_default_logger(before);
  const std::string said = text.str(), word = "waiting for an invitation from sim_server";
  std::size_t times = 0;
  for (std::size_t at = said.find(word); at != std::string::npos; at = said.find(word, at + 1)) ++times;
  EXPECT_GE(times, 2U) << said;
  EXPECT_LE(times, 20U) << "each time after twice as long";
}

}  // namespace
}  // namespace skein::bus
