#include "cli/study/page.hpp"

#include <gtest/gtest.h>

#include <random>
#include <regex>
#include <set>

#include "cli/study/spec.hpp"
#include "cli/testing/odd_study.hpp"
#include "report/html.hpp"
#include "report/testing/xml_check.hpp"

namespace skein::cli {
namespace {

using namespace report;

Study a_study(bool contest) {
  Study study{contest,
              Rank::median,
              {"kios", "exec:./a <b> && 'c' \"d\""},
              {"towers", "some/x<y>.yaml"},
              {1, 2, 3},
              {},
              "./skein contest --planner 'a & b'",
              "9.8.7",
              "0123456789abcdef",
              "cyclonedds",
              2};
  study.machine = "a <fast> processor";
  for (const std::uint64_t seed : study.seeds) {
    for (std::size_t s = 0; s < 2; ++s) {
      for (std::size_t p = 0; p < 2; ++p) {
        FlightEntry flight{p, s, seed, {}, FlightFigures{}, ""};
        flight.figures->score = 100.0 * static_cast<double>(p + 1) + static_cast<double>(seed);
        flight.figures->points_detected = 250;
        flight.figures->points_total = 900;
        study.flights.push_back(flight);
      }
    }
  }
  study.flights.back().figures.reset();
  study.flights.back().problem = "skein run ended with <signal> 9";
  return study;
}

StudyPictures pictures_of(const Study& study) {
  StudyPictures pictures;
  for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
    for (std::size_t p = 0; p < study.planners.size(); ++p) {
      FlightPicture& picture = pictures[{s, p}];
      picture.points = {{{1, 2, 3}, 0.5}, {{4, 5, 6}, 0.0}};
      picture.tracks = {{"<jurong>", true, {{0, 0, 0}, {1, 1, 1}}}};
    }
  }
  return pictures;
}

std::string page_of(const Study& study, bool pictures = true) {
  return study_page(StudyReport(study, pictures ? pictures_of(study) : StudyPictures{}));
}

/// The texts of the cells of all tables with this name, row by row, without their heads.
std::vector<std::vector<std::string>> rows_of(const std::string& page, const std::string& table) {
  pugi::xml_document document;
  document.load_buffer(page.data(), page.size());
  std::vector<std::vector<std::string>> rows;
  for (const auto& found : document.select_nodes(("//table[@data-table='" + table + "']/tbody/tr").c_str())) {
    rows.emplace_back();
    for (const pugi::xml_node& cell : found.node().children("td")) {
      std::string text;
      for (const auto& part : cell.select_nodes(".//text()"))
        text += (text.empty() ? "" : "|") + std::string(part.node().value());
      rows.back().push_back(text);
    }
  }
  return rows;
}

TEST(StudyPage, IsWellFormedWhateverTheNames) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 24; ++trial) {
    const Study study = odd_study(random, trial % 2 == 0);
    EXPECT_NO_THROW(xml_elements(page_of(study)));
    EXPECT_NO_THROW(xml_elements(page_of(study, false)));
  }
}

TEST(StudyPage, LoadsNothingFromElsewhereAndLinksOnlyIntoItsFolder) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 16; ++trial) {
    const Study study = odd_study(random, true);
    const StudyReport report(study, pictures_of(study));
    std::set<std::string> good = {"flights.csv", "summary.csv", "pairs.csv", "totals.csv", kTexTable};
    for (const StudyFigure& figure : report.figures) good.insert("figures/" + figure.file);
    for (const FlightEntry& flight : study.flights) good.insert(flight.page);
    const std::string page = study_page(report);
    for (const XmlElement& element : xml_elements(page)) {
      for (const char* foreign : {"script", "link", "img", "iframe", "object"}) EXPECT_NE(element.name, foreign);
      EXPECT_FALSE(element.attributes.contains("src"));
      const auto href = element.attributes.find("href");
      if (href != element.attributes.end()) {
        EXPECT_TRUE(good.contains(href->second)) << href->second;
      }
    }
    EXPECT_EQ(page.find("url("), std::string::npos);
    EXPECT_EQ(page.find("@import"), std::string::npos);
  }
}

