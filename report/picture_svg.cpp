#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/math/vectors.hpp"
#include "report/flight_picture.hpp"
#include "report/html.hpp"
#include "results/causes.hpp"

namespace skein::report {
namespace {

using Eigen::Vector2d;

constexpr double kPi = 3.14159265358979323846;
/// Direction of the oblique view: from the south-south-east, 25 degrees downwards.
constexpr double kAzimuth = -60.0 * kPi / 180.0, kElevation = 25.0 * kPi / 180.0;
constexpr double kMostHeight = 400.0 / 360.0;  ///< greatest height of the oblique view, in widths of the drawing
constexpr double kMostFlatHeight = 0.72;       ///< the same for plans and elevations, which are shown side by side
constexpr double kMarginLeft = 28.0, kMarginRight = 28.0, kMarginTop = 8.0, kMarginBottom = 20.0;
constexpr int kGridLines = 9;  ///< approximate number along the longest side
constexpr double kTrackTolerance = 0.35;
constexpr std::size_t kMostCells = 4000;  ///< most cells with points in a drawing

/// Parallel projection [m]: x to the right, y downwards as in SVG.
Vector2d projected(Look look, const Vector3d& p_W) {
  if (look == Look::above) return {p_W.x(), -p_W.y()};
  if (look == Look::from_south) return {p_W.x(), -p_W.z()};
  if (look == Look::from_east) return {p_W.y(), -p_W.z()};
  const double right = -std::sin(kAzimuth) * p_W.x() + std::cos(kAzimuth) * p_W.y();
  const double away = -std::cos(kAzimuth) * p_W.x() - std::sin(kAzimuth) * p_W.y();
  return {right, -(std::cos(kElevation) * p_W.z() + std::sin(kElevation) * away)};
}

std::string pair(const Vector2d& p) { return coordinate(p.x()) + " " + coordinate(p.y()); }

/// "M1 2L3 4 5 6".
std::string path_data(const std::vector<Vector2d>& line) {
  std::string data;
  for (std::size_t i = 0; i < line.size(); ++i) data += (i == 0 ? "M" : i == 1 ? "L" : " ") + pair(line[i]);
  return data;
}

std::string path(const std::string& style, const std::string& data) {
  return data.empty() ? "" : "<path class=\"" + style + "\" d=\"" + data + "\"/>\n";
}

std::string text(const Vector2d& at, const std::string& anchor, const std::string& words) {
  return fmt::format("<text class=\"tick {}\" x=\"{}\" y=\"{}\">{}</text>\n", anchor, coordinate(at.x()),
                     coordinate(at.y()), words);
}

/// Calls `use` with each station, corner of a box, interest point and position of a track.
void each_point(const std::vector<const FlightPicture*>& pictures, const auto& use) {
  for (const FlightPicture* picture : pictures) {
    if (picture->station) use(*picture->station);
    for (const auto& corners : picture->boxes) std::for_each(corners.begin(), corners.end(), use);
    for (const PicturePoint& point : picture->points) use(point.p_W);
    for (const PictureTrack& track : picture->tracks) std::for_each(track.p_WB.begin(), track.p_WB.end(), use);
  }
}

/// The multiples of `step` within a range.
std::vector<double> multiples(double low, double high, double step) {
  std::vector<double> values;
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i += 1.0) values.push_back(i * step);
  return values;
}

/// Texts along the axes; a text that would overlap an earlier one is left out.
class Labels {
 public:
  void add(const Vector2d& at, const std::string& anchor, const std::string& words) {
    const auto near = [&](const Vector2d& other) {
      return std::abs(at.x() - other.x()) < 18.0 && std::abs(at.y() - other.y()) < 9.0;
    };
    if (std::any_of(taken_.begin(), taken_.end(), near)) return;
    taken_.push_back(at);
    svg_ += text(at, anchor, words);
  }
  const std::string& svg() const { return svg_; }

