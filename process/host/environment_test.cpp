// The programs of a fleet inherit only some variables of the launcher's environment.
#include "process/host/environment.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>

namespace skein {
namespace {

using Variables = std::map<std::string, std::string>;

/// Sets variables of this process; the destructor restores their earlier values.
class With {
 public:
  explicit With(const Variables& variables) {
    for (const auto& [name, value] : variables) {
      const char* const before = std::getenv(name.c_str());
      before_[name] = before == nullptr ? std::nullopt : std::optional<std::string>(before);
      ::setenv(name.c_str(), value.c_str(), 1);
    }
  }
  ~With() {
    for (const auto& [name, value] : before_) {
      value ? ::setenv(name.c_str(), value->c_str(), 1) : ::unsetenv(name.c_str());
    }
  }
  With(const With&) = delete;
  With& operator=(const With&) = delete;

 private:
  std::map<std::string, std::optional<std::string>> before_;
};

/// The values of the variables, by name. Expects each name only once.
Variables by_name(const std::vector<std::string>& entries) {
  Variables variables;
  for (const std::string& entry : entries) {
    const std::string name(variable_in(entry));
    EXPECT_TRUE(variables.try_emplace(name, entry.substr(name.size() + 1)).second) << name << " appears twice";
  }
  return variables;
}

Variables mine() {
  std::vector<std::string> entries;
  for (char** entry = environ; *entry != nullptr; ++entry) entries.emplace_back(*entry);
  return by_name(entries);
}

TEST(Environment, SomeVariablesAreSetAndAllOthersStay) {
  const With set({{"SKEIN_TEST_KEPT", "a=b=c"}, {"SKEIN_TEST_CHANGED", "before"}});
  Variables expected = mine();
  expected["SKEIN_TEST_CHANGED"] = "after";
  expected["SKEIN_TEST_NEW"] = "";
  EXPECT_EQ(by_name(environment_with({{"SKEIN_TEST_CHANGED", "after"}, {"SKEIN_TEST_NEW", ""}})), expected);
  EXPECT_EQ(by_name(environment_with({})), mine());
}

TEST(Environment, AFleetInheritsOnlyVariablesThatCannotChangeItsResultAndGetsPins) {
  const With set({{"SKEIN_TEST_KEPT", "x"},
                  {"RMW_IMPLEMENTATION", "rmw_x"},
                  {"CYCLONEDDS_URI", "<x/>"},
                  {"FASTRTPS_DEFAULT_PROFILES_FILE", "x.xml"},
                  {"FASTDDS_STATISTICS", "x"},
                  {"ROS_DOMAIN_ID", "7"},
                  {"SKEIN_DOMAIN", "7"},
                  {"SKEIN_RUN", "another"},
                  {"LC_ALL", "de_DE.UTF-8"},
                  {"OMP_NUM_THREADS", "8"}});
  Variables expected = mine();
  for (const std::string& name : ignored_variables()) expected.erase(name);
  for (const auto& [name, value] : pinned_variables(false)) expected[name] = value;
  EXPECT_EQ(by_name(fleet_environment(false)), expected);
  EXPECT_EQ(expected.at("RMW_IMPLEMENTATION"), "rmw_x") << "ROS 2 nodes of the user need it";
  EXPECT_EQ(expected.at("LC_ALL"), "C");
  for (const char* name : {"CYCLONEDDS_URI", "FASTDDS_STATISTICS", "ROS_DOMAIN_ID", "SKEIN_DOMAIN", "SKEIN_RUN"}) {
    EXPECT_FALSE(expected.contains(name)) << name;
  }
  // The launcher removes these variables from the environment, but sets them to a program's own domain and run.
  const Variables told = by_name(fleet_environment(false, {{"SKEIN_RUN", "mine"}, {"ROS_DOMAIN_ID", "9"}}));
  EXPECT_EQ(told.at("SKEIN_RUN"), "mine");
  EXPECT_EQ(told.at("ROS_DOMAIN_ID"), "9");
  EXPECT_FALSE(told.contains("SKEIN_DOMAIN"));
}

TEST(Environment, IgnoredVariablesAreListedInAlphabeticalOrder) {
  // The environment has them in the order in which they were set.
  const With first({{"ROS_LOCALHOST_ONLY", "1"}, {"SKEIN_TEST_KEPT", "x"}});
  const With then(Variables{{"CYCLONEDDS_URI", "x"}});
  const std::vector<std::string> names = ignored_variables();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  for (const auto& [name, value] : mine()) {
    EXPECT_EQ(std::count(names.begin(), names.end(), name), is_ignored_variable(name) ? 1 : 0) << name;
  }
  EXPECT_TRUE(std::ranges::find(names, "ROS_LOCALHOST_ONLY") != names.end());
}

TEST(Environment, LibmIsTheSameOnEveryMachineUnlessNativeIsWanted) {
  const std::string pin = "glibc.cpu.hwcaps=";
  EXPECT_TRUE(pinned_variables(false).at("GLIBC_TUNABLES").starts_with(pin));
  EXPECT_FALSE(pinned_variables(true).contains("GLIBC_TUNABLES"));
  const With users(Variables{{"GLIBC_TUNABLES", "glibc.malloc.check=3"}});
  EXPECT_TRUE(pinned_variables(false).at("GLIBC_TUNABLES").starts_with("glibc.malloc.check=3:" + pin));
  EXPECT_EQ(by_name(fleet_environment(true)).at("GLIBC_TUNABLES"), "glibc.malloc.check=3");
  const With empty(Variables{{"GLIBC_TUNABLES", ""}});
  EXPECT_TRUE(pinned_variables(false).at("GLIBC_TUNABLES").starts_with(pin));
}

TEST(Environment, PythonIsTheSameOnEveryMachineUnlessNativeIsWanted) {
  const With users(Variables{{"PYTHONHASHSEED", "random"}, {"OPENBLAS_NUM_THREADS", "8"}});
  for (const bool native : {false, true}) {
    const auto environment = by_name(fleet_environment(native));
    EXPECT_EQ(environment.at("PYTHONHASHSEED"), "0");
    EXPECT_EQ(environment.at("OPENBLAS_NUM_THREADS"), "1");
    for (const char* chosen_by_cpu : {"NPY_DISABLE_CPU_FEATURES", "OPENBLAS_CORETYPE"}) {
      EXPECT_EQ(pinned_variables(native).contains(chosen_by_cpu), !native) << chosen_by_cpu;
    }
  }
  for (const auto& [name, value] : pinned_variables(false)) {
    EXPECT_EQ(value.find(' '), std::string::npos) << name << ": printed commands contain the value without quotes";
  }
}

}  // namespace
}  // namespace skein
