#include "cli/study/page.hpp"

#include <gtest/gtest.h>

#include <regex>

#include "cli/testing/xml_check.hpp"

namespace skein::cli {
namespace {

Study a_study(bool contest) {
  Study study{contest,
              Rank::median,
              {"kios", "exec:./a <b> && 'c' \"d\""},
              {"towers", "x<y>.yaml"},
              {1, 2, 3},
              {},
              "./skein contest --planner 'a & b'",
              "9.8.7",
              "0123456789abcdef",
              "cyclonedds",
              2};
  for (const std::uint64_t seed : study.seeds) {
    for (std::size_t s = 0; s < 2; ++s) {
      for (std::size_t p = 0; p < 2; ++p) {
        FlightEntry flight{p, s, seed, {}, FlightFigures{}, ""};
        flight.figures->score = 100.0 * static_cast<double>(p + 1) + static_cast<double>(seed);
        flight.figures->points_detected = 250;
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

TEST(StudyPage, IsWellFormedWhateverTheNames) {
  for (const bool contest : {false, true}) {
    const Study study = a_study(contest);
    EXPECT_NO_THROW(xml_elements(study_page(study, pictures_of(study))));
    EXPECT_NO_THROW(xml_elements(study_page(study, {})));
  }
}

TEST(StudyPage, AsksForNothingFromElsewhere) {
  const Study study = a_study(true);
  const std::string page = study_page(study, pictures_of(study));
  for (const XmlElement& element : xml_elements(page)) {
    EXPECT_NE(element.name, "script");
    EXPECT_NE(element.name, "link");
    EXPECT_NE(element.name, "img");
    for (const char* name : {"src", "href"}) EXPECT_FALSE(element.attributes.contains(name)) << element.name;
  }
  EXPECT_EQ(page.find("url("), std::string::npos);
  EXPECT_EQ(page.find("@import"), std::string::npos);
}

TEST(StudyPage, SaysWhoIsAheadAndHowToMakeItAgain) {
  const Study study = a_study(true);
  const std::string page = study_page(study, pictures_of(study));
  EXPECT_NE(page.find("<h2>Ranking</h2>"), std::string::npos);
  EXPECT_NE(page.find("./skein contest --planner &#39;a &amp; b&#39;"), std::string::npos);
  EXPECT_NE(page.find("9.8.7"), std::string::npos);
  EXPECT_NE(page.find("kios: 250 points detected, 103 score"), std::string::npos) << "the best of three seeds";
  EXPECT_NE(page.find("102.0<small>101.0–103.0</small>"), std::string::npos) << "median and range";
  EXPECT_NE(page.find("skein run ended with &lt;signal&gt; 9"), std::string::npos);
  EXPECT_EQ(study_page(a_study(false), {}).find("Ranking"), std::string::npos);
}

TEST(StudyPage, HasABoxPlotForTheTotalAndEachScene) {
  const auto plots = [](const std::string& page) {
    const std::regex plot("<svg class=\"plot\"");
    return std::distance(std::sregex_iterator(page.begin(), page.end(), plot), std::sregex_iterator());
  };
  EXPECT_EQ(plots(study_page(a_study(true), {})), 3);
  EXPECT_EQ(plots(study_page(a_study(false), {})), 2);
}

TEST(StudyPage, IsTheSameTwice) {
  const Study study = a_study(true);
  EXPECT_EQ(study_page(study, pictures_of(study)), study_page(study, pictures_of(study)));
}

}  // namespace
}  // namespace skein::cli
