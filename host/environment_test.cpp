#include "host/environment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <utility>

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

TEST(Environment, GivenVariablesReplaceThoseOfTheLauncher) {
  ::setenv("SKEIN_TEST_VARIABLE", "old", 1);
  EXPECT_EQ(value_of(environment_with({}), "SKEIN_TEST_VARIABLE"), "old");
  EXPECT_EQ(value_of(environment_with({{"SKEIN_TEST_VARIABLE", "new"}}), "SKEIN_TEST_VARIABLE"), "new");
  ::unsetenv("SKEIN_TEST_VARIABLE");
}

TEST(Environment, ChaosMustBeANumberIfItIsSet) {
  for (const char* wrong : {"abc", "", "-1", "3x"}) {
    ::setenv("SKEIN_CHAOS", wrong, 1);
    EXPECT_THROW(check_environment(), InputError) << wrong;
  }
  ::setenv("SKEIN_CHAOS", "3", 1);
  EXPECT_NO_THROW(check_environment());
  ::unsetenv("SKEIN_CHAOS");
  EXPECT_NO_THROW(check_environment());
}

using Values = std::map<std::string, std::string>;

/// Sets environment variables, until it is destroyed.
class Variables {
 public:
  explicit Variables(Values values) : values_(std::move(values)) {
    for (const auto& [name, value] : values_) ::setenv(name.c_str(), value.c_str(), 1);
  }
  ~Variables() {
    for (const auto& [name, value] : values_) ::unsetenv(name.c_str());
  }

 private:
  Values values_;
};

TEST(Environment, ProgramsDoNotInheritVariablesThatConfigureDds) {
  const Values hostile = {{"ROS_DISCOVERY_SERVER", "127.0.0.1:11811"},
                          {"ROS_SUPER_CLIENT", "TRUE"},
                          {"ROS_DOMAIN_ID", "7"},
                          {"ROS_LOCALHOST_ONLY", "1"},
                          {"ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF"},
                          {"FASTRTPS_DEFAULT_PROFILES_FILE", "/x.xml"},
                          {"FASTDDS_ENVIRONMENT_FILE", "/x.json"},
                          {"FASTDDS_STATISTICS", "RTPS_SENT_TOPIC"},
                          {"CYCLONEDDS_URI", "file:///x.xml"},
                          {"RMW_FASTRTPS_USE_QOS_FROM_XML", "1"},
                          {"SKEIN_SECURITY", "/keys"},
                          {"SKEIN_DOMAIN", "9"}};
  const Variables set(hostile);
  for (const auto& [name, value] : hostile) EXPECT_EQ(value_of(fleet_environment(false), name), "") << name;
  EXPECT_EQ(ignored_variables().size(), hostile.size());
  ASSERT_EQ(environment_warnings().size(), 1u) << "one warning names them all";
  for (const auto& [name, value] : hostile) {
    EXPECT_NE(environment_warnings()[0].find(name), std::string::npos) << name;
    EXPECT_NE(fleet_environment_prefix(false).find("-u " + name + " "), std::string::npos) << name;
  }
  // The launcher may set some of these variables for a program. In this way, a user's command gets its UAV's domain.
  EXPECT_EQ(value_of(fleet_environment(false, {{"SKEIN_DOMAIN", "3"}}), "SKEIN_DOMAIN"), "3");
  EXPECT_EQ(value_of(fleet_environment(false, {{"ROS_DOMAIN_ID", "3"}}), "ROS_DOMAIN_ID"), "3");
}

TEST(Environment, ProgramsInheritOtherVariables) {
  const Variables set(
      Values{{"LD_PRELOAD", ""}, {"TZ", "Pacific/Chatham"}, {"RMW_IMPLEMENTATION", "rmw_cyclonedds_cpp"}});
  const std::vector<std::string> environment = fleet_environment(false);
  EXPECT_EQ(value_of(environment, "TZ"), "Pacific/Chatham");
  EXPECT_EQ(value_of(environment, "RMW_IMPLEMENTATION"), "rmw_cyclonedds_cpp");
  EXPECT_TRUE(environment_warnings().empty());
}

TEST(Environment, DoesNotWarnOfVariablesThatSkeinReads) {
  const Variables set(Values{{"SKEIN_THREADS", "2"}, {"SKEIN_LAUNCHER", "/x/skein"}, {"SKEIN_LOADER", "/x/ld.so"}});
  EXPECT_TRUE(environment_warnings().empty()) << environment_warnings()[0];
}

TEST(Environment, WarnsOfUnknownSkeinVariables) {
  const Variables set(Values{{"SKEIN_CHOAS", "3"}});
  ASSERT_EQ(environment_warnings().size(), 1u);
  EXPECT_NE(environment_warnings()[0].find("SKEIN_CHOAS; did you mean 'SKEIN_CHAOS'?"), std::string::npos)
      << environment_warnings()[0];
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
