// Units of numbers in expressions over the signals of a run (expression.hpp): the exponents of metre, second, radian
// and byte. For counts, shares and scores, all exponents are 0.  Pure.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace skein {

struct Unit {
  int metre = 0, second = 0, radian = 0, byte = 0;

  bool operator==(const Unit&) const = default;
  Unit operator*(const Unit& other) const {
    return {metre + other.metre, second + other.second, radian + other.radian, byte + other.byte};
  }
  Unit operator/(const Unit& other) const {
    return {metre - other.metre, second - other.second, radian - other.radian, byte - other.byte};
  }
};

inline constexpr Unit kPlainNumber{}, kMetres{.metre = 1}, kSeconds{.second = 1}, kRadians{.radian = 1},
    kBytes{.byte = 1}, kMetresPerSecond{.metre = 1, .second = -1}, kRadiansPerSecond{.second = -1, .radian = 1};

/// A unit as users write it after a number. The number times `factor` is in SI units.
struct UnitName {
  std::string_view name;
  Unit unit;
  double factor = 1.0;
};
/// Units with a slash come first, because a search for "m" would also match "m/s".
inline constexpr std::array kUnitNames = {
    UnitName{"m/s", kMetresPerSecond},
    UnitName{"deg/s", kRadiansPerSecond, 3.14159265358979323846 / 180.0},
    UnitName{"rad/s", kRadiansPerSecond},
    UnitName{"m", kMetres},
    UnitName{"cm", kMetres, 1e-2},
    UnitName{"km", kMetres, 1e3},
    UnitName{"s", kSeconds},
    UnitName{"ms", kSeconds, 1e-3},
    UnitName{"deg", kRadians, 3.14159265358979323846 / 180.0},
    UnitName{"rad", kRadians},
    UnitName{"B", kBytes},
    UnitName{"kB", kBytes, 1e3},
    UnitName{"%", kPlainNumber, 1e-2},
};

/// "m", "m/s", "m s", "" for a plain number.
inline std::string unit_text(const Unit& unit) {
  std::string above, below;
  const auto add = [](std::string& to, const char* name, int exponent) {
    if (exponent == 0) return;
    to += (to.empty() ? "" : " ") + std::string(name);
    if (exponent > 1) to += "^" + std::to_string(exponent);
  };
  const auto place = [&](const char* name, int exponent) {
    exponent > 0 ? add(above, name, exponent) : add(below, name, -exponent);
  };
  place("m", unit.metre);
  place("rad", unit.radian);
  place("B", unit.byte);
  place("s", unit.second);
  if (below.empty()) return above;
  return (above.empty() ? "1" : above) + "/" + below;
}

/// A number with its unit, in SI.
struct Quantity {
  double value = 0.0;
  Unit unit;
};

}  // namespace skein
