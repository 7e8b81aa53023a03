#include "process/host/open_files.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <string>

#include "core/types.hpp"
#include "tests/support/limited_files.hpp"

namespace skein {
namespace {

TEST(OpenFiles, AFailureForLackOfDescriptorsNamesTheLimit) {
  const LimitedOpenFiles low(64);
  const auto limit = open_files_limit();
  const std::string hint = open_files_hint({EMFILE, std::generic_category()});
  EXPECT_EQ(limit, 64U);
  EXPECT_NE(hint.find("64 open files (ulimit -n)"), std::string::npos) << hint;
  for (const int other : {0, ENOENT, ENFILE, EACCES}) {
    EXPECT_EQ(open_files_hint({other, std::generic_category()}), "") << other;
  }
}

TEST(OpenFiles, TheLimitIsRaisedAsFarAsTheSystemPermits) {
  const LimitedOpenFiles low(64);
  raise_open_files_limit(32);
  EXPECT_EQ(open_files_limit(), 64U) << "a limit is never lowered";
  raise_open_files_limit(100);
  EXPECT_EQ(open_files_limit(), 100U);
  EXPECT_EQ(done_with_open_files(80,
                                 [] {
                                   raise_open_files_limit(100);
                                   return std::to_string(open_files_limit().value_or(0));
                                 }),
            "80");
}

TEST(OpenFiles, ALimitIsComparedWithTheNeed) {
  constexpr OpenFilesNeed kNeed{50, 60};
  for (const std::uint64_t limit : {60U, 1024U}) EXPECT_EQ(judge_open_files_limit("a fleet", kNeed, limit), "");
  const std::string warning = judge_open_files_limit("a fleet", kNeed, 50);
  EXPECT_EQ(warning.find("a process may have 50 open files (ulimit -n), and a fleet needs about 60; "), 0U) << warning;
  EXPECT_NE(warning.find("`ulimit -n 60`"), std::string::npos) << warning;
  EXPECT_THROW(judge_open_files_limit("a fleet", kNeed, 49), InputError);
}

TEST(OpenFiles, AProgramGetsTheDescriptorsThatItNeedsOrIsRefused) {
  constexpr OpenFilesNeed kNeed{50, 60};
  const LimitedOpenFiles low(40);
  EXPECT_EQ(done_with_open_files(55, [&] { return provide_open_files("it", kNeed); }).find("a process may have 55"),
            0U);
  EXPECT_EQ(done_with_open_files(45, [&] { return "accepted: " + provide_open_files("it", kNeed); })
                .find("a process may have 45 open files"),
            0U);
  EXPECT_EQ(provide_open_files("it", kNeed), "");
  EXPECT_EQ(open_files_limit(), 60U);
}

// Measured: the server of 5 UAVs had 64 open files over Cyclone DDS and 74 over Fast DDS, the station with a page 31
// and 36, an agent 16 and 20.
TEST(OpenFiles, TheNeedOverDdsIsAtLeastWhatWasMeasured) {
  EXPECT_GE(open_files_over_dds(7, false).least, 64U);
  EXPECT_GE(open_files_over_dds(7, true).least, 74U);
  EXPECT_GE(open_files_over_dds(2, false).least, 31U);
  EXPECT_GE(open_files_over_dds(2, true).least, 36U);
  EXPECT_GE(open_files_over_dds(1, false).least, 16U);
  EXPECT_GE(open_files_over_dds(1, true).least, 20U);
  for (std::uint64_t domains = 1; domains <= 130; ++domains) {
    for (const bool fast : {false, true}) {
      const OpenFilesNeed need = open_files_over_dds(domains, fast);
      EXPECT_LE(need.least, need.ample) << domains;
    }
  }
}

}  // namespace
}  // namespace skein
