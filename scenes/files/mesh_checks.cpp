#include "scenes/files/mesh_checks.hpp"

#include <array>
#include <charconv>

#include "scenes/files/limits.hpp"

namespace skein::sim {

void refuse_count(const std::filesystem::path& file, const std::string& triangles) {
  refuse(file, "has " + triangles + " than the " + std::to_string(kMostTriangles) +
                   " triangles that are accepted; simplify the mesh");
}

void check_count(const std::filesystem::path& file, std::size_t triangles) {
  if (triangles == 0) refuse(file, "has no triangles; a structure needs at least one");
  if (triangles > kMostTriangles) refuse_count(file, std::to_string(triangles) + " triangles, more");
}

void check_vertex(const std::filesystem::path& file, std::size_t triangle, const Eigen::Vector3f& vertex) {
  const auto wrong = [&](const char* why) { refuse(file, "triangle " + std::to_string(triangle) + why); };
  if (!vertex.allFinite()) wrong(" has a vertex that is not finite");
  if (vertex.cwiseAbs().maxCoeff() > kFarthest) {
    wrong(" has a vertex farther than 100 km from the origin; are these metres?");
  }
}

std::optional<float> parsed_float(std::string_view word) {
  const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
  const char* const end = digits.data() + digits.size();
  float value = 0.0F;
  auto result = std::from_chars(digits.data(), end, value);
  if (result.ec == std::errc::result_out_of_range) {
    double wide = 0.0;
    result = std::from_chars(digits.data(), end, wide);
    value = static_cast<float>(wide);
  }
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return value;
}

void append_plain(std::string& text, float number) {
  std::array<char, 80> digits{};  // the longest number has fewer characters
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed);
  text.append(" ").append(digits.data(), end.ptr);
}

}  // namespace skein::sim
