#include "cli/study/figure_files.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "cli/study/page.hpp"
#include "cli/testing/odd_study.hpp"
#include "report/testing/xml_check.hpp"

namespace skein::cli {
namespace {

StudyPictures drawn(const Study& study) {
  StudyPictures pictures;
  for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
    for (std::size_t p = 0; p < study.planners.size(); ++p) {
      report::FlightPicture& picture = pictures[{s, p}];
      picture.points = {{{1, 2, 3}, 0.5}, {{4, 5, 6}, 0.0}};
      picture.tracks = {{"<jurong>", true, {{0, 0, 0}, {1, 1, 1}}}};
      picture.collisions = {{1, 1, 1}};
    }
  }
  return pictures;
}

TEST(FigureFiles, AreCompleteSvgFilesWhateverTheNames) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 40; ++trial) {
    const Study study = odd_study(random, trial % 2 == 0);
    const StudyReport report(study, drawn(study));
    std::set<std::string> files;
    for (const StudyFigure& figure : report.figures) {
      EXPECT_TRUE(files.insert(figure.file).second) << figure.file;
      EXPECT_EQ(figure.file.find_first_of("/\\ <>&\"'\n"), std::string::npos) << figure.file;
      const std::string svg = paper_svg(figure);
      const auto elements = report::xml_elements(svg);
      ASSERT_EQ(elements.front().name, "svg");
      EXPECT_TRUE(elements.front().attributes.contains("width"));
      for (const char* foreign : {"var(", "url(", "@import", "@font-face", "currentcolor", "href", "system-ui"}) {
        EXPECT_EQ(svg.find(foreign), std::string::npos) << foreign;
      }
      EXPECT_NE(svg.find("fill=\"#ffffff\""), std::string::npos) << "the figure has a white background";
    }
  }
}

TEST(FigureFiles, ScenesAndPlannersOfOneNameDoNotOverwriteEachOther) {
  Study study{false, Rank::maximum, {"b-c", "c", "c?", "c!"}, {"a", "a-b", "x/a"}, {1}, {}, "", "", "", "", 1};
  for (std::size_t s = 0; s < 3; ++s) {
    for (std::size_t p = 0; p < 4; ++p) study.flights.push_back({p, s, 1, {}, FlightFigures{}, ""});
  }
  const StudyReport report(study, drawn(study));
  std::set<std::string> files;
  for (const StudyFigure& figure : report.figures) EXPECT_TRUE(files.insert(figure.file).second) << figure.file;
}

}  // namespace
}  // namespace skein::cli
