#include "report/time_chart.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "report/flight_picture.hpp"
#include "report/html.hpp"

namespace skein::report {
namespace {

constexpr double kChartTop = 8.0, kCurves = 210.0, kRug = 11.0, kGap = 3.0, kAxisRoom = 32.0;
constexpr double kAcross = 1000.0;  ///< width of the stretched parts of a chart, in their own units
constexpr std::size_t kMostRugs = 12;
constexpr int kNameLetters = 11;

/// The time axis, as wide as the chart.
class TimeScale {
 public:
  explicit TimeScale(double end_s) : end_s_(std::max(end_s, 1.0)) {}

  /// x of a simulated time [s] in stretched parts.
  double at(double time_s) const { return kAcross * std::clamp(time_s, 0.0, end_s_) / end_s_; }
  /// The same in all other parts.
  std::string share(double time_s) const { return percent(at(time_s)); }
  static std::string percent(double across) { return fixed(100.0 * across / kAcross, 2) + "%"; }
  /// Grid lines, their numbers and the axis title.
  std::string grid(double top, double bottom) const {
    const double step = nice_axis(0.0, end_s_, 10).step;
    const Axis axis{0.0, end_s_, step};
    std::string svg;
    for (double tick = 0.0; tick <= end_s_ + 1e-9; tick += step) {
      svg += fmt::format(
          "<line class=\"grid\" x1=\"{0}\" x2=\"{0}\" y1=\"{1}\" y2=\"{2}\"/>"
          "<text class=\"middle\" x=\"{0}\" y=\"{3}\">{4}</text>\n",
          share(tick), coordinate(top), coordinate(bottom), coordinate(bottom + 13.0), axis.label(tick));
    }
    return svg + fmt::format("<text class=\"middle\" x=\"50%\" y=\"{}\">simulated time [s]</text>\n",
                             coordinate(bottom + 27.0));
  }

