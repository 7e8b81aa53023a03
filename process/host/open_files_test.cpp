#include "process/host/open_files.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <string>

#include "tests/support/limited_files.hpp"

namespace skein {
namespace {

TEST(OpenFiles, AFailureForWantOfThemTellsTheLimit) {
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
  EXPECT_EQ(open_files_limit(), 64U) << "never lowered";
  raise_open_files_limit(100);
  EXPECT_EQ(open_files_limit(), 100U);
  EXPECT_EQ(done_with_open_files(80,
                                 [] {
                                   raise_open_files_limit(100);
                                   return std::to_string(open_files_limit().value_or(0));
                                 }),
            "80");
}

}  // namespace
}  // namespace skein
