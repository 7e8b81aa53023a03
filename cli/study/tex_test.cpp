#include "cli/study/tex.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "cli/study/page.hpp"
#include "cli/testing/odd_study.hpp"

namespace skein::cli {
namespace {

/// The text that LaTeX would print for an escaped text: replaces our commands, then removes braces and blanks.
std::string printed(std::string tex) {
  const auto replace = [&](const std::string& what, const std::string& by) {
    for (std::size_t at = 0; (at = tex.find(what, at)) != std::string::npos; at += by.size()) {
      tex.replace(at, what.size(), by);
    }
  };
  const std::vector<std::pair<std::string, std::string>> commands = {{"\\textbackslash{}", "\x01"},
                                                                     {"\\textasciitilde{}", "~"},
                                                                     {"\\textasciicircum{}", "^"},
                                                                     {"\\textless{}", "<"},
                                                                     {"\\textgreater{}", ">"},
                                                                     {"\\textbar{}", "|"},
                                                                     {"\\char96{}", "`"},
                                                                     {"\\char34{}", "\""},
                                                                     {"\\{", "\x02"},
                                                                     {"\\}", "\x03"}};
  for (const auto& [command, sign] : commands) replace(command, sign);
  std::erase(tex, '{');
  std::erase(tex, '}');
  std::erase(tex, '\\');
  replace("\x01", "\\");
  replace("\x02", "{");
  replace("\x03", "}");
  return tex;
}

/// Whether the text has a character with a meaning in TeX that is not escaped.
bool has_bare_sign(const std::string& tex) {
  for (std::size_t i = 0; i < tex.size(); ++i) {
    if (tex[i] == '\\') {
      ++i;
    } else if (std::string("&%$#_~^|<>`\"").find(tex[i]) != std::string::npos) {
      return true;
    }
  }
  return tex.find("--") != std::string::npos || tex.starts_with("[") || tex.starts_with("*");
}

int depth_of(const std::string& tex) {
  int depth = 0, least = 0;
  for (std::size_t i = 0; i < tex.size(); ++i) {
    if (tex[i] == '\\') {
      ++i;
      continue;
    }
    depth += tex[i] == '{' ? 1 : tex[i] == '}' ? -1 : 0;
    least = std::min(least, depth);
  }
  return least < 0 ? least : depth;
}

TEST(Tex, EveryCharacterIsPrintedAndNoneIsACommand) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 3000; ++trial) {
    std::string text(random() % 12, ' ');
    for (char& c : text) c = static_cast<char>(0x20 + random() % 0x5F);
    const std::string tex = tex_escaped(text);
    ASSERT_EQ(printed(tex), text);
    ASSERT_FALSE(has_bare_sign(tex)) << tex;
    ASSERT_EQ(depth_of(tex), 0) << tex;
  }
}

TEST(Tex, AnInvalidCharacterBecomesAQuestionMark) {
  EXPECT_EQ(tex_escaped("a\xff\xc3z"), "a??z");
  EXPECT_EQ(tex_escaped("a\x01z\nb"), "a?z b");
  EXPECT_EQ(tex_escaped("漢é"), "漢é");
  EXPECT_EQ(tex_escaped("--gains"), "{-}{-}gains");
}

TEST(Tex, TablesHaveARowForEachEntryAndACellForEachColumn) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 40; ++trial) {
    const Study study = odd_study(random, trial % 2 == 0);
    const StudyReport report(study, {});
    const std::string tex = study_tex(study, report.pairs, report.titles);
    EXPECT_EQ(depth_of(tex), 0);
    std::size_t rows = 0, columns = 0;
    for (std::size_t at = 0, end = 0; (end = tex.find('\n', at)) != std::string::npos; at = end + 1) {
      const std::string line = tex.substr(at, end - at);
      if (line.starts_with("\\begin{tabular}{")) columns = line.find('}', 16) - 16;
      if (line.starts_with("%") || !line.ends_with("\\\\")) continue;
      ++rows;
      std::size_t cells = 1 + (line.find("\\multicolumn{3}") != std::string::npos ? 2 : 0);
      for (std::size_t i = 0; i < line.size(); ++i) cells += line[i] == '&' && line[i - 1] != '\\' ? 1 : 0;
      EXPECT_EQ(cells, columns) << line;
    }
    const std::size_t heads = 1 + (study.contest ? 1 : 0) + (report.pairs.empty() ? 0 : 1);
    EXPECT_EQ(rows, heads + (study.contest ? study.planners.size() : 0) +
                        study.planners.size() * study.scenarios.size() + report.pairs.size());
  }
}

}  // namespace
}  // namespace skein::cli
