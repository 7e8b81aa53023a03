#include "cli/place/host_link.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "core/types.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/scratch_folder.hpp"

namespace skein::cli {
namespace {

class HostLinkFrames : public testing::Test {
 protected:
  /// A host that sends these bytes at once, and keeps the connection open until the launcher closes it.
  PlacedHost host_that_says(const std::string& bytes) const {
    std::ofstream(said(), std::ios::binary) << kHostGreeting << '\n' << bytes;
    return {"there", {}, {"/bin/sh", "-c", "cat '" + said().string() + "'; exec cat >/dev/null"}};
  }
  std::filesystem::path said() const { return scratch_.path() / "said"; }
  std::filesystem::path log() const { return scratch_.path() / "log"; }

  const ScratchFolder scratch_;
};

// Frames that a host sends after an answer may arrive together with the answer or later. Both must work.
TEST_F(HostLinkFrames, FramesThatFollowAnAnswerAreReceived) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 10; ++trial) {
    const std::size_t before = random() % 3, after = 1 + random() % 5;
    std::string bytes;
    for (std::size_t i = 0; i < before; ++i) bytes += bytes_of({{"say", "log"}, {"number", "early"}});
    bytes += bytes_of({{"say", "hello"}, {"build", "b"}});
    for (std::size_t i = 0; i < after; ++i) {
      bytes += bytes_of({{"say", i % 2 == 0 ? "log" : "alive"}, {"number", std::to_string(i)}}, std::string(i, 'x'));
    }
    bytes += bytes_of({{"say", "trouble"}, {"number", "last"}});
    HostLink link(host_that_says(bytes), log());
    EXPECT_EQ(link.answer("hello").text("build"), "b");
    std::vector<std::string> expected, taken;
    for (std::size_t i = 0; i < after; i += 2)
      expected.push_back(std::to_string(i));  // frames with "alive" are not passed on
    expected.emplace_back("last");
    ASSERT_TRUE(eventually([&] {
      for (const Frame& frame : link.take()) taken.push_back(frame.text("number"));
      return taken.size() >= expected.size();
    })) << taken.size()
        << " frames of " << expected.size();
    EXPECT_EQ(taken, expected);
  }
}

TEST_F(HostLinkFrames, AnErrorInsteadOfAnAnswerIsReported) {
  HostLink link(host_that_says(bytes_of({{"say", "trouble"}, {"text", "no room"}})), log());
  try {
    link.answer("hello");
    ADD_FAILURE() << "no error, although the host did not answer";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()), "--place: there: no room");
  }
}

}  // namespace
}  // namespace skein::cli
