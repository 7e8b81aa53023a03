// For tests: `skein compare` and `contest` with a script in place of each flight.
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "cli/study_command.hpp"
#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"

namespace skein::cli {

/// A script that replaces the process of a flight. It notes its call, and writes a result whose score is 10 times the
/// seed, and 1000 more for patrol.
inline constexpr const char* kStudyFlight = R"(
[ "$1" = --flight ] || exit 2
value() { printf %s "$2" | sed -nE "s/.*\"$1\":(\"([^\"]*)\"|([^\",}]*)).*/\2\3/p"; }
out=$(value out "$2")
seed=$(value seed "$2")
planner=$(value planner "$2")
agent=$(value agent "$2")
agent=${agent##*/}
uavs=$(value uavs "$2")
[ -z "$uavs" ] || echo "$uavs" >> "$(dirname "$0")/uavs.txt"
here=$(dirname "$0")
echo "$planner $seed" >> "$here/flights.txt"
echo "$agent" >> "$here/agents.txt"
score=$((10 * seed))
[ "$planner" != patrol ] || score=$((score + 1000))
code=0
[ ! -e "$here/hook" ] || . "$here/hook"
echo "{\"seed\": $seed, \"status\": \"completed\", \"score\": $score, \"points_detected\": 5}" > "$out/result.json"
exit $code
)";

class StudyCommand : public ::testing::Test {
 protected:
  StudyCommand() {
    write_script(programs_.dir() / "skein", kStudyFlight);
    options_.contest = true;
    options_.planner_lists = {"hover,patrol"};
    options_.scenarios = {programs_.scenario()};
    options_.seeds = "1-3";
    options_.out = programs_.dir() / "out";
  }

  int run() {
    out_.str("");
    err_.str("");
    write_text(programs_.dir() / "flights.txt", "");
    return run_study(options_, {out_, err_, false});
  }
  /// The flights of the last call, one per line.
  std::string flown() const { return read_text(programs_.dir() / "flights.txt"); }
  std::string agents() const { return read_text(programs_.dir() / "agents.txt"); }
  void hook(const std::string& body) const { write_text(programs_.dir() / "hook", body); }
  std::string file(const std::string& name) const { return read_text(*options_.out / name); }
  std::string refusal() try {
    run();
    return "";
  } catch (const InputError& error) {
    return error.what();
  }

  FakePrograms programs_;
  StudyOptions options_;
  std::ostringstream out_, err_;
};

}  // namespace skein::cli
