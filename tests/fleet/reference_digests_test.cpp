// The same input gives the same run from version to version, over DDS and in one process: digests of all bundled scenes
// and planners, and of some faults, as the version before had them (reference_digests.csv). A change that is meant to
// change them says so in the CHANGELOG and brings new ones: SKEIN_WRITE_DIGESTS=FILE writes what this test sees.
#include <cstdlib>
#include <fstream>

#include "fleet_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

using Row = std::map<std::string, std::string>;

const char* const kColumns[] = {"scenario", "scene_seed", "seed", "planner", "duration_s", "faults"};

/// With sanitizers: all with faults, and some of the others; with threads in mind less is enough.
std::vector<Row> rows() {
  std::vector<Row> all = read_csv(source_path("tests/fleet/reference_digests.csv"));
  if (sanitizer().empty()) return all;
  const bool threads = sanitizer() == "thread";
  const std::size_t every = threads ? 7 : 3;
  std::size_t number = 0;
  std::erase_if(all, [&](const Row& row) { return number++ % every != 0 && (threads || row.at("faults").empty()); });
  return all;
}

std::string name_of(const Row& row) {
  std::string name = row.at("scenario") + "_" + row.at("planner");
  if (!row.at("scene_seed").empty()) name += "_" + row.at("scene_seed");
  return row.at("faults").empty() ? name : name + "_" + row.at("faults");
}

class ReferenceDigests : public FleetTest, public testing::WithParamInterface<Row> {};

TEST_P(ReferenceDigests, AreThoseOfTheVersionBefore) {
  const Row& row = GetParam();
  const bool official = row.at("scenario") == "mbs" || row.at("scenario") == "crane";
  if (official && std::getenv("SKEIN_ASSETS") == nullptr) GTEST_SKIP() << "SKEIN_ASSETS is not set";
  Arguments arguments = {row.at("scenario"), "--planner",  row.at("planner"),    "--seed",
                         row.at("seed"),     "--duration", row.at("duration_s"), "--no-oracle"};
  if (!row.at("scene_seed").empty()) arguments.insert(arguments.end(), {"--scene-seed", row.at("scene_seed")});
  if (!row.at("faults").empty()) {
    arguments.insert(arguments.end(), {"--faults", source_path("config/faults/" + row.at("faults") + ".yaml")});
  }
  std::string digest = row.at("digest");  // of a fleet over DDS
  if (sanitizer().empty()) {
    digest = run("run", arguments).digest();
    EXPECT_EQ(digest, row.at("digest"));
  }
  arguments.push_back("--one-process");
  EXPECT_EQ(run("one_process", arguments).digest(), row.at("digest"));
  if (sanitizer().empty() && (!row.at("faults").empty() || long_tests())) {
    EXPECT_EQ(run("chaos", arguments, {{"SKEIN_CHAOS", "1"}}).digest(), row.at("digest"));
  }
  if (const char* const file = std::getenv("SKEIN_WRITE_DIGESTS")) {
    std::ofstream out(file, std::ios::app);
    for (const char* const column : kColumns) out << row.at(column) << ',';
    out << digest << '\n';
  }
}

INSTANTIATE_TEST_SUITE_P(All, ReferenceDigests, testing::ValuesIn(rows()),
                         [](const auto& row) { return name_of(row.param); });

}  // namespace
}  // namespace skein::test
