// The section with each UAV's map at the end of its agent.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "report/html.hpp"
#include "report/page_parts.hpp"
#include "results/octree_file.hpp"

namespace skein::report {
namespace {

constexpr double kMapWidth = 360.0;
constexpr int kMostMapCells = 120;  ///< along the longer side of a drawing
constexpr std::size_t kMostMaps = 20;
constexpr std::size_t kHeights = 4;

/// A UAV's map in plan view, in square cells. A cell has the colour of its highest occupied cube, or of free space.
class Plan {
 public:
  explicit Plan(const PictureView& view) : view_(view) {
    const Vector3d size = view.high() - view.low();
    cell_m_ = std::max(1.0, std::max(size.x(), size.y()) / kMostMapCells);
    columns_ = static_cast<int>(std::ceil(size.x() / cell_m_));
    rows_ = static_cast<int>(std::ceil(size.y() / cell_m_));
    colours_.resize(static_cast<std::size_t>(columns_ * rows_), 0);
  }

  void add(const KnownCube& cube) {
    const Vector3d low = (cube.lowest_W - view_.low()) / cell_m_;
    const Vector3d high = low + Vector3d::Constant(cube.edge_m / cell_m_);
    // A cube that is smaller than a cell belongs to the cell that contains the cube's middle.
    const auto first = [&](int axis) {
      return std::max(0, static_cast<int>(std::floor(low[axis] + 0.5 * small(cube))));
    };
    const auto last = [&](int axis, int count) {
      return std::min(count, std::max(first(axis) + 1, static_cast<int>(std::lround(high[axis]))));
    };
    if (high.x() < 0.0 || high.y() < 0.0 || low.x() >= columns_ || low.y() >= rows_) return;
    const std::uint8_t colour = colour_of(cube);
    for (int y = first(1); y < last(1, rows_); ++y) {
      for (int x = first(0); x < last(0, columns_); ++x) {
        std::uint8_t& cell = colours_[static_cast<std::size_t>(y * columns_ + x)];
        cell = std::max(cell, colour);
      }
    }
  }

  std::string svg() const {
    std::array<std::string, kHeights + 2> data;
    for (int y = 0; y < rows_; ++y) {
      for (int x = 0, end = 0; x < columns_; x = end) {
        const std::uint8_t colour = at(x, y);
        for (end = x + 1; end < columns_ && at(end, y) == colour;) ++end;
        if (colour != 0) data[colour] += bar(x, end, y);
      }
    }
    std::string svg = "<g class=\"known\">\n";
    for (std::size_t i = 1; i < data.size(); ++i) {
      if (!data[i].empty()) svg += fmt::format("<path class=\"m{}\" d=\"{}\"/>\n", i, data[i]);
    }
    return svg + "</g>\n";
  }

  /// Upper limit of the heights that have this colour [m].
  double height_m(std::size_t colour) const {
    return highest_m() * static_cast<double>(colour - 1) / static_cast<double>(kHeights);
  }

 private:
  /// Height that the colours divide [m]: at least 1, since the box of a flat scene may have none.
  double highest_m() const { return std::max(1.0, view_.high().z()); }
  double small(const KnownCube& cube) const { return std::min(1.0, cube.edge_m / cell_m_); }
  std::uint8_t at(int x, int y) const { return colours_[static_cast<std::size_t>(y * columns_ + x)]; }
  /// 0: unknown (never returned here); 1: free; 2 and more: occupied, by height.
  std::uint8_t colour_of(const KnownCube& cube) const {
    if (!cube.occupied) return 1;
    const double share = cube.middle_W().z() / highest_m();
    return static_cast<std::uint8_t>(2 + std::clamp(static_cast<int>(share * kHeights), 0, int{kHeights} - 1));
  }
  std::string bar(int from, int to, int row) const {
    const auto corner = [&](int x, int y) { return view_.at(view_.low() + cell_m_ * Vector3d(x, y, 0.0)); };
    const Eigen::Vector2d a = corner(from, row + 1), b = corner(to, row);
    return fmt::format("M{} {}h{}v{}h-{}z", coordinate(a.x()), coordinate(a.y()), coordinate(b.x() - a.x()),
                       coordinate(b.y() - a.y()), coordinate(b.x() - a.x()));
  }

  const PictureView& view_;
  double cell_m_ = 1.0;
  int columns_ = 0, rows_ = 0;
  std::vector<std::uint8_t> colours_;
};

std::string figures_table(const RunPage& page) {
  std::string html = "<div class=\"wide\"><table data-table=\"maps\">\n" +
                     table_head({"UAV", "Occupied [m³]", "Free [m³]", "Known of the boxes [%]"}) + "<tbody>\n";
  for (std::size_t i = 0; i < page.run.uavs.size(); ++i) {
    const auto& map = page.maps[i];
    if (!map) continue;
    html += table_row({escaped(page.run.uavs[i]), fixed(map->occupied_m3, 0), fixed(map->free_m3, 0),
                       fixed(map->known_share ? std::optional(100.0 * *map->known_share) : std::nullopt, 1)});
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace

std::string maps_section(const RunPage& page) {
  const auto known = std::ranges::count_if(page.maps, [](const auto& map) { return map.has_value(); });
  if (known == 0) return "";
  FlightPicture picture = page.picture;
  picture.points.clear();
  picture.tracks.clear();
  const PictureView view({&page.picture}, Look::above, kMapWidth);
  std::string html = "<section id=\"maps\"><h2>What each UAV knew at its end</h2>\n<ul class=\"legend\">\n";
  const auto entry = [&](std::size_t colour, const std::string& words) {
    html += fmt::format("<li><span class=\"swatch m{}\"></span>{}</li>\n", colour, words);
  };
  entry(1, "free at some height");
  for (std::size_t colour = 2; colour < 2 + kHeights; ++colour) {
    entry(colour, fmt::format("occupied up to {} m", fixed(Plan(view).height_m(colour), 0)));
  }
  html += "<li>else unknown</li>\n</ul>\n<div class=\"panels places\">\n";
  std::size_t drawn = 0;
  for (std::size_t i = 0; i < page.run.uavs.size() && drawn < kMostMaps; ++i) {
    if (!page.maps[i]) continue;
    Plan plan(view);
    results::visit_octree_file(page.run.maps[i], [&](const KnownCube& cube) { plan.add(cube); });
    PictureStyle style;
    style.ground = plan.svg();
    const std::string& uav = page.run.uavs[i];
    html += figure(uav, "in plan", picture_svg(picture, view, "What " + uav + " knew, in plan", style));
    ++drawn;
  }
  html += "</div>\n";
  if (static_cast<std::size_t>(known) > drawn)
    html += fmt::format("<p>The first {} of {} are drawn.</p>\n", drawn, known);
  return html + figures_table(page) + "</section>\n";
}

}  // namespace skein::report
