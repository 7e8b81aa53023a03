#include "report/run_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <regex>

#include "core/types.hpp"
#include "report/html.hpp"
#include "report/page_data.hpp"
#include "report/testing/odd_run.hpp"
#include "report/testing/xml_check.hpp"
#include "report/web_bundle.hpp"

namespace skein::report {
namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// The text between `begin` and `end`, as a browser finds the text of an element.
std::string element_text(const std::string& page, const std::string& begin, const std::string& end) {
  const std::size_t from = page.find(begin) + begin.size();
  return page.substr(from, page.find(end, from) - from);
}

class OddRuns : public testing::TestWithParam<unsigned> {};

TEST_P(OddRuns, GiveAWellFormedPage) {
  std::mt19937 random(GetParam());
  for (int trial = 0; trial < 12; ++trial) {
    SCOPED_TRACE(trial);
    const results::Scratch scratch;
    OddRun(random).write(scratch.path());
    const results::RunRecord run = results::read_sound_run(scratch.path());
    const std::string page = run_page(run, std::nullopt);
    ASSERT_NO_THROW(xml_elements(page));
    EXPECT_EQ(page, run_page(run, std::nullopt)) << "the same folder gives the same page";
    EXPECT_EQ(count_of(page, "<script"), 0u);
    for (const char* number : {"nan", "inf", "e+"}) {
      EXPECT_FALSE(std::regex_search(page, std::regex(std::string("[\" ]-?") + number + "[\" ]")))
          << "a drawing has an invalid number";
    }
    EXPECT_FALSE(std::regex_search(page, std::regex("(src|href)=\"(?!#)"))) << "the page loads something";

    const std::string script = "let x = '<b>' && 1 < 2;";
    const std::string live = run_page(run, script);
    EXPECT_EQ(count_of(live, "<script"), 2u) << "a text of the run begins another script";
    EXPECT_EQ(count_of(live, "</script"), 2u);
    EXPECT_EQ(element_text(live, "</script>\n<script>", "</script>"), script);
    EXPECT_NE(live.find(escaped(script_hash(script))), std::string::npos);
    const Json data = Json::parse(element_text(live, "id=\"data\">", "</script>"));
    ASSERT_EQ(data["uavs"].size(), run.uavs.size());
    EXPECT_EQ(data["points"].size(), 9 * run.points.size());
  }
}
INSTANTIATE_TEST_SUITE_P(Drawn, OddRuns, testing::Range(1U, 9U));

/// The script colours a point by the UAV that delivered its best picture; of equally good pictures, the first counts.
TEST(PageData, NamesTheUavThatDeliveredTheBestPictureOfEachPoint) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 40; ++trial) {
    results::RunRecord run;
    run.uavs = {"a", "b", "c"};
    run.explorer = {true, false, false};
    run.points.resize(6);
    run.maps.resize(run.uavs.size());
    for (std::uint64_t i = 0; i < 30; ++i) {
      results::CaptureRow capture{.uav = run.uavs[random() % 3],
                                  .capture = i,
                                  .time_s = 0.5 * static_cast<double>(random() % 40),
                                  .point = random() % 7,
                                  .q = kDetected * (0.5 + 0.5 * static_cast<double>(random() % 4))};
      if (random() % 4 != 0) capture.delivered_at_s = capture.time_s + 1.0;
      if (random() % 8 == 0) capture.reason = run_tables::kUavCollided;
      run.captures.push_back(capture);
    }
    const Json best = page_data(RunPage(run)).at("best");
    ASSERT_EQ(best.size(), 2 * run.points.size());
    for (std::size_t point = 0; point < run.points.size(); ++point) {
      std::vector<results::CaptureRow> all;
      for (const results::CaptureRow& capture : run.captures) {
        const bool counts = capture.delivered_at_s && !capture.voided() && capture.q >= kDetected;
        if (capture.point == point && counts) all.push_back(capture);
      }
      std::ranges::stable_sort(all, [](const results::CaptureRow& a, const results::CaptureRow& b) {
        return a.q != b.q ? a.q > b.q : a.time_s < b.time_s;
      });
      EXPECT_EQ(best[2 * point], all.empty() ? -1 : static_cast<int>(*run.uav_of(all.front().uav)));
      EXPECT_EQ(best[2 * point + 1], all.empty() ? 0L : std::lround(1e3 * all.front().time_s));
    }
  }
}

TEST(RunReport, AFolderWithoutAResultIsTheUsersMistake) {
  const results::Scratch scratch;
  EXPECT_THROW(write_run_report(scratch.path()), InputError);
  for (const char* text : {"{\"score\": ", "{}", "[]", "null", R"({"status": "completed", "score": "4.1"})"}) {
    write_text(scratch.path() / "result.json", text);
    EXPECT_THROW(write_run_report(scratch.path()), InputError) << text;
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / "report.html")) << text;
  }
}

TEST(RunReport, MissingPartsAreReported) {
  const results::Scratch scratch;
  write_text(scratch.path() / "result.json", R"({"status": "completed", "uavs": [{"name": "a"}], "losses": {}})");
  write_text(scratch.path() / "events.csv", "step,time_s,event,subject,object\n0,0,joined,a,\n1,0.05,joi");
  write_run_report(scratch.path());
  const std::string page = read_text(scratch.path() / "report.html");
  for (const char* file :
       {"scene.json", "score.csv", "losses.csv", "captures.csv", "trajectories.csv", "score_timeline.csv"}) {
    EXPECT_NE(page.find("There is no " + std::string(file)), std::string::npos) << file;
  }
  EXPECT_NE(page.find("events.csv is readable only up to row 1"), std::string::npos);
  EXPECT_EQ(page.find(scratch.path().string()), std::string::npos) << "the page must not reveal the path of the folder";
}