TEST(StudyPage, LinksToThePageOfEveryFlightThatHasOne) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 16; ++trial) {
    const Study study = odd_study(random, false);
    std::multiset<std::string> wanted, found;
    for (const FlightEntry& flight : study.flights) {
      if (!flight.page.empty()) wanted.insert(flight.page);
    }
    for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
      for (std::size_t p = 0; p < study.planners.size(); ++p) {
        const FlightEntry* best = study.best(p, s);
        if (best != nullptr && !best->page.empty())
          wanted.insert(best->page);  // a drawing shows the best flight, and links to its page, too
      }
    }
    for (const XmlElement& element : xml_elements(page_of(study))) {
      const auto href = element.attributes.find("href");
      if (href != element.attributes.end() && href->second.starts_with("flights/")) found.insert(href->second);
    }
    EXPECT_EQ(found, wanted);
  }
}

TEST(StudyPage, TablesHaveTheFiguresOfTheFlights) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 16; ++trial) {
    const Study study = odd_study(random, trial % 2 == 0);
    const std::string page = page_of(study, false);
    const auto overview = rows_of(page, "overview"), flights = rows_of(page, "flights"),
               delivery = rows_of(page, "delivery");
    ASSERT_EQ(overview.size(), study.planners.size());
    ASSERT_EQ(flights.size(), study.planners.size() * study.scenarios.size());
    for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
      for (std::size_t p = 0; p < study.planners.size(); ++p) {
        std::vector<double> scores, points, delays;
        std::size_t never = 0;
        for (const FlightEntry& flight : study.flights) {
          if (flight.planner != p || flight.scenario != s) continue;
          const std::string& cell = flights[s * study.planners.size() + p].at(flight.seed);
          if (!flight.figures) continue;
          EXPECT_TRUE((cell + "|").starts_with(fixed(flight.figures->score, 1) + "|")) << cell;
          scores.push_back(flight.figures->score);
          points.push_back(flight.figures->points_detected);
          if (!flight.tables) continue;
          for (const Latency& latency : flight.tables->latencies) {
            delays.insert(delays.end(), latency.delays_s.begin(), latency.delays_s.end());
            never += latency.never;
          }
        }
        const std::string& cell = overview[p].at(1 + s);
        if (scores.empty()) {
          EXPECT_EQ(cell, "–");
          continue;
        }
        EXPECT_TRUE(cell.starts_with(fixed(spread_of(scores).median, 1) + "|")) << cell;
        EXPECT_TRUE(cell.ends_with("|" + fixed_at_most(spread_of(points).median, 1) + " of 3000 points")) << cell;
        if (delays.size() + never == 0) continue;
        const std::string never_text =
            std::to_string(never) + " of " + std::to_string(delays.size() + never) + " never";
        EXPECT_NE(delivery[p].at(1 + s).find(never_text), std::string::npos) << delivery[p][1 + s];
        if (delays.empty()) continue;
        std::ranges::sort(delays);
        const double median = delays[(delays.size() + 1) / 2 - 1];
        EXPECT_TRUE(delivery[p][1 + s].starts_with(fixed(median, 2) + " s|")) << delivery[p][1 + s];
      }
    }
  }
}

/// In the table of a scene, exactly the planners with the best median are marked. The first UAV of a planner begins a
/// group of rows.
TEST(StudyPage, TablesMarkTheBestPlannersAndGroupRowsByPlanner) {
  std::mt19937 random(7);
  std::size_t marked = 0, groups = 0;
  for (int trial = 0; trial < 16; ++trial) {
    const Study study = odd_study(random, false);
    const std::string page = page_of(study, false);
    pugi::xml_document document;
    document.load_buffer(page.data(), page.size());
    const auto tables = document.select_nodes("//table[@data-table='scene']/tbody");
    ASSERT_EQ(tables.size(), study.scenarios.size());
    for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
      std::vector<double> medians;
      for (std::size_t p = 0; p < study.planners.size(); ++p) {
        std::vector<double> scores;
        for (const FlightEntry* flight : study.cell(p, s)) scores.push_back(flight->figures->score);
        medians.push_back(scores.empty() ? -1.0 : spread_of(scores).median);
      }
      const double best = *std::ranges::max_element(medians);
      std::size_t p = 0;
      for (const pugi::xml_node& row : tables[s].node().children("tr")) {
        const bool is_best = best > 0.0 && medians.at(p++) == best;
        EXPECT_EQ(row.select_nodes("td[@class='best']").size(), is_best ? 1u : 0u) << p;
        marked += is_best ? 1 : 0;
      }
    }
    for (const auto& table : document.select_nodes("//table[@data-table='uavs']/tbody")) {
      std::string former;
      for (const pugi::xml_node& row : table.node().children("tr")) {
        std::string planner;
        for (const auto& text : row.child("td").select_nodes(".//text()")) planner += text.node().value();
        const bool begins = !former.empty() && planner != former;
        EXPECT_EQ(std::string(row.attribute("class").value()), begins ? "group" : "") << planner;
        groups += begins ? 1 : 0;
        former = planner;
      }
    }
  }
  EXPECT_GT(marked, 0u);
  EXPECT_GT(groups, 0u);
}

