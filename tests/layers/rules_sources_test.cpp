// The rule on the sources of numbers, on small files that keep it and break it.
#include <gtest/gtest.h>

#include <sstream>

#include "tests/layers/rules.hpp"

namespace skein::layers {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

SourceFile cpp_file(const std::string& path, const std::string& text) {
  return {path, lines_of(text), lines_of(blank_comments_and_literals(text)), lines_of(only_comments(text)), {}};
}

/// "line: number" of each number without a source in a file of the agent.
std::vector<std::string> bare_in(const std::string& text, const std::string& path = "uav_agent/maps/a.hpp") {
  std::vector<std::string> found;
  for (const std::string& violation : check_sources({cpp_file(path, text)})) {
    EXPECT_TRUE(violation.starts_with(path + ":")) << violation;
    const std::string place = violation.substr(path.size() + 1);
    found.push_back(place.substr(0, place.find(" has")));
  }
  return found;
}

using Numbers = std::vector<std::string>;

TEST(SourcesOfNumbers, MayBeInTheLineOrAboveTheStatement) {
  EXPECT_EQ(bare_in("constexpr double kFarM = 40.0;  ///< chosen\n"
                    "/// Measured: 0.48 m.\n/// In tests.\nconstexpr double kA[] = {\n    1.5,\n    2.5,\n};\n"
                    "  double margin_m = 0.3;  ///< sensor\n"
                    "// Formula: a half turn.\nf(x,\n  0.25);\n"),
            Numbers{});
  EXPECT_EQ(bare_in("constexpr double kFarM = 40.0;  ///< far away, unchosen\n"
                    "constexpr int kMost = 2;\n"
                    "  double margin_m = 1.0;\n"
                    "  int count = 0x7F;\n"
                    "/// Chosen.\nf(0.25);\n\nf(-1.5e-3, 4);\n"),
            (Numbers{"1: 40.0", "2: 2", "3: 1.0", "4: 0x7F", "8: 1.5e-3", "8: 4"}));
}

TEST(SourcesOfNumbers, AreNotNeededForPlainNumbersAndBits) {
  EXPECT_EQ(bare_in("constexpr int kNone = 0, kFirst = 1;\n"
                    "  int count = 0;\n"
                    "const double half = 0.5 * (a + b) / 2.0 - 1.0 + 2 * x3 + v_4.y;\n"
                    "for (int axis = 0; axis < 3; ++axis) a[7] = b % 10 + (c & 63) + (d << 16);\n"
                    "std::array<int, 26> e;  // 4.5\nf(\"0.7\");\nEigen::Matrix<double, 6> g;\n#if X > 20\n"),
            Numbers{});
}

TEST(SourcesOfNumbers, AreRequiredInTheAgentExceptInItsTestsAndParameters) {
  const std::string number = "f(0.7);\n";
  EXPECT_EQ(bare_in(number, "uav_agent/planners/star/a.cpp"), Numbers{"1: 0.7"});
  for (const char* path : {"uav_agent/maps/a_test.cpp", "uav_agent/testing/a.cpp", "core/a.cpp"}) {
    EXPECT_EQ(bare_in(number, path), Numbers{}) << path;
  }
  EXPECT_EQ(bare_in("  double error_m = 0.33;\ninline constexpr double kStepM = 0.7;\n",
                    "uav_agent/flight_core/flight_config.hpp"),
            Numbers{"2: 0.7"});
  EXPECT_EQ(
      bare_in("    r.field(\"step_m\", step_m, within(0.2, 20.0));\n    r.check(step_m != 0.7, \"step_m\", text);\n"),
      Numbers{"2: 0.7"})
      << "limits of parameters must need no source";
}

}  // namespace
}  // namespace skein::layers
