#include "debug/core_file.hpp"

#include <gtest/gtest.h>

namespace skein::cli {
namespace {

TEST(CoreFile, TheNameOfACoreFollowsTheKernelsPattern) {
  EXPECT_EQ(core_name("core", false, 42), "core");
  EXPECT_EQ(core_name("core", true, 42), "core.42");
  EXPECT_EQ(core_name("/tmp/core.%e.%p", true, 42), "/tmp/core.*.42");
  EXPECT_EQ(core_name("100%%-%p%", false, 7), "100%-7");
  EXPECT_EQ(core_name("|/usr/lib/systemd/systemd-coredump %P", true, 42), std::nullopt);
}

}  // namespace
}  // namespace skein::cli