TEST(StudyPage, RowsOfUavsAndPairsHaveTheFiguresOfTheFlights) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 16; ++trial) {
    const Study study = odd_study(random, false);
    const std::string page = page_of(study, false);
    const auto uavs = rows_of(page, "uavs"), pairs = rows_of(page, "pairs");
    std::size_t row = 0;
    for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
      for (std::size_t p = 0; p < study.planners.size(); ++p) {
        for (std::size_t uav = 0; uav < 4; ++uav) {
          std::vector<double> scores;
          std::size_t taken = 0, never = 0;
          for (const FlightEntry* flight : study.cell(p, s)) {
            if (flight->figures->uavs.size() <= uav) continue;
            scores.push_back(flight->figures->uavs[uav].score);
            if (!flight->tables) continue;
            never += flight->tables->latencies[uav].never;
            taken += flight->tables->latencies[uav].never + flight->tables->latencies[uav].delays_s.size();
          }
          if (scores.empty()) continue;
          ASSERT_LT(row, uavs.size());
          EXPECT_EQ(uavs[row].at(1), "uav<" + std::to_string(uav) + ">");
          EXPECT_EQ(uavs[row].at(3), fixed(spread_of(scores).median, 1));
          EXPECT_EQ(uavs[row].at(8), taken > 0 ? fixed(100.0 * double(never) / double(taken), 1) : "–");
          ++row;
        }
      }
    }
    EXPECT_EQ(row, uavs.size());
    const std::vector<PlannerPair> expected = planner_pairs(study);
    ASSERT_EQ(pairs.size(), expected.size());
    if (pairs.empty()) continue;
    const std::size_t table = page.find("data-table=\"pairs\"");
    const std::string head = page.substr(table, page.find("</thead>", table) - table);
    const std::regex column("<th[ >]");
    EXPECT_EQ(std::distance(std::sregex_iterator(head.begin(), head.end(), column), std::sregex_iterator()), 8);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      EXPECT_EQ(pairs[i].at(2), std::to_string(expected[i].differences.size()));
      EXPECT_EQ(pairs[i].at(4), fixed(expected[i].median, 1));
      EXPECT_EQ(pairs[i].at(5) == "n too small", expected[i].differences.size() < kFewestPairs);
    }
  }
}

/// The axes of all panels of one kind, each as the texts of its ticks.
std::set<std::string> axes_of(const StudyReport& report, FigureKind kind, const std::string& style) {
  std::set<std::string> axes;
  const std::regex tick("<text class=\"" + style + "\" x=\"([0-9.]+)\" y=\"[0-9.]+\">([-0-9.]+)</text>");
  for (const StudyFigure& figure : report.figures) {
    if (figure.kind != kind || (kind == FigureKind::difference && !figure.scenario)) continue;
    std::string axis;
    for (std::sregex_iterator it(figure.svg.begin(), figure.svg.end(), tick), end; it != end; ++it) {
      axis += it->str(1) + ":" + it->str(2) + " ";
    }
    axes.insert(axis);
  }
  return axes;
}

