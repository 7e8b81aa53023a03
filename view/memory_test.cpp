// The server's memory stays limited, however slow its browsers are and however many messages they get.
#include <gtest/gtest.h>

#include "tests/support/counted_memory.hpp"
#include "view/testing/server_fixture.hpp"

namespace skein::view {
namespace {

class ServerMemory : public ServerTest {};

TEST_F(ServerMemory, DoesNotGrowWithTheDataThatSlowBrowsersHaveNotRead) {
  constexpr std::size_t kBrowsers = 20, kStates = 3000, kStateBytes = 50'000;
  std::vector<std::unique_ptr<Wire>> stuck;
  for (std::size_t i = 0; i < kBrowsers; ++i) stuck.push_back(follower());
  const test::CountedMemory memory;
  for (std::size_t i = 0; i < kStates; ++i) {
    feed_.set_state("{\"n\":\"" + std::string(kStateBytes, 'x') + "\"}");
    if (i % 100 == 0) {  // a normal browser is served meanwhile, so that the server's thread runs
      const auto good = follower();
      EXPECT_NE(good->until([](const std::string& text) { return text.find("\"n\"") != std::string::npos; }), "");
    }
  }
  // The server holds one message for each browser, and copies while it makes a message.
  EXPECT_LT(memory.peak(), 4 * kBrowsers * kStateBytes + (4 << 20));
  EXPECT_GT(memory.allocated(), kStates * kStateBytes) << "the test must send more than the limit";
}

TEST_F(ServerMemory, DoesNotGrowWithClientsWithoutAKey) {
  const test::CountedMemory memory;
  std::vector<std::unique_ptr<Wire>> idle;
  for (int i = 0; i < 400; ++i) {
    idle.push_back(std::make_unique<Wire>(listener_.port()));
    idle.back()->send("POST /enter HTTP/1.1\r\n" + own_host() + "Content-Length: 1000\r\n\r\n" + std::string(900, 'x'));
    EXPECT_TRUE(get("/", own_host()).starts_with("HTTP/1.1 200"));
  }
  EXPECT_LT(memory.peak(), 1U << 20);
}

}  // namespace
}  // namespace skein::view
