#include "process/host/open_files.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cerrno>

namespace skein {
namespace {

TEST(OpenFiles, AFailureForWantOfThemTellsTheLimit) {
  rlimit usual{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &usual), 0);
  const rlimit low{64, usual.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &low), 0);
  const auto limit = open_files_limit();
  const std::string hint = open_files_hint({EMFILE, std::generic_category()});
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &usual), 0);
  EXPECT_EQ(limit, 64U);
  EXPECT_NE(hint.find("64 open files (ulimit -n)"), std::string::npos) << hint;
  for (const int other : {0, ENOENT, ENFILE, EACCES}) {
    EXPECT_EQ(open_files_hint({other, std::generic_category()}), "") << other;
  }
}

}  // namespace
}  // namespace skein
