// `skein contest` and `skein compare` with short flights of real fleets: resumed, and with one or two fleets at a time.
#include <csignal>
#include <regex>
#include <set>
#include <thread>

#include "fleet_fixture.hpp"
#include "small_scene.hpp"

namespace skein::test {
namespace {

class ContestTest : public FleetTest {
 protected:
  /// Two UAVs in front of one block with 12 points.
  const std::string scene_ = write_small_scene(folder());
  Arguments contest(const std::string& out) const {
    return {
        "contest", "--planners",  "hover:height_m=4,patrol", "--scenarios", scene_, "--tests", "2", "--duration", "40",
        "--out",   folder() / out};
  }
  std::string file(const std::string& out, const std::string& name) const { return text_of(folder() / out / name); }

  /// Every link on a study's page leads to a file, and each flight has a link to its own page.
  void expect_links_lead_somewhere(const std::string& out, const std::string& page) const {
    const std::regex link("href=\"([^\"]*)\"");
    std::set<std::string> pages, figures;
    for (std::sregex_iterator it(page.begin(), page.end(), link), end; it != end; ++it) {
      const std::string target = it->str(1);
      EXPECT_TRUE(std::filesystem::is_regular_file(folder() / out / target)) << target;
      if (target.ends_with("/report.html")) pages.insert(target);
      if (target.ends_with(".svg")) figures.insert(target);
    }
    EXPECT_EQ(pages.size(), read_csv(folder() / out / "flights.csv").size());
    EXPECT_EQ(figures.size(), 6u)
        << "figures of totals, scores, curves, differences, and of the best flight of either planner";
  }
};

/// Scores and digests, which do not depend on the machine.
std::vector<std::string> what_repeats(const std::filesystem::path& flights) {
  std::vector<std::string> rows;
  for (auto row : read_csv(flights)) {
    rows.push_back(row["planner"] + " " + row["seed"] + " " + row["score"] + " " + row["digest"]);
  }
  return rows;
}

TEST_F(ContestTest, FliesRanksAndContinuesWhereItWasStopped) {
  ChildProcess& first = skein(contest("one"));
  ASSERT_EQ(first.wait().code, 0) << first.err();
  for (const std::string& said : std::vector{"4 of 4: " + scene_, scene_ + ", patrol, seed 2: score"}) {
    EXPECT_NE(first.err().find(said), std::string::npos) << first.err();
  }
  EXPECT_NE(first.out().find("report.html"), std::string::npos);

  const auto totals = read_csv(folder() / "one" / "totals.csv");
  ASSERT_EQ(totals.size(), 2u);
  EXPECT_EQ(totals[0].at("planner"), "patrol") << "UAVs of hover see no points";
  EXPECT_EQ(totals[0].at("place"), "1");
  EXPECT_EQ(totals[1].at("place"), "2");
  EXPECT_GT(std::stod(totals[0].at("worst")), 0.0);
  const auto flights = read_csv(folder() / "one" / "flights.csv");
  ASSERT_EQ(flights.size(), 4u);
  for (const auto& flight : flights) {
    EXPECT_EQ(flight.at("status"), "completed");
    EXPECT_EQ(flight.at("problem"), "");
    EXPECT_GE(std::stod(flight.at("attainable_percent")), 0.0) << "the oracle's estimate is missing";
  }
  const std::string page = file("one", "report.html");
  for (const char* words :
       {"points detected", "class=\"track", "class=\"band", "n too small", "Written on", "UAV by UAV"}) {
    EXPECT_NE(page.find(words), std::string::npos) << words;
  }
  EXPECT_NE(page.find("<h2>scenario</h2>"), std::string::npos)
      << "the page must call scenes by their names, not their paths";
  expect_links_lead_somewhere("one", page);
  EXPECT_NE(file("one", "table.tex").find("\\bottomrule"), std::string::npos);

  // A flight without flight.json counts as interrupted: only this flight is flown again, with the same digest.
  std::filesystem::remove(folder() / "one/flights/scenario/patrol/seed-1/flight.json");
  ChildProcess& again = skein(contest("one"));
  ASSERT_EQ(again.wait().code, 0) << again.err();
  EXPECT_NE(again.err().find("3 of 4 flights are complete already"), std::string::npos) << again.err();
  const auto repeated = read_csv(folder() / "one" / "flights.csv");
  ASSERT_EQ(repeated.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(repeated[i].at("digest"), flights[i].at("digest"));

  // A flight without a page of its own is listed without a link.
  std::filesystem::remove(folder() / "one/flights/scenario/patrol/seed-1/report.html");
  ASSERT_EQ(skein(contest("one")).wait().code, 0);
  EXPECT_EQ(file("one", "report.html").find("patrol/seed-1/report.html"), std::string::npos);
  EXPECT_NE(file("one", "report.html").find("patrol/seed-2/report.html"), std::string::npos);
}

TEST_F(ContestTest, FliesTheSameWithTwoFleetsAtOnceAndWithSecuredOnes) {
  for (const auto& [out, how] : {std::pair<std::string, Arguments>("one", {"--jobs", "1"}),
                                 {"two", {"--jobs", "2"}},
                                 {"secured", {"--jobs", "1", "--secure"}}}) {
    Arguments words = {"compare", "--planners", "patrol", "--scenarios", "towers",      "--seeds",
                       "1,4",     "--duration", "5",      "--out",       folder() / out};
    words.insert(words.end(), how.begin(), how.end());
    ChildProcess& compare = skein(words);
    ASSERT_EQ(compare.wait().code, 0) << compare.err();
  }
  EXPECT_EQ(what_repeats(folder() / "one" / "flights.csv"), what_repeats(folder() / "two" / "flights.csv"));
  EXPECT_EQ(what_repeats(folder() / "one" / "flights.csv"), what_repeats(folder() / "secured" / "flights.csv"));
}

TEST_F(ContestTest, CtrlCEndsTheFlightsThatAreInTheAir) {
  ChildProcess& study = start_program(
      "study", {program("skein"), "compare", "--planners", "patrol", "--seeds", "0-98", "--out", folder() / "out"});
  ASSERT_TRUE(eventually([&] { return is_flying(folder() / "out/flights/towers/patrol/seed-0"); })) << study.err();
  study.signal(SIGINT);
  EXPECT_EQ(study.wait().code, 130);
  EXPECT_NE(study.err().find("continues from here"), std::string::npos) << study.err();
  const Json result = Json::parse(file("out", "flights/towers/patrol/seed-0/result.json"));
  EXPECT_EQ(result["status"], "interrupted");
  const auto in_the_air = std::max(1U, std::thread::hardware_concurrency());
  EXPECT_FALSE(std::filesystem::exists(folder() / ("out/flights/towers/patrol/seed-" + std::to_string(in_the_air))));
}

TEST_F(ContestTest, MistakesAreReportedBeforeAnythingFlies) {
  const auto refused = [&](const Arguments& arguments, const std::string& with) {
    Arguments all = arguments;
    all.insert(all.end(), {"--out", folder() / "out"});
    ChildProcess& study = skein(all);
    EXPECT_EQ(study.wait().code, 2);
    EXPECT_NE(study.err().find(with), std::string::npos) << study.err();
    EXPECT_FALSE(std::filesystem::exists(folder() / "out"));
  };
  refused({"contest", "--planners", "patrol,patrl"}, "patrol");
  refused({"contest", "--planners", "patrol", "--scenarios", "towers,hanger"}, "hangar");
  refused({"compare", "--planners", "patrol", "--seeds", "5-1"}, "upwards");
  refused({"compare", "--planners", "kios:no_such_key=1"}, "no_such_key");
  refused({"contest"}, "--planners A,B");
}

}  // namespace
}  // namespace skein::test