 private:
  std::vector<Vector2d> taken_;
  std::string svg_;
};

/// Grid lines and numbers of a plan or an elevation.
std::string flat_grid_svg(const PictureView& view) {
  const int across = view.look() == Look::from_east ? 1 : 0, upwards = view.look() == Look::above ? 1 : 2;
  const Vector3d &low = view.low(), &high = view.high();
  const Axis numbers{0.0, 1.0, view.grid_m()};
  const auto at = [&](double right, double up) {
    Vector3d p_W = low;
    p_W[across] = right;
    p_W[upwards] = up;
    return view.at(p_W);
  };
  const char* const names[] = {"x [m]", "y [m]", "z [m]"};
  Labels labels;
  labels.add(at(0.5 * (low[across] + high[across]), low[upwards]) + Vector2d(0.0, 18.0), "middle", names[across]);
  labels.add(at(low[across], high[upwards]) + Vector2d(-26.0, 0.0), "", names[upwards]);
  std::string lines;
  for (const double tick : multiples(low[across], high[across], view.grid_m())) {
    lines += path_data({at(tick, low[upwards]), at(tick, high[upwards])});
    labels.add(at(tick, low[upwards]) + Vector2d(0.0, 9.0), "middle", numbers.label(tick));
  }
  for (const double tick : multiples(low[upwards], high[upwards], view.grid_m())) {
    lines += path_data({at(low[across], tick), at(high[across], tick)});
    labels.add(at(low[across], tick) + Vector2d(-4.0, 3.0), "end", numbers.label(tick));
  }
  return path("grid", lines) + labels.svg();
}

/// Grid lines and numbers: in the oblique view, on the ground and along the axis of heights.
std::string grid_svg(const PictureView& view) {
  if (view.look() != Look::aside) return flat_grid_svg(view);
  const Vector3d &low = view.low(), &high = view.high(), middle = 0.5 * (low + high);
  const double step = view.grid_m();
  const Axis numbers{0.0, 1.0, step};
  Labels labels;
  labels.add(view.at({middle.x(), low.y(), low.z()}) + Vector2d(-10.0, 23.0), "middle", "x [m]");
  labels.add(view.at({high.x(), middle.y(), low.z()}) + Vector2d(22.0, 21.0), "middle", "y [m]");
  labels.add(view.at({low.x(), low.y(), high.z()}) + Vector2d(4.0, 4.0), "", "z [m]");
  std::string lines = path_data({view.at(low), view.at({high.x(), low.y(), low.z()}),
                                 view.at({high.x(), high.y(), low.z()}), view.at({low.x(), high.y(), low.z()})}) +
                      "Z";
  for (const double tick : multiples(low.x(), high.x(), step)) {
    lines += path_data({view.at({tick, low.y(), low.z()}), view.at({tick, high.y(), low.z()})});
    labels.add(view.at({tick, low.y(), low.z()}) + Vector2d(-2.0, 10.0), "middle", numbers.label(tick));
  }
  for (const double tick : multiples(low.y(), high.y(), step)) {
    lines += path_data({view.at({low.x(), tick, low.z()}), view.at({high.x(), tick, low.z()})});
    labels.add(view.at({high.x(), tick, low.z()}) + Vector2d(4.0, 7.0), "", numbers.label(tick));
  }
  std::string height = path_data({view.at(low), view.at({low.x(), low.y(), high.z()})});
  for (const double tick : multiples(low.z() + 0.5 * step, high.z(), step)) {  // not at the ground
    const Vector2d at = view.at({low.x(), low.y(), tick});
    height += path_data({at, at + Vector2d(-4.0, 0.0)});
    labels.add(at + Vector2d(-6.0, 3.0), "end", numbers.label(tick));
  }
  return path("grid", lines) + path("axis", height) + labels.svg();
}

std::string boxes_svg(const FlightPicture& picture, const PictureView& view) {
  std::string data;
  for (const auto& corners : picture.boxes) {
    for (std::size_t i = 0; i < 8; ++i) {
      for (const std::size_t bit : {1U, 2U, 4U}) {
        if ((i & bit) == 0) data += path_data({view.at(corners[i]), view.at(corners[i | bit])});
      }
    }
  }
  return path("bounds", data);
}

/// Colour by score: 0 if the point was not detected, otherwise 1 to kScoreColours.
std::size_t colour_of(double score) {
  if (score < kDetected) return 0;
  const double share = (score - kDetected) / (1.0 - kDetected);
  return 1 + std::min(static_cast<std::size_t>(share * kScoreColours), kScoreColours - 1);
}

/// Colours of points: 0 to kScoreColours by score, then one for each cause. If several points are in one cell of the
/// drawing, the one with the greatest number is drawn.
constexpr std::size_t kPointColours = kScoreColours + 1 + results::kCauses.size();

std::size_t colour_of(const PicturePoint& point, const PictureStyle& style) {
  if (style.only_cause) return point.cause == style.only_cause ? kScoreColours + 1 + *point.cause : 0;
  if (!style.by_cause) return colour_of(point.score);
  return point.cause ? kScoreColours + 1 + *point.cause : 0;
}

std::map<std::pair<int, int>, std::size_t> cells_of(const FlightPicture& picture, const PictureView& view,
                                                    const PictureStyle& style, double cell) {
  std::map<std::pair<int, int>, std::size_t> colours;
  for (const PicturePoint& point : picture.points) {
    const Vector2d at = view.at(point.p_W) / cell;
    std::size_t& colour = colours[{static_cast<int>(std::lround(at.y())), static_cast<int>(std::lround(at.x()))}];
    colour = std::max(colour, colour_of(point, style));
  }
  return colours;
}

std::string points_svg(const FlightPicture& picture, const PictureView& view, const PictureStyle& style) {
  double cell = 1.0;
  auto cells = cells_of(picture, view, style, cell);
  while (cells.size() > kMostCells) cells = cells_of(picture, view, style, cell *= 1.3);
  std::array<std::string, kPointColours> data;
  std::array<std::pair<int, int>, kPointColours> last{};
  for (const auto& [at, colour] : cells) {  // relative to the last cell of this colour, which keeps the text short
    const auto [y, x] = at;
    data[colour] += fmt::format("m{} {}h0", x - last[colour].second, y - last[colour].first);
    last[colour] = at;
  }
  std::string svg =
      fmt::format("<g class=\"points\" transform=\"scale({:.4g})\" stroke-width=\"{:.4g}\">\n", cell, 1.7 / cell);
  for (std::size_t colour = 0; colour < data.size(); ++colour) {
    svg += path(colour <= kScoreColours ? fmt::format("q{}", colour) : fmt::format("k{}", colour - kScoreColours - 1),
                data[colour]);
  }
  return svg + "</g>\n";
}

std::string tracks_svg(const FlightPicture& picture, const PictureView& view) {
  std::string svg;
  for (std::size_t i = 0; i < picture.tracks.size(); ++i) {
    const PictureTrack& track = picture.tracks[i];
    std::vector<Vector2d> line;
    for (const Vector3d& p_WB : track.p_WB) line.push_back(view.at(p_WB));
    if (line.empty()) continue;
    const std::string style = fmt::format("track t{}{}{}", i % kTrackColours, i >= kTrackColours ? " again" : "",
                                          track.explorer ? " explorer" : "");
    svg += path(style, path_data(simplified(line, kTrackTolerance)));
    svg += fmt::format(
        "<circle class=\"start t{}\" cx=\"{}\" cy=\"{}\" r=\"2.2\"><title>{} starts here</title></circle>\n",
        i % kTrackColours, coordinate(line.front().x()), coordinate(line.front().y()), escaped(track.uav));
  }
  return svg;
}

/// Marks of the station and of collisions.
std::string marks_svg(const FlightPicture& picture, const PictureView& view) {
  std::string svg;
  if (picture.station) {
    const Vector2d at = view.at(*picture.station);
    svg += fmt::format("<path class=\"station\" d=\"M{}l4 7h-8Z\"><title>ground station</title></path>\n",
                       pair(at - Vector2d(0.0, 4.0)));
  }
  for (const Vector3d& p_W : picture.collisions) {
    svg += fmt::format("<path class=\"collision\" d=\"M{}l8 8m0 -8l-8 8\"><title>collision</title></path>\n",
                       pair(view.at(p_W) - Vector2d(4.0, 4.0)));
  }
  return svg;
}

}  // namespace

