// The same input gives the same run in every version, over DDS and in one process: compares the digests of all bundled
// scenes and planners, and of some faults, with those of the previous version (reference_digests.csv). At each commit,
// half of the rows fly in one process, and a fifth of all rows over DDS. With sanitizers, an eighth of the rows flies;
// of those with faults a sixteenth, or none (ThreadSanitizer). Without SKEIN_TURN, all rows fly in both ways:
//   build/release/tests/tests_fleet --file tests/fleet/reference_digests_test.cpp
// If a change alters digests on purpose, the CHANGELOG says so, and the file gets new ones: SKEIN_WRITE_DIGESTS=FILE
// writes the digests of this test.
#include <cstdlib>
#include <fstream>

#include "fleet_fixture.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_program.hpp"

namespace skein::test {
namespace {

using Row = std::map<std::string, std::string>;

const char* const kColumns[] = {"scenario", "scene_seed", "seed", "planner", "duration_s", "faults"};

/// A row, and its number in the file.
using NumberedRow = std::pair<std::size_t, Row>;

std::vector<NumberedRow> rows() {
  std::vector<NumberedRow> numbered;
  for (const Row& row : read_csv(source_path("tests/fleet/reference_digests.csv"))) {
    numbered.emplace_back(numbered.size(), row);
  }
  return numbered;
}

std::string name_of(const Row& row) {
  std::string name = row.at("scenario") + "_" + row.at("planner");
  if (!row.at("scene_seed").empty()) name += "_" + row.at("scene_seed");
  return row.at("faults").empty() ? name : name + "_" + row.at("faults");
}

class ReferenceDigests : public FleetTest, public testing::WithParamInterface<NumberedRow> {};

TEST_P(ReferenceDigests, AreThoseOfThePreviousVersion) {
  const auto& [number, row] = GetParam();
  const bool official = row.at("scenario") == "mbs" || row.at("scenario") == "crane";
  if (official && std::getenv("SKEIN_ASSETS") == nullptr) GTEST_SKIP() << "SKEIN_ASSETS is not set";
  const bool sanitized = !sanitizer().empty(), with_faults = !row.at("faults").empty();
  if (sanitized && with_faults) {
    if (sanitizer() == "thread") GTEST_SKIP() << "80 s take five minutes with ThreadSanitizer";
    if (!has_turn(number, 16)) GTEST_SKIP() << "not its turn: with sanitizers it takes minutes";
  }
  Arguments arguments = {row.at("scenario"), "--planner",  row.at("planner"),    "--seed",
                         row.at("seed"),     "--duration", row.at("duration_s"), "--no-oracle"};
  if (!row.at("scene_seed").empty()) arguments.insert(arguments.end(), {"--scene-seed", row.at("scene_seed")});
  if (with_faults) {
    arguments.insert(arguments.end(), {"--faults", source_path("config/faults/" + row.at("faults") + ".yaml")});
  }
  const bool over_dds = !sanitized && has_turn(number, 5);  // many processes with sanitizers are too slow
  // Each scene has four rows, one for each planner: every turn has all planners and all scenes.
  const bool has_half = has_turn(number + number / 4, 2) || std::getenv("SKEIN_WRITE_DIGESTS") != nullptr;
  const bool in_one_process = sanitized || has_half;
  if (!over_dds && !in_one_process) GTEST_SKIP() << "not its turn";
  if (over_dds) {
    EXPECT_EQ(run("run", arguments).digest(), row.at("digest"));
  }
  if (!in_one_process) return;
  arguments.push_back("--one-process");
  const std::string digest = run("one_process", arguments).digest();
  EXPECT_EQ(digest, row.at("digest"));
  if (over_dds && (with_faults || long_tests())) {
    EXPECT_EQ(run("chaos", arguments, {{"SKEIN_CHAOS", "1"}}).digest(), row.at("digest"));
  }
  if (const char* const file = std::getenv("SKEIN_WRITE_DIGESTS")) {
    std::ofstream out(file, std::ios::app);
    for (const char* const column : kColumns) out << row.at(column) << ',';
    out << digest << '\n';
  }
}

INSTANTIATE_TEST_SUITE_P(All, ReferenceDigests, testing::ValuesIn(rows()),
                         [](const auto& row) { return name_of(row.param.second); });

}  // namespace
}  // namespace skein::test