TEST(RunReport, SplitsTheLossesOfPicturesThatWereTooPoorToCount) {
  const auto page_of = [](const Json& too_poor) {
    results::RunRecord run;
    run.result = {{"attainable", {{"points", 9}, {"score", 9.0}}}, {"losses", {{"below_threshold", too_poor}}}};
    return run_page(run, std::nullopt);
  };
  const auto rows_of = [](const std::string& page) { return element_text(page, "data-table=\"poor\">", "</table>"); };
  const Json parts = {{"distance", {{"points", 0}, {"score", 0.0}}},
                      {"tilt", {{"points", 1}, {"score", 0.5}}},
                      {"blur", {{"points", 2}, {"score", 1.5}}},
                      {"unsplit", {{"points", 0}, {"score", 0.0}}}};
  const std::string rows = rows_of(page_of({{"points", 3}, {"score", 2.0}, {"by_part", parts}}));
  EXPECT_NE(rows.find("too much from the side"), std::string::npos) << rows;
  EXPECT_NE(rows.find("blurred"), std::string::npos) << rows;
  EXPECT_EQ(count_of(rows, "<tr"), 3u) << "the head and two rows: " << rows;
  const std::string earlier = rows_of(page_of({{"points", 3}, {"score", 2.0}}));
  EXPECT_NE(earlier.find("part not known"), std::string::npos) << "a result of an earlier version: " << earlier;
  EXPECT_EQ(count_of(earlier, "<tr"), 2u) << earlier;
  EXPECT_EQ(page_of({{"points", 0}, {"score", 0.0}}).find("data-table=\"poor\""), std::string::npos);
}

TEST(RunReport, APageWithoutItsScriptSaysWhereToGetIt) {
  const results::Scratch scratch;
  write_text(scratch.path() / "result.json", R"({"status": "completed"})");
  const std::string page = run_page(results::read_sound_run(scratch.path()), std::nullopt);
  EXPECT_NE(page.find("Packages of Skein contain it; a build from source makes it with npm"), std::string::npos)
      << "users of a package cannot build the script with npm";
}

TEST(RunReport, ANumberOutOfRangeEndsItsTable) {
  for (const char* number : {"nan", "-inf", "1e300", "x"}) {
    const results::Scratch scratch;
    write_text(scratch.path() / "result.json", R"({"status": "completed", "uavs": [{"name": "a"}]})");
    const std::string row = ",1,2,0,0,1,0.5,";
    write_text(scratch.path() / "score.csv",
               "x,y,z,nx,ny,nz,score,index\n0" + row + "0\n" + number + row + "1\n3" + row + "2\n");
    const results::RunRecord run = results::read_sound_run(scratch.path());
    EXPECT_EQ(run.points.size(), 1u) << number;
    EXPECT_NE(run_page(run, std::nullopt).find("score.csv is readable only up to row 1"), std::string::npos);
  }
}

TEST(RunReport, ThePageHasTheTypedCommandOrOneThatRepeatsTheRun) {
  const std::string typed = "skein run towers --faults 'my faults.yaml'";
  const auto page_of = [](const Json& result) {
    results::RunRecord run;
    run.result = result;
    return run_page(run, std::nullopt);
  };
  EXPECT_NE(page_of({{"command", typed}}).find(escaped(typed)), std::string::npos);
  const std::string page = page_of({{"scenario", "my scene.yaml"},
                                    {"seed", 7},
                                    {"scene_seed", std::numeric_limits<std::uint64_t>::max()},
                                    {"status", "completed"},
                                    {"mission_time_s", 120.5},
                                    {"planner", {{"a", "kios"}, {"b", "exec:./x y"}}},
                                    {"dds", {{"sim_server", "inproc"}}}});
  EXPECT_NE(page.find(escaped(
                "skein run 'my scene.yaml' --planner 'a=kios,b=exec:./x y' --seed 7 --scene-seed 18446744073709551615 "
                "--duration 120.5 --one-process")),
            std::string::npos);
}

TEST(WebBundle, HashesScriptsAsBrowsersDo) {
  EXPECT_EQ(script_hash(""), "sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU=");
  EXPECT_EQ(script_hash("alert('Hello, world.');"), "sha256-qznLcsROx4GACP2dm0UCKCzCG+HiZ1guq6ZZDob/Tng=");
}

TEST(WebBundle, ABundleThatDoesNotFitIntoAScriptElementIsLeftOut) {
  const results::Scratch scratch;
  const auto file = scratch.path() / "report.js";
  ::setenv("SKEIN_WEB", file.c_str(), 1);
  EXPECT_EQ(web_bundle(), std::nullopt) << "there is no bundle";
  for (const auto& [text, fits] : {std::pair("let x = 1;", true), {"'</ScRipt >'", false}, {"'<!-- x'", false}}) {
    write_text(file, text);
    EXPECT_EQ(web_bundle().has_value(), fits) << text;
  }
  ::unsetenv("SKEIN_WEB");
}

TEST(WebBundle, NoTextInTheJsonEndsItsScriptElement) {
  for (const std::string& text : kNastyTexts) {
    const std::string dumped = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace),
                      json = script_json(dumped);
    EXPECT_EQ(json.find_first_of("<>&"), std::string::npos);
    EXPECT_EQ(Json::parse(json), Json::parse(dumped));
  }
}

}  // namespace
}  // namespace skein::report