PictureView::PictureView(const std::vector<const FlightPicture*>& pictures, Look look, double width)
    : look_(look), width_(width) {
  const double infinite = std::numeric_limits<double>::infinity();
  Vector3d low = Vector3d::Constant(infinite), high = Vector3d::Constant(-infinite);
  const auto take_in = [&](const Vector3d& p_W) {
    low = low.cwiseMin(p_W);
    high = high.cwiseMax(p_W);
  };
  each_point(pictures, take_in);
  if (!(low.x() <= high.x())) take_in(Vector3d::Zero());
  low.z() = std::min(low.z(), 0.0);
  const double longest = std::max((high - low).maxCoeff(), 1.0);
  grid_m_ = nice_axis(0.0, longest, kGridLines).step;
  const Vector3d margin(0.02 * longest, 0.02 * longest, 0.0);
  low_ = low - margin;
  high_ = high + margin;
  high_.z() = std::max(high.z(), low.z() + 0.05 * longest);

  Vector2d least = Vector2d::Constant(infinite), most = Vector2d::Constant(-infinite);
  const auto make_room = [&](const Vector3d& p_W) {
    least = least.cwiseMin(projected(look_, p_W));
    most = most.cwiseMax(projected(look_, p_W));
  };
  each_point(pictures, make_room);
  for (const double x : {low_.x(), high_.x()}) {
    for (const double y : {low_.y(), high_.y()}) make_room({x, y, low_.z()});
  }
  make_room({low_.x(), low_.y(), high_.z()});  // the axis of heights
  const Vector2d size = most - least;
  scale_ = std::min((width - kMarginLeft - kMarginRight) / size.x(),
                    (look == Look::aside ? kMostHeight : kMostFlatHeight) * width / size.y());
  height_ = scale_ * size.y() + kMarginTop + kMarginBottom;
  const double centred = 0.5 * (width - kMarginLeft - kMarginRight - scale_ * size.x());
  offset_ = Vector2d(kMarginLeft + centred, kMarginTop) - scale_ * least;
}

