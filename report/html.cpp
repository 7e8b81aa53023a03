#include "report/html.hpp"

#include <algorithm>
#include <cmath>

#include "core/text/utf8.hpp"
#include "report/style.hpp"
#include "report/web_bundle.hpp"

namespace skein::report {
namespace {

/// The smallest number of the form 1, 2 or 5 times a power of ten that is at least `step`.
double round_step(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= step * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : printable(std::string(text))) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string fixed(const std::optional<double>& value, int digits) { return value ? fixed(*value, digits) : "–"; }

std::string coordinate(double value) { return fixed_at_most(value, 1); }

std::string shortened(const std::string& text, std::size_t most) {
  std::size_t characters = 0, end = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!continues_character(text[i]) && ++characters == most) end = i;
  }
  return characters <= most ? text : text.substr(0, end) + "…";
}

std::string page_begin(const std::string& title, const std::optional<std::string>& script, const std::string& classes,
                       std::string_view css) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"" +
         escaped(policy_of_file(script)) +
         "\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>Skein: " +
         escaped(title) + "</title>\n<style>\n" + std::string(base_style()) + std::string(drawing_style()) +
         std::string(run_style()) + std::string(css) + "</style>\n</head>\n<body class=\"" + classes + "\">\n<main>\n";
}

std::string figure(const std::string& caption, const std::string& small, const std::string& svg) {
  return "<figure><figcaption>" + escaped(caption) + (small.empty() ? "" : "<small>" + escaped(small) + "</small>") +
         "</figcaption>\n" + svg + "</figure>\n";
}

std::vector<double> Axis::ticks() const {
  std::vector<double> ticks;
  const auto count = std::lround((high - low) / step);
  for (long i = 0; i <= count; ++i) ticks.push_back(low + static_cast<double>(i) * step);
  return ticks;
}

std::string Axis::label(double tick) const {
  const int digits = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  return fixed(tick, digits);
}

Axis nice_axis(double low, double high, int about) {
  if (low > 0.0 && low < 0.5 * high) low = 0.0;
  if (high < 0.0 && high > 0.5 * low) high = 0.0;
  if (!(high > low)) {
    const double margin = low == 0.0 ? 0.5 : 0.05 * std::abs(low);
    high = low + margin;
    low -= low == 0.0 ? 0.0 : margin;
  }
  const double step = round_step((high - low) / about);
  return {step * std::floor(low / step + 1e-9), step * std::ceil(high / step - 1e-9), step};
}

}  // namespace skein::report