 private:
  double end_s_;
};

std::string open_svg(const std::string& attributes, const std::string& title) {
  return fmt::format("<svg {} role=\"img\" aria-label=\"{}\" xmlns=\"http://www.w3.org/2000/svg\">\n", attributes,
                     escaped(title));
}

/// A chart over time, for windows of any width: only what stretched() contains is stretched along the time axis;
/// letters, marks and all heights stay as they are. Names are to the left of x = 0.
std::string time_svg(const std::string& style, const std::string& title, double height, const std::string& content) {
  return "<div class=\"time-chart" + style + "\">\n" +
         open_svg("style=\"height:" + coordinate(height) + "px\"", title) + content + "</svg></div>\n";
}

/// @param height  of the whole chart.
std::string stretched(double height, const std::string& content) {
  return fmt::format("<svg class=\"stretched\" viewBox=\"0 0 {} {}\" preserveAspectRatio=\"none\">\n",
                     coordinate(kAcross), coordinate(height)) +
         content + "</svg>\n";
}

/// Bars of some spans of time, in one path.
std::string spans_svg(const Spans& spans, const TimeScale& time, double top, double height, const std::string& style) {
  std::string data;
  double drawn = -1.0;  // right end of the last bar; a span that this bar would hide is left out
  for (const Span& span : spans) {
    const double from = std::max(time.at(span.from_s), drawn), until = std::max(time.at(span.until_s), from + 0.4);
    if (until <= drawn) continue;
    data += fmt::format("M{} {}H{}v{}H{}Z", coordinate(from), coordinate(top), coordinate(until), coordinate(height),
                        coordinate(from));
    drawn = until;
  }
  return data.empty() ? "" : fmt::format("<path class=\"{}\" d=\"{}\"/>\n", style, data);
}

/// A tick at each time. Of ticks less than half a unit apart, only the first is drawn.
std::string rug_svg(const std::vector<double>& times_s, const TimeScale& time, double top, double height,
                    const std::string& style) {
  std::string data;
  double last = -1.0;
  for (const double time_s : times_s) {
    const double x = time.at(time_s);
    if (x - last < 0.5) continue;
    data += fmt::format("M{} {}v{}", coordinate(x), coordinate(top), coordinate(height));
    last = x;
  }
  return data.empty() ? "" : fmt::format("<path class=\"{}\" d=\"{}\"/>\n", style, data);
}

/// Path data of a step curve. Of several steps at nearly the same x (within 0.6 units), only the last is drawn.
std::string staircase(const std::vector<std::pair<double, double>>& changes, const TimeScale& time, double end_s,
                      const auto& y_of) {
  std::string data;
  double last_x = -1e9;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const double x = time.at(changes[i].first);
    if (i + 1 < changes.size() && i > 0 && time.at(changes[i + 1].first) - last_x < 0.6) continue;
    data += data.empty() ? fmt::format("M{} {}", coordinate(x), coordinate(y_of(changes[i].second)))
                         : fmt::format("H{}V{}", coordinate(x), coordinate(y_of(changes[i].second)));
    last_x = x;
  }
  return data.empty() ? "" : data + "H" + coordinate(time.at(end_s));
}

std::string faults_svg(const results::RunRecord& run, const TimeScale& time, double top, double bottom) {
  std::string svg;
  for (const results::RunFault& fault : run.faults) {
    const std::string words =
        fault.kind + " " + fault.target + ", " + fixed(fault.from_s, 1) + " to " + fixed(fault.until_s, 1) + " s";
    const double across = std::max(1.0, time.at(fault.until_s) - time.at(fault.from_s));
    svg += fmt::format("<rect class=\"fault\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"><title>{}</title></rect>\n",
                       time.share(fault.from_s), coordinate(top), TimeScale::percent(across), coordinate(bottom - top),
                       escaped(words));
  }
  return svg;
}

Axis value_axis(const std::vector<TimeCurve>& curves) {
  double low = 0.0, high = 0.0;
  for (const TimeCurve& curve : curves) {
    for (const auto& [time_s, value] : curve.changes) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  return nice_axis(low, high, 4);
}

std::string uav_style(std::size_t uav) { return fmt::format("t{}", uav % kTrackColours); }

/// The four strips of one UAV, for stretched(). @param strip  height of each. @param most  undelivered captures at the
/// full height.
std::string lane_svg(const Lane& lane, const TimeScale& time, double end_s, double top, double strip, int most) {
  const double gap = strip + kGap;
  const double gone_s = lane.collided_s.value_or(end_s);
  std::string svg = spans_svg(lane.taking_part, time, top, strip, "flying") +
                    spans_svg(lane.still, time, top, strip, "still") +
                    (lane.collided_s ? spans_svg({{gone_s, end_s}}, time, top, strip, "gone") : "") +
                    spans_svg(lane.direct, time, top + gap, strip, "direct") +
                    spans_svg(lane.relayed, time, top + gap, strip, "relayed") +
                    rug_svg(lane.captures_s, time, top + 2.0 * gap, strip, "rug");
  const double base = top + 3.0 * gap + strip;
  const auto y_of = [&](double captures) { return base - strip * captures / most; };
  std::vector<std::pair<double, double>> waiting;
  for (const Waiting& change : lane.undelivered) waiting.emplace_back(change.time_s, change.captures);
  const std::string line = staircase(waiting, time, end_s, y_of);
  if (!line.empty()) {
    svg += fmt::format("<path class=\"waiting\" d=\"{}V{}H{}Z\"/>\n", line, coordinate(base),
                       coordinate(time.at(waiting.front().first)));
  }
  return svg;
}

/// A cross where a UAV collided. It must not be stretched.
std::string collision_svg(double collided_s, const TimeScale& time, double middle) {
  return fmt::format(
      "<svg x=\"{}\"><path class=\"collision\" d=\"M-4 {}l8 8m0 -8l-8 8\"><title>collision at {} "
      "s</title></path></svg>\n",
      time.share(collided_s), coordinate(middle - 4.0), fixed(collided_s, 1));
}

}  // namespace

bool concerns(const results::RunFault& fault, const std::string& uav) {
  for (std::size_t at = fault.target.find(uav); at != std::string::npos; at = fault.target.find(uav, at + 1)) {
    const auto is_word = [&](std::size_t i) {
      return i < fault.target.size() &&
             (std::isalnum(static_cast<unsigned char>(fault.target[i])) || fault.target[i] == '_');
    };
    if ((at == 0 || !is_word(at - 1)) && !is_word(at + uav.size())) return true;
  }
  return false;
}

std::string time_chart_svg(const std::string& title, const std::vector<TimeCurve>& curves,
                           const results::RunRecord& run, const std::vector<Lane>& lanes) {
  const std::size_t rugs = lanes.size() <= kMostRugs ? lanes.size() : 0;
  const double bottom = kChartTop + kCurves, all = bottom + (rugs > 0 ? 6.0 + kRug * static_cast<double>(rugs) : 0.0);
  const TimeScale time(run.end_s);
  const Axis axis = value_axis(curves);
  const auto y_of = [&](double value) { return bottom - kCurves * axis.share(value); };
  std::string svg = faults_svg(run, time, kChartTop, all) + time.grid(kChartTop, all);
  for (const double tick : axis.ticks()) {
    svg += fmt::format(
        "<line class=\"grid\" x1=\"0\" x2=\"100%\" y1=\"{0}\" y2=\"{0}\"/>"
        "<text class=\"end\" x=\"-5\" y=\"{1}\">{2}</text>\n",
        coordinate(y_of(tick)), coordinate(y_of(tick) + 3.5), axis.label(tick));
  }
  std::string over_time;
  for (const TimeCurve& curve : curves) {
    over_time += fmt::format("<path class=\"curve {}\" d=\"{}\"><title>{}</title></path>\n", curve.style,
                             staircase(curve.changes, time, run.end_s, y_of), escaped(curve.name));
  }
  for (std::size_t uav = 0; uav < rugs; ++uav) {
    const double top = bottom + 6.0 + kRug * static_cast<double>(uav);
    svg += fmt::format("<text class=\"end\" x=\"-5\" y=\"{}\">{}</text>\n", coordinate(top + 8.0),
                       escaped(shortened(run.uavs[uav], kNameLetters)));
    over_time += rug_svg(lanes[uav].captures_s, time, top + 1.0, kRug - 3.0, "rug " + uav_style(uav));
  }
  const double height = all + kAxisRoom;
  return time_svg("", title, height, svg + stretched(height, over_time));
}

std::string lanes_svg(const std::string& title, const results::RunRecord& run, const std::vector<Lane>& lanes) {
  const bool rows_named = lanes.size() <= 20;
  const double strip = rows_named ? 10.0 : 4.0, each = 4.0 * (strip + kGap) + (rows_named ? 12.0 : 6.0);
  const double bottom = kChartTop + each * static_cast<double>(lanes.size());
  const TimeScale time(run.end_s);
  int most = 1;
  for (const Lane& lane : lanes) {
    for (const Waiting& change : lane.undelivered) most = std::max(most, change.captures);
  }
  std::string svg = time.grid(kChartTop, bottom), names, rows, over_time, collisions;
  for (std::size_t uav = 0; uav < lanes.size(); ++uav) {
    const double top = kChartTop + each * static_cast<double>(uav) + 4.0;
    results::RunRecord own;
    for (const results::RunFault& fault : run.faults) {
      if (concerns(fault, run.uavs[uav])) own.faults.push_back(fault);
    }
    svg += faults_svg(own, time, top - 3.0, top + each - 8.0);
    names += fmt::format("<text class=\"name\" y=\"{}\">{}</text>\n", coordinate(top + 8.0),
                         escaped(shortened(run.uavs[uav], kNameLetters)));
    if (rows_named) {
      const char* const kinds[] = {"flying, still", "station", "captures", "undelivered"};
      for (std::size_t row = 0; row < 4; ++row) {
        rows += fmt::format("<text class=\"end\" x=\"-5\" y=\"{}\">{}</text>\n",
                            coordinate(top + 8.0 + static_cast<double>(row) * (strip + kGap)), kinds[row]);
      }
    }
    over_time += lane_svg(lanes[uav], time, run.end_s, top, strip, most);
    if (lanes[uav].collided_s) collisions += collision_svg(*lanes[uav].collided_s, time, top + 0.5 * strip);
  }
  const double height = bottom + kAxisRoom;
  return time_svg(" lanes", title, height,
                  svg + "<g class=\"names\">\n" + names + "</g>\n<g class=\"rows\">\n" + rows + "</g>\n" +
                      stretched(height, over_time) + collisions);
}

std::string latency_svg(const std::string& title, const Latency& latency) {
  static constexpr double kLimits[] = {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1e300};
  constexpr std::size_t kBins = std::size(kLimits) + 1;  // the last bin: never delivered
  std::size_t counts[kBins] = {};
  for (const double delay_s : latency.delays_s) {
    ++counts[static_cast<std::size_t>(std::lower_bound(std::begin(kLimits), std::end(kLimits), delay_s - 1e-6) -
                                      kLimits)];
  }
  counts[kBins - 1] = latency.never;
  const std::size_t most = std::max<std::size_t>(1, *std::max_element(counts, counts + kBins));
  constexpr double kW = 480.0, kBottom = 170.0, kWide = (kW - 16.0) / kBins;
  std::string svg =
      open_svg(fmt::format("class=\"chart\" viewBox=\"0 0 {} {}\"", coordinate(kW), coordinate(kBottom + 42.0)), title);
  for (std::size_t i = 0; i < kBins; ++i) {
    const double x = 8.0 + kWide * static_cast<double>(i),
                 h = 146.0 * static_cast<double>(counts[i]) / static_cast<double>(most);
    const std::string label = i + 1 == kBins ? "never" : i + 2 == kBins ? "more" : "≤ " + shortest(kLimits[i]);
    svg += fmt::format("<rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n",
                       i + 1 == kBins ? "bar never" : "bar", coordinate(x + 1.5), coordinate(kBottom - h),
                       coordinate(kWide - 3.0), coordinate(h));
    svg += fmt::format(
        "<text class=\"middle\" x=\"{0}\" y=\"{1}\">{2}</text>\n<text class=\"middle\" x=\"{0}\" "
        "y=\"{3}\">{4}</text>\n",
        coordinate(x + 0.5 * kWide), coordinate(kBottom - h - 3.0), counts[i] > 0 ? std::to_string(counts[i]) : "",
        coordinate(kBottom + 13.0), label);
  }
  return svg +
         fmt::format(
             "<path class=\"axis\" d=\"M8 {0}H{1}\"/><text class=\"middle\" x=\"{2}\" y=\"{3}\">from picture to "
             "delivery [s]</text>\n",
             coordinate(kBottom), coordinate(kW - 8.0), coordinate(0.5 * kW), coordinate(kBottom + 32.0)) +
         "</svg>\n";
}

}  // namespace skein::report
