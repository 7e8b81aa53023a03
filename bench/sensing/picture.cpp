#include "bench/sensing/picture.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "report/html.hpp"

namespace skein::bench {
namespace {

using agent::Space;
using report::coordinate;

constexpr double kWidth = 800.0, kMargin = 16.0, kGap = 16.0, kPanel = 0.5 * (kWidth - 2.0 * kMargin - kGap);
constexpr double kTop = 82.0, kLabel = 32.0, kBottom = 34.0;
constexpr double kCutStep = 0.7;    // [units]; grid to which the ends of the structure's lines are rounded
constexpr double kRouteStep = 0.5;  // [units]; shortest step of the drawn route
constexpr double kScaleBarM = 10.0;

constexpr const char* kStyle = R"(<style>
text{font:13px "Helvetica Neue",Arial,sans-serif;fill:#24292f}
.title{font-size:16px;font-weight:600}.head{font-size:14px;font-weight:600}.small{font-size:12px;fill:#57606a}
.unknown{fill:#d5d9de}.free{fill:#9fd8b4}.occupied{fill:#e07b39}
.cut{stroke:#1b1f24;stroke-width:1.6;stroke-linecap:round;fill:none}
.route{stroke:#fff;stroke-width:4;stroke-linejoin:round;fill:none}.route+.route{stroke:#1f5fbf;stroke-width:2}
.uav{fill:#1f5fbf;stroke:#fff;stroke-width:1.5}.frame{stroke:#8c959f;fill:none}.bar{fill:#24292f}
</style>
)";

/// A rectangle of squares.
struct Block {
  int column = 0, columns = 0, row = 0, rows = 0;
};

/// Covers the squares of one kind with few rectangles: runs along rows; equal runs in successive rows are merged.
std::vector<Block> blocks_of(const Squares& squares, Space space) {
  std::vector<Block> blocks;
  std::vector<std::size_t> below, here;  // indices of blocks that end in the row below, or in this row
  for (int row = 0; row < squares.rows; ++row, std::swap(below, here)) {
    here.clear();
    for (int column = 0; column < squares.columns;) {
      int end = column;
      while (end < squares.columns && squares.at(end, row) == space) ++end;
      if (end == column) {
        ++column;
        continue;
      }
      const auto same = std::ranges::find_if(
          below, [&](std::size_t i) { return blocks[i].column == column && blocks[i].columns == end - column; });
      here.push_back(same == below.end() ? blocks.size() : *same);
      if (same == below.end()) blocks.push_back({column, end - column, row, 0});
      ++blocks[here.back()].rows;
      column = end;
    }
  }
  return blocks;
}

class Panel {
 public:
  /// @param left, top  the panel's upper left corner in the drawing [units].   @param scale  units per metre.
  Panel(double left, double top, double scale, double width_m, double height_m)
      : left_(left), top_(top), scale_(scale), width_m_(width_m), height_m_(height_m) {}

  std::string svg(const Squares& squares, const PictureRow& row) const {
    const std::string size =
        fmt::format(R"(width="{}" height="{}")", coordinate(scale_ * width_m_), coordinate(scale_ * height_m_));
    std::string svg = fmt::format("<svg x=\"{}\" y=\"{}\" {}>\n<rect class=\"unknown\" {}/>\n", coordinate(left_),
                                  coordinate(top_), size, size);
    svg += fmt::format("<g transform=\"scale({:.5g})\" shape-rendering=\"crispEdges\">\n", scale_ * squares.edge_m);
    svg += space(squares, Space::free, "free") + space(squares, Space::occupied, "occupied") + "</g>\n";
    svg += cut(row.cut) + route(row.route);
    return svg + fmt::format("<rect class=\"frame\" {}/>\n</svg>\n", size);
  }

 private:
  Vector2d at(const Vector2d& p) const { return {scale_ * p.x(), scale_ * (height_m_ - p.y())}; }

  static std::string space(const Squares& squares, Space space, const char* style) {
    std::string data;
    int x = 0, y = 0;
    for (const Block& block : blocks_of(squares, space)) {
      const int top = squares.rows - block.row - block.rows;
      data += fmt::format("m{} {}h{}v{}h-{}z", block.column - x, top - y, block.columns, block.rows, block.columns);
      x = block.column;
      y = top;
    }
    return data.empty() ? "" : fmt::format("<path class=\"{}\" d=\"{}\"/>\n", style, data);
  }

  /// Draws lines that are equal after rounding only once. A line may have the length 0: a dot.
  std::string cut(const std::vector<Line>& lines) const {
    std::set<std::array<long, 4>> pieces;
    for (const auto& [from, to] : lines) {
      const Vector2d a = at(from) / kCutStep, b = at(to) / kCutStep;
      std::array<long, 4> piece = {std::lround(a.x()), std::lround(a.y()), std::lround(b.x()), std::lround(b.y())};
      if (std::pair(piece[2], piece[3]) < std::pair(piece[0], piece[1])) {
        piece = {piece[2], piece[3], piece[0], piece[1]};
      }
      pieces.insert(piece);
    }
    std::string data;
    for (const auto& [x1, y1, x2, y2] : pieces) data += fmt::format("M{} {}l{} {}", x1, y1, x2 - x1, y2 - y1);
    if (data.empty()) return "";
    return fmt::format("<path class=\"cut\" transform=\"scale({0})\" d=\"{1}\"/>\n", kCutStep, data);
  }

  std::string route(const std::vector<Vector2d>& route) const {
    std::string data;
    Vector2d last = Vector2d::Constant(-1e3);
    for (const Vector2d& p : route) {
      if ((at(p) - last).norm() < kRouteStep) continue;
      last = at(p);
      data += fmt::format("{}{} {}", data.empty() ? "M" : "L", coordinate(last.x()), coordinate(last.y()));
    }
    if (route.empty()) return "";
    const Vector2d uav = at(route.back());
    const std::string path = fmt::format("<path class=\"route\" d=\"{}\"/>\n", data);
    return path + path +
           fmt::format("<circle class=\"uav\" cx=\"{}\" cy=\"{}\" r=\"4\"/>\n", coordinate(uav.x()),
                       coordinate(uav.y()));
  }

  double left_, top_, scale_, width_m_, height_m_;
};

std::string text(double x, double y, const char* style, const std::string& words) {
  return fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\">{}</text>\n", style, coordinate(x), coordinate(y),
                     report::escaped(words));
}

/// The legend: one line below the title.
std::string legend() {
  std::string svg;
  double x = kMargin;
  const auto entry = [&](const std::string& sign, const char* words, double width) {
    svg += fmt::format("<g transform=\"translate({} 38)\">{}</g>\n", coordinate(x), sign) +
           text(x + 20.0, 50.0, "", words);
    x += width;
  };
  const auto box = [](const char* style) {
    return fmt::format("<rect class=\"{}\" width=\"14\" height=\"14\"/>", style);
  };
  entry(box("free"), "free", 64.0);
  entry(box("occupied"), "occupied", 94.0);
  entry(box("unknown"), "unknown", 92.0);
  entry(R"(<path class="cut" d="M2 10L7 4M12 9h0"/>)", "surfaces, cut by the plane", 262.0);
  entry(
      R"(<path class="route" d="M0 7h10"/><path class="route" d="M0 7h10"/><circle class="uav" cx="11" cy="7" r="4"/>)",
      "the UAV's path so far", 0.0);
  return svg;
}

std::string scale_bar(double y, double scale) {
  const double width = scale * kScaleBarM;
  return fmt::format("<rect class=\"bar\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"3\"/>\n", coordinate(kMargin),
                     coordinate(y), coordinate(width)) +
         text(kMargin + width + 8.0, y + 6.0, "small", "10 m");
}

}  // namespace

std::string picture_svg(const Picture& picture) {
  const double scale = kPanel / picture.width_m, row_height = kLabel + scale * picture.height_m;
  const double height = kTop + static_cast<double>(picture.rows.size()) * row_height + kBottom;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\">\n"
      "<title>{2}</title>\n{3}<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      coordinate(kWidth), coordinate(std::ceil(height)), report::escaped(picture.title), kStyle);
  const double right = kMargin + kPanel + kGap;
  svg += text(kMargin, 24.0, "title", picture.title) + legend();
  svg += text(kMargin, 80.0, "head", "map of key frames") + text(right, 80.0, "head", "world map (all beams)");
  double top = kTop;
  for (const PictureRow& row : picture.rows) {
    svg += text(kMargin, top + 24.0, "", row.label);
    top += kLabel;
    const auto panel = [&](double left, const Squares& squares) {
      return Panel(left, top, scale, picture.width_m, picture.height_m).svg(squares, row);
    };
    svg += panel(kMargin, row.today) + panel(right, row.world);
    top += scale * picture.height_m;
  }
  return svg + scale_bar(top + 14.0, scale) + "</svg>\n";
}

}  // namespace skein::bench
