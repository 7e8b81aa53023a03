#include "process/host/open_files.hpp"

#include <gtest/gtest.h>

#include <cerrno>

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

}  // namespace
}  // namespace skein
