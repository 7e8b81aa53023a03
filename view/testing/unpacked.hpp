// For tests: decodes packed points and runs of cubes as web/src/packed.js does.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.hpp"
#include "view/cube_runs.hpp"

namespace skein::view {

inline std::vector<std::uint8_t> from_base64(std::string_view text) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char digit : text) {
    if (digit == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(kDigits.find(digit));
    if ((count += 6) < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count));
  }
  return bytes;
}

inline std::vector<CubeRun> unpacked_runs(std::string_view text) {
  const std::vector<std::uint8_t> bytes = from_base64(text);
  std::size_t at = 0;
  const auto next = [&] {
    unsigned value = 0;
    for (int shift = 0;; shift += 7) {
      const unsigned byte = bytes.at(at++);
      value |= (byte & 127U) << shift;
      if (byte < 128) return value;
    }
  };
  const auto next_signed = [&] {
    const unsigned value = next();
    return static_cast<int>(value >> 1) ^ -static_cast<int>(value & 1U);
  };
  std::vector<CubeRun> runs;
  CubeRun run{0, 0, 0, 0};
  while (at < bytes.size()) {
    const unsigned head = next();
    if ((head & 1U) != 0) {
      run.x += run.length + static_cast<int>(next());
    } else {
      run.z += next_signed();
      run.y += next_signed();
      run.x += next_signed();
    }
    run.length = static_cast<int>(head >> 1) + 1;
    runs.push_back(run);
  }
  return runs;
}

inline std::vector<Vector3d> unpacked_points(std::string_view text) {
  const std::vector<std::uint8_t> bytes = from_base64(text);
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i + 6 <= bytes.size(); i += 6) {
    const auto along = [&](std::size_t axis) {
      return 0.1 * static_cast<std::int16_t>(bytes[i + 2 * axis] | bytes[i + 2 * axis + 1] << 8);
    };
    points.emplace_back(along(0), along(1), along(2));
  }
  return points;
}

}  // namespace skein::view