TEST(StudyPage, PanelsOfOneQuantityHaveOneAxisFromZero) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 24; ++trial) {
    const Study study = odd_study(random, false);
    const StudyReport report(study, {});
    const auto scores = axes_of(report, FigureKind::score, "tick middle");
    ASSERT_EQ(scores.size(), 1u);
    EXPECT_EQ(scores.begin()->substr(0, 5), "14:0 ") << *scores.begin();
    EXPECT_LE(axes_of(report, FigureKind::curves, "tick middle").size(), 1u);
    EXPECT_LE(axes_of(report, FigureKind::curves, "tick end").size(), 1u);
    EXPECT_LE(axes_of(report, FigureKind::difference, "tick middle").size(), 1u);
    const Axis axis = score_axis(study);
    EXPECT_EQ(axis.low, 0.0);
    for (const FlightEntry& flight : study.flights) {
      if (flight.figures) {
        EXPECT_LE(flight.figures->score, axis.high);
      }
    }
  }
}

TEST(StudyPage, ScenesAreCalledByTheirNames) {
  EXPECT_EQ(scene_titles({"towers", "a/mine.yaml", "/b/yours.yaml"}),
            (std::vector<std::string>{"towers", "mine", "yours"}));
  EXPECT_EQ(scene_titles({"a/mine.yaml", "b/mine.yaml", "towers"}),
            (std::vector<std::string>{"a/mine.yaml", "b/mine.yaml", "towers"}));
  EXPECT_NE(page_of(a_study(false)).find("<h2>x&lt;y&gt;</h2>"), std::string::npos);
}

TEST(StudyPage, NamesTheLeadingPlannerAndTheCommandThatRepeatsTheStudy) {
  const Study study = a_study(true);
  const std::string page = page_of(study);
  for (const char* words :
       {"<h2>Ranking</h2>", "./skein contest --planner &#39;a &amp; b&#39;", "9.8.7", "a &lt;fast&gt; processor",
        "kios: 250 points detected, 103 score", "102.0<small>101.0–103.0</small>", "250 of 900 points",
        "skein run ended with &lt;signal&gt; 9"}) {
    EXPECT_NE(page.find(words), std::string::npos) << words;
  }
  EXPECT_EQ(page_of(a_study(false)).find("Ranking"), std::string::npos);
}

// Scenes differ in size. A sum of scores would hide that a planner is much better in a small scene, if it is a little
// worse in a large one.
TEST(StudyPage, AComparisonOverAllScenesUsesSharesOfTheScores) {
  const auto page_with = [](bool contest, bool known) {
    Study study = a_study(contest);
    study.flights = {};
    const double scores[2][2] = {{700.0, 10.0}, {550.0, 90.0}};  // by planner and scene
    for (const std::uint64_t seed : study.seeds) {
      for (std::size_t p = 0; p < 2; ++p) {
        for (std::size_t s = 0; s < 2; ++s) {
          FlightEntry flight{p, s, seed, {}, FlightFigures{}, ""};
          flight.figures->score = scores[p][s];
          const double attainable = s == 0 ? 1000.0 : 100.0;
          if (known) flight.figures->attainable = attainable;
          if (known) flight.figures->attainable_percent = 100.0 * scores[p][s] / attainable;
          study.flights.push_back(flight);
        }
      }
    }
    return page_of(study, false);
  };
  const auto leads = [](const std::string& page, const std::string& words) {
    pugi::xml_document document;
    document.load_buffer(page.data(), page.size());
    EXPECT_EQ(std::string(document.select_node("//div[@class='card main']/small").node().text().get()), words);
    const auto best =
        document.select_nodes("//table[@data-table='overview']/tbody/tr[td[last()][@class='best']]/td[1]");
    EXPECT_EQ(best.size(), 1u);
    return document.select_node("//div[@class='card main']/strong").node().text().get() == std::string("kios") &&
           best.first().node().select_node(".//span[last()]").node().text().get() == std::string("kios");
  };
  const std::string by_share = page_with(false, true);
  EXPECT_FALSE(leads(by_share, "median 72.5 % of attainable, mean of all scenes"));
  EXPECT_EQ(rows_of(by_share, "overview")[0].at(3), "710.0|40.0 % of attainable|0 of 0 points");
  EXPECT_TRUE(leads(page_with(false, false), "median 710.0, sum over all scenes"));
  EXPECT_TRUE(leads(page_with(true, true), "median total 710.0")) << "a contest goes by totals, as its rules say";
}

TEST(StudyPage, IsTheSameForTheSameStudy) {
  const Study study = a_study(true);
  EXPECT_EQ(page_of(study), page_of(study));
}

}  // namespace
}  // namespace skein::cli
