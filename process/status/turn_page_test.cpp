#include "process/status/turn_page.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <iterator>
#include <system_error>

namespace skein {
namespace {

using Names = std::vector<std::string>;

TEST(TurnPage, NamesTheHolderOfTheTurnInEachSeat) {
  TurnPage launchers;
  TurnPage page(launchers.path());
  EXPECT_EQ(launchers.process(), page.process());
  EXPECT_EQ(launchers.holders(), Names{});
  page.enter(0, "sim_server");
  page.enter(7, "uav_agent-a");
  page.enter(TurnPage::kSeats - 1, "uav_agent-b");
  EXPECT_EQ(launchers.turns(7), 1U);
  EXPECT_EQ(launchers.holder(7), "uav_agent-a");
  EXPECT_EQ(launchers.holder(8), "");
  EXPECT_EQ(launchers.holders(), (Names{"sim_server", "uav_agent-a", "uav_agent-b"}));
  page.leave(0);
  page.leave(7);
  EXPECT_EQ(launchers.turns(7), 2U);
  EXPECT_EQ(launchers.holders(), (Names{"uav_agent-b"}));
}

TEST(TurnPage, TheProgramThatGaveAReasonIsReportedAlone) {
  TurnPage launchers;
  TurnPage page(launchers.path());
  page.enter(1, "uav_agent-a");
  page.enter(2, "uav_agent-b");
  page.give_reason("closed what is not its own");
  EXPECT_EQ(launchers.reason(), "closed what is not its own");
  EXPECT_EQ(launchers.holders(), (Names{"uav_agent-a", "uav_agent-b"})) << "either program may have given this reason";
  page.give_reason("says so itself", "uav_agent-b");
  EXPECT_EQ(launchers.holders(), (Names{"uav_agent-b"}));
  launchers.clear();
  EXPECT_EQ(launchers.holders(), Names{});
  EXPECT_EQ(launchers.reason(), "");
}

std::ptrdiff_t open_files() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), std::filesystem::directory_iterator());
}

// The launcher makes a page for each process of a fleet, so pages that cannot be made must not use up its descriptors.
TEST(TurnPage, APageThatCannotBeMadeLeavesNoFileOpen) {
  const std::ptrdiff_t before = open_files();
  EXPECT_THROW(TurnPage("/dev/null"), std::system_error) << "/dev/null cannot be mapped";
  EXPECT_THROW(TurnPage("/no/such/page"), std::system_error);
  EXPECT_EQ(open_files(), before);
  rlimit usual{};
  ::getrlimit(RLIMIT_FSIZE, &usual);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit none{0, usual.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &none);
  EXPECT_THROW(TurnPage(), std::system_error) << "the file of the page cannot grow to its size";
  ::setrlimit(RLIMIT_FSIZE, &usual);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(open_files(), before);
}

TEST(TurnPage, LongNamesAreCut) {
  TurnPage page;
  page.enter(0, std::string(1000, 'x'));
  const std::string holder = page.holder(0);
  EXPECT_FALSE(holder.empty());
  EXPECT_EQ(holder, std::string(holder.size(), 'x'));
}

}  // namespace
}  // namespace skein
