// Fixture of the tests of sweeps: a short study that engines fly, and the same study without an engine for comparison.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>

#include "tests/fleet/fleet_fixture.hpp"
#include "tests/fleet/small_scene.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace fs = std::filesystem;

inline bool is_installed(const std::string& program) {
  const std::string command = "command -v " + program + " >/dev/null 2>&1";
  return std::system(command.c_str()) == 0;
}

/// Whether a column depends on the machine.
inline bool is_of_the_machine(const std::string& column) {
  return column.starts_with("planner_cpu_ms") || column.starts_with("real_time_factor");
}

using Table = std::vector<std::map<std::string, std::string>>;

class SweepTest : public FleetTest {
 protected:
  const std::string scene_ = write_small_scene(folder());
  std::size_t tests_ = 6;  ///< number of tests, of two flights each

  std::size_t flights() const { return 2 * tests_; }
  Arguments study(const std::string& out, const Arguments& how) const {
    return joined({"contest", "--planners", "hover:height_m=4,patrol", "--scenarios", scene_, "--tests",
                   std::to_string(tests_), "--duration", "20", "--out", folder() / out},
                  how);
  }
  ChildProcess& fly(const std::string& out, const Arguments& how, const Environment& environment = {}) {
    return start_program(out, joined({program("skein")}, study(out, how)), environment);
  }
  Table table(const std::string& out, const std::string& name) const {
    Table rows = read_csv(folder() / out / name);
    for (auto& row : rows) std::erase_if(row, [](const auto& cell) { return is_of_the_machine(cell.first); });
    return rows;
  }
  void expect_as_plain(const std::string& out) {
    if (!fs::exists(folder() / "plain")) {
      ChildProcess& plain = fly("plain", {});
      ASSERT_EQ(plain.wait().code, 0) << plain.err();
    }
    ASSERT_EQ(table("plain", "flights.csv").size(), flights());
    for (const char* name : {"flights.csv", "summary.csv", "totals.csv", "pairs.csv"}) {
      EXPECT_EQ(table("plain", name), table(out, name)) << out << "/" << name;
    }
    EXPECT_EQ(text_of(folder() / "plain" / "table.tex"), text_of(folder() / out / "table.tex"));
    EXPECT_TRUE(fs::is_regular_file(folder() / out / "report.html"));
  }
  std::size_t flown(const std::string& out) const {
    std::size_t count = 0;
    std::error_code none;
    for (fs::recursive_directory_iterator it(folder() / out / "flights", none), end; it != end; it.increment(none)) {
      count += it->path().filename() == "flight.json" ? 1 : 0;
    }
    return count;
  }
  /// Logs of all units.
  std::string logs(const std::string& out) const {
    std::string text;
    std::error_code none;
    for (const auto& file : fs::directory_iterator(folder() / out / "sweep/log", none)) text += text_of(file.path());
    return text;
  }
};

}  // namespace skein::test