Vector2d PictureView::at(const Vector3d& p_W) const { return scale_ * projected(look_, p_W) + offset_; }

std::string picture_svg(const FlightPicture& picture, const PictureView& view, const std::string& title,
                        const PictureStyle& style) {
  std::string svg = fmt::format(
      "<svg class=\"picture\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\" "
      "xmlns=\"http://www.w3.org/2000/svg\">\n",
      coordinate(view.width()), coordinate(view.height()), escaped(title));
  svg += style.ground + grid_svg(view) + points_svg(picture, view, style) + boxes_svg(picture, view);
  if (style.tracks) svg += tracks_svg(picture, view);
  svg += marks_svg(picture, view);
  return svg + "</svg>\n";
}

std::string picture_legend(const FlightPicture& picture) {
  std::string html = "<ul class=\"legend\">\n";
  for (std::size_t i = 0; i < picture.tracks.size(); ++i) {
    const PictureTrack& track = picture.tracks[i];
    html += fmt::format(
        "<li><svg viewBox=\"0 0 22 10\" aria-hidden=\"true\"><path class=\"track t{}{}{}\" d=\"M1 5L21 5\"/></svg>{}, "
        "{}"
        "</li>\n",
        i % kTrackColours, i >= kTrackColours ? " again" : "", track.explorer ? " explorer" : "", escaped(track.uav),
        track.explorer ? "explorer" : "photographer");
  }
  const double step = (1.0 - kDetected) / kScoreColours;
  html += "<li><span class=\"swatch\" style=\"background:var(--q0)\"></span>not detected</li>\n";
  for (std::size_t i = 0; i < kScoreColours; ++i) {
    const double from = kDetected + step * static_cast<double>(i);
    html += fmt::format("<li><span class=\"swatch\" style=\"background:var(--q{})\"></span>score {} to {}</li>\n",
                        i + 1, fixed(from, 1), fixed(from + step, 1));
  }
  return html + "<li>dashed: boxes that the fleet is told</li>\n</ul>\n";
}

std::vector<Vector2d> simplified(const std::vector<Vector2d>& line, double tolerance) {
  if (line.size() < 3) return line;
  std::vector<bool> stays(line.size(), false);
  stays.front() = stays.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, line.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    std::size_t farthest = first;
    double distance = tolerance;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double d = distance_to_segment(line[i], line[first], line[last]);
      if (d > distance) {
        distance = d;
        farthest = i;
      }
    }
    if (farthest == first) continue;
    stays[farthest] = true;
    open.push_back({first, farthest});
    open.push_back({farthest, last});
  }
  std::vector<Vector2d> kept;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (stays[i]) kept.push_back(line[i]);
  }
  return kept;
}

}  // namespace skein::report
