// Checks that the readers of all mesh formats share. Frame W; metres. Pure; any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/types.hpp"

namespace skein::sim {

/// @param triangles  how many there are, in words, for example "3000000 triangles, more".
/// @throws InputError  always.
[[noreturn]] void refuse_count(const std::filesystem::path& file, const std::string& triangles);

/// @throws InputError if there are no triangles, or more than kMostTriangles.
void check_count(const std::filesystem::path& file, std::size_t triangles);

/// @throws InputError if the vertex is not finite, or has a coordinate beyond kFarthest. @param triangle  its number.
void check_vertex(const std::filesystem::path& file, std::size_t triangle, const Eigen::Vector3f& vertex);

/// @returns the number that the whole word is, or nothing. A number that is too small for a float becomes 0, and one
///   that is too large becomes infinite. "nan" and "inf" are numbers, too.
std::optional<float> parsed_float(std::string_view word);

/// Appends the number to the text, after a space: in the shortest form without an exponent that gives the same float.
void append_plain(std::string& text, float number);

}  // namespace skein::sim
