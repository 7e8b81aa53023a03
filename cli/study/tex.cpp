#include "cli/study/tex.hpp"

#include <spdlog/fmt/fmt.h>

#include "cli/study/columns.hpp"
#include "core/text/text.hpp"
#include "core/text/utf8.hpp"

namespace skein::cli {
namespace {

std::string tex_character(char c) {
  switch (c) {
    case '\\':
      return "\\textbackslash{}";
    case '~':
      return "\\textasciitilde{}";
    case '^':
      return "\\textasciicircum{}";
    case '<':
      return "\\textless{}";
    case '>':
      return "\\textgreater{}";
    case '|':
      return "\\textbar{}";
    case '`':
      return "\\char96{}";
    case '"':
      return "\\char34{}";
    case '&':
    case '%':
    case '$':
    case '#':
    case '_':
    case '{':
    case '}':
      return std::string("\\") + c;
    case '[':  // after the end of a row, LaTeX reads it as an option
    case ']':
    case '*':
    case '-':  // LaTeX joins two of these into one character
    case '\'':
    case ',':
      return std::string("{") + c + "}";
    case '\n':
    case '\t':
      return " ";
    default:
      return std::string(1, c);
  }
}

/// A number, with a minus sign instead of a hyphen.
std::string tex_number(double value, int digits) {
  const std::string text = fixed(value, digits);
  return text.starts_with("-") ? "$-$" + text.substr(1) : text;
}

std::string tex_table(const std::string& comment, const std::string& columns, const std::string& head,
                      const std::vector<std::string>& rows) {
  std::string tex = "% " + comment + "\n\\begin{tabular}{" + columns + "}\n\\toprule\n" + head + " \\\\\n\\midrule\n";
  for (const std::string& row : rows) tex += row + " \\\\\n";
  return tex + "\\bottomrule\n\\end{tabular}\n";
}

std::string ranking_tex(const Study& study) {
  std::vector<std::string> rows;
  for (const Standing& standing : standings(study)) {
    const std::vector<double> totals = complete_totals(standing);
    const Spread spread = spread_of(totals);
    std::string row = (standing.decides ? std::to_string(standing.place) : "--") + " & " +
                      tex_escaped(study.planners[standing.planner]);
    for (const double value : {spread.max, spread.median, spread.min}) {
      row += " & " + (totals.empty() ? "--" : tex_number(value, 1));
    }
    rows.push_back(row + " & " + std::to_string(totals.size()));
  }
  return tex_table("Ranking by the " + rank_name(study.rank) + " of the totals of the tests.", "rlrrrr",
                   "Place & Planner & Max.\\ & Median & Worst & Tests", rows);
}

std::string scores_tex(const Study& study, const std::vector<std::string>& titles) {
  std::vector<std::string> rows;
  for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
    for (std::size_t p = 0; p < study.planners.size(); ++p) {
      const auto flights = study.cell(p, s);
      std::string row =
          tex_escaped(titles[s]) + " & " + tex_escaped(study.planners[p]) + " & " + std::to_string(flights.size());
      for (const char* name : {"score", "attainable_percent", "points_detected"}) {
        const StudyColumn& column = study_column(name);
        const std::vector<double> values = column_values(column, flights);
        const Spread spread = spread_of(values);
        row += " & " + (values.empty() ? "--" : tex_number(spread.median, column.digits));
        if (column.name == "score") {
          row += values.empty() ? " & --" : " & " + tex_number(spread.min, 1) + "--" + tex_number(spread.max, 1);
        }
      }
      rows.push_back(row);
    }
  }
  return tex_table("Scores: medians over the seeds, and the range from the least to the greatest.", "llrrrrr",
                   "Scene & Planner & $n$ & Score & Range & \\% of attainable & Points", rows);
}

std::string tex_p(double p) {
  const std::string text = p_text(p);
  return text.starts_with("<") ? "$<$" + text.substr(1) : text;
}

std::string pairs_tex(const Study& study, const std::vector<PlannerPair>& pairs,
                      const std::vector<std::string>& titles) {
  std::vector<std::string> rows;
  for (const PlannerPair& pair : pairs) {
    std::string row = (pair.scenario ? tex_escaped(titles[*pair.scenario]) : "all scenes") + " & " +
                      tex_escaped(study.planners[pair.first]) + " $-$ " + tex_escaped(study.planners[pair.second]) +
                      fmt::format(" & {} & ", pair.differences.size()) +
                      (pair.median ? tex_number(*pair.median, 1) : "--");
    row += pair.interval ? " & " + tex_number(pair.interval->low, 1) + " to " + tex_number(pair.interval->high, 1) +
                               " & " + tex_p(pair.test->p) + " & " + tex_p(*pair.p_holm)
                         : " & \\multicolumn{3}{c}{$n$ too small}";
    rows.push_back(row);
  }
  return tex_table(
      "Differences of scores with the same seed: median, 95 % interval by bootstrap, p of Wilcoxon's signed-rank test "
      "(two-sided), and p after Holm's correction for all scenes of the two planners (totals: for all pairs).",
      "llrrrrr", "Scene & Planners & $n$ & Median & 95\\,\\% interval & $p$ & $p_\\mathrm{Holm}$", rows);
}

}  // namespace

std::string tex_escaped(const std::string& text) {
  const std::string plain = printable(text);
  std::string tex;
  for (std::size_t at = 0; at < plain.size();) {
    const std::size_t begin = at;
    next_character(plain, at);  // valid, because printable() gives valid UTF-8
    tex += at == begin + 1 ? tex_character(plain[begin]) : plain.substr(begin, at - begin);
  }
  return tex;
}

std::string study_tex(const Study& study, const std::vector<PlannerPair>& pairs,
                      const std::vector<std::string>& titles) {
  std::string tex = "% Made by Skein " + study.version + ". Needs \\usepackage{booktabs}.\n";
  if (study.contest) tex += "\n" + ranking_tex(study);
  tex += "\n" + scores_tex(study, titles);
  if (!pairs.empty()) tex += "\n" + pairs_tex(study, pairs, titles);
  return tex;
}

}  // namespace skein::cli
