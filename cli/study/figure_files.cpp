#include "cli/study/figure_files.hpp"

#include <spdlog/fmt/fmt.h>

#include <map>
#include <stdexcept>

#include "core/text/text.hpp"
#include "report/html.hpp"
#include "report/style.hpp"

namespace skein::cli {
namespace {

/// Values of the CSS variables of report/style.cpp for figures on paper.
const std::map<std::string, std::string>& paper_palette() {
  static const std::map<std::string, std::string> kPalette = {{"--font", "Helvetica, Arial, sans-serif"},
                                                              {"--ink", "#000000"},
                                                              {"--soft", "#000000"},
                                                              {"--line", "#cccccc"},
                                                              {"--panel", "#ffffff"},
                                                              {"--bad", "#b3261e"},
                                                              {"--c0", "#0072b2"},
                                                              {"--c1", "#d55e00"},
                                                              {"--c2", "#009e73"},
                                                              {"--c3", "#b8578f"},
                                                              {"--c4", "#b97f00"},
                                                              {"--c5", "#3b8fc4"},
                                                              {"--c6", "#6b6b6b"},
                                                              {"--t0", "#d55e00"},
                                                              {"--t1", "#00855f"},
                                                              {"--t2", "#c0609a"},
                                                              {"--t3", "#c98a00"},
                                                              {"--t4", "#2a2f38"},
                                                              {"--t5", "#8b5a2b"},
                                                              {"--q0", "#cfd4db"},
                                                              {"--q1", "#a9cbe8"},
                                                              {"--q2", "#6aa6d8"},
                                                              {"--q3", "#2d7bbf"},
                                                              {"--q4", "#0b4a86"}};
  return kPalette;
}

constexpr const char* kPaperStyle =
    R"css(.curve.c1 { stroke-dasharray: 7 2; } .curve.c2 { stroke-dasharray: 2 2; } .curve.c3 { stroke-dasharray: 8 2 2 2; }
.curve.c4 { stroke-dasharray: 4 4; } .curve.c5 { stroke-dasharray: 10 3 2 3 2 3; } .curve.c6 { stroke-dasharray: 1 3; }
.mark.q0 { fill: #cfd4db; } .mark.q1 { fill: #a9cbe8; } .mark.q2 { fill: #6aa6d8; } .mark.q3 { fill: #2d7bbf; } .mark.q4 { fill: #0b4a86; }
)css";

/// Replaces each CSS variable of a style sheet, such as "var(--ink)", with its value for paper.
std::string resolved(std::string_view style) {
  std::string out;
  for (std::size_t at = 0; at < style.size();) {
    const std::size_t begin = style.find("var(", at);
    out += style.substr(at, begin - at);
    if (begin == std::string_view::npos) break;
    const std::size_t end = style.find(')', begin);
    out += paper_palette().at(std::string(style.substr(begin + 4, end - begin - 4)));
    at = end + 1;
  }
  return out;
}

struct Size {
  double width = 0.0, height = 0.0;
};

/// Size of one of Skein's own drawings, from its `viewBox="0 0 360 120"`.
Size view_box(const std::string& svg) {
  const std::string begin = "viewBox=\"0 0 ";
  const std::size_t from = svg.find(begin) + begin.size();
  const std::vector<std::string> numbers = split(svg.substr(from, svg.find('"', from) - from), ' ');
  return {parse_number(numbers.at(0)).value(), parse_number(numbers.at(1)).value()};
}

}  // namespace

std::string paper_svg(const StudyFigure& figure) {
  const auto [width, height] = view_box(figure.svg);
  double legend_height = 0.0;
  const std::string legend = legend_svg(figure.legend, 10.0, height + 2.0, width - 20.0, legend_height);
  const std::string full_height = report::coordinate(height + (legend_height > 0.0 ? legend_height + 8.0 : 0.0));
  const std::size_t inner = figure.svg.find('>') + 1, end = figure.svg.rfind("</svg>");
  const std::size_t classes = figure.svg.find("class=\"") + 7;
  return fmt::format(
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"{}\" "
             "width=\"{}\" height=\"{}\" viewBox=\"0 0 {} {}\">\n<title>{}</title>\n<style>\n{}{}</style>\n"
             "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>",
             figure.svg.substr(classes, figure.svg.find('"', classes) - classes), report::coordinate(width),
             full_height, report::coordinate(width), full_height,
             report::escaped(figure.caption + (figure.small.empty() ? "" : ", " + figure.small)),
             resolved(report::drawing_style()), kPaperStyle) +
         figure.svg.substr(inner, end - inner) + legend + "</svg>\n";
}

}  // namespace skein::cli
