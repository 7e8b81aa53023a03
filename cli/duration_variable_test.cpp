#include "cli/duration_variable.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/types.hpp"

namespace skein::cli {
namespace {

TEST(DurationVariable, AppliesToFlightsWithoutTheOption) {
  using Words = std::vector<std::string>;
  EXPECT_EQ(with_duration_of_environment({"run", "towers"}), (Words{"run", "towers"}));
  ::setenv("SKEIN_DURATION", "12.5", 1);
  for (const char* command : {"run", "compose", "compare", "contest"}) {
    EXPECT_EQ(with_duration_of_environment({command}), (Words{command, "--duration", "12.5"}));
    for (const Words& told : {Words{command, "--duration", "3"}, Words{command, "--duration=3"}}) {
      EXPECT_EQ(with_duration_of_environment(told), told);
    }
  }
  EXPECT_EQ(with_duration_of_environment({"run", "--", "towers"}),
            (Words{"run", "--duration", "12.5", "--", "towers"}));
  for (const Words& other : {Words{}, Words{"hunt", "towers"}, Words{"--complete", "run"}, Words{"rerun", "run"}}) {
    EXPECT_EQ(with_duration_of_environment(other), other);
  }
  for (const char* wrong : {"", "0", "-1", "abc", "5s"}) {
    ::setenv("SKEIN_DURATION", wrong, 1);
    EXPECT_THROW(with_duration_of_environment({"run"}), InputError) << wrong;
    EXPECT_NO_THROW(with_duration_of_environment({"run", "--duration", "3"})) << wrong;
  }
  ::unsetenv("SKEIN_DURATION");
}

}  // namespace
}  // namespace skein::cli
