#include "cli/environment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "core/types.hpp"

namespace skein::cli {
namespace {

std::string value_of(const std::vector<std::string>& environment, const std::string& name) {
  EXPECT_LE(std::count_if(environment.begin(), environment.end(), [&](auto& e) { return e.starts_with(name + "="); }),
            1);
  for (const std::string& entry : environment) {
    if (entry.starts_with(name + "=")) return entry.substr(name.size() + 1);
  }
  return "";
}

TEST(Environment, SetsOnTopOfTheLaunchers) {
  ::setenv("SKEIN_TEST_VARIABLE", "old", 1);
  EXPECT_EQ(value_of(environment_with({}), "SKEIN_TEST_VARIABLE"), "old");
  EXPECT_EQ(value_of(environment_with({{"SKEIN_TEST_VARIABLE", "new"}}), "SKEIN_TEST_VARIABLE"), "new");
  ::unsetenv("SKEIN_TEST_VARIABLE");
}

TEST(Environment, ChaosIsANumberOrNotSet) {
  for (const char* wrong : {"abc", "", "-1", "3x"}) {
    ::setenv("SKEIN_CHAOS", wrong, 1);
    EXPECT_THROW(check_environment(), InputError) << wrong;
  }
  ::setenv("SKEIN_CHAOS", "3", 1);
  EXPECT_NO_THROW(check_environment());
  ::unsetenv("SKEIN_CHAOS");
  EXPECT_NO_THROW(check_environment());
}

TEST(Environment, PinsLibmUnlessNative) {
  ::unsetenv("GLIBC_TUNABLES");
  EXPECT_NE(value_of(fleet_environment(false), "GLIBC_TUNABLES").find("-FMA"), std::string::npos);
  EXPECT_EQ(value_of(fleet_environment(true), "GLIBC_TUNABLES"), "");
  EXPECT_EQ(value_of(fleet_environment(true), "LC_ALL"), "C");
  ::setenv("GLIBC_TUNABLES", "glibc.malloc.check=1", 1);
  EXPECT_EQ(value_of(fleet_environment(false), "GLIBC_TUNABLES").find("glibc.malloc.check=1:glibc.cpu"), 0u);
  EXPECT_EQ(value_of(fleet_environment(true), "GLIBC_TUNABLES"), "glibc.malloc.check=1");
  ::unsetenv("GLIBC_TUNABLES");
}

}  // namespace
}  // namespace skein::cli
