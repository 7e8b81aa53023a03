// A PCD reader without PCL: pcl_io would bring VTK and 250 MB of packages to every program that links it. A test
// compares the two (docs/decisions/0015-point-files-and-packages.md).
#include "scenes/files/point_file.hpp"

#include <lzf.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include "core/files/file_bytes.hpp"
#include "scenes/files/limits.hpp"
#include "scenes/files/pcd_header.hpp"
#include "scenes/files/words.hpp"

namespace skein::sim {
namespace {

constexpr std::array<const char*, 6> kNumbers = {"x", "y", "z", "normal_x", "normal_y", "normal_z"};
/// Greatest compression ratio of LZF: a reference of three bytes stands for up to 264 bytes.
constexpr std::size_t kLzfBestRatio = 88;

using Numbers = std::array<float, kNumbers.size()>;  ///< of one point, in the order of kNumbers

/// Position of one of the numbers in the data of a point.
struct Place {
  std::size_t element = 0;  ///< index in an ASCII line
  std::size_t byte = 0;     ///< offset in binary data
  std::size_t size = 0;     ///< bytes: 4 (float) or 8 (double)
};
using Places = std::array<Place, kNumbers.size()>;

void check_fields(const std::filesystem::path& file, const PcdHeader& header) {
  for (const std::string name : kNumbers) {
    const auto field = std::find_if(header.fields.begin(), header.fields.end(),
                                    [&](const PcdField& candidate) { return candidate.name == name; });
    if (field == header.fields.end()) {
      refuse(file, "has no field '" + name + "'; interest points need x, y, z and normal_x, normal_y, normal_z");
    }
    if (field->count != 1 || field->type != 'F') {
      refuse(file, "the field '" + name + "' must be one float (TYPE F, COUNT 1)");
    }
  }
}

void check_binary(const std::filesystem::path& file, const PcdHeader& header, std::string_view data) {
  const std::size_t needed = header.points * header.bytes_per_point();
  if (data.size() < needed) {
    refuse(file, "truncated: " + std::to_string(needed) + " bytes of data are needed, " + std::to_string(data.size()) +
                     " are there");
  }
}

/// @param header  its padding fields are removed if the data contain no padding.
void check_packed(const std::filesystem::path& file, PcdHeader& header, std::string_view data) {
  std::array<std::uint32_t, 2> sizes{};  // packed, unpacked
  if (data.size() < sizeof sizes) refuse(file, "truncated: the sizes of the compressed data are missing");
  std::memcpy(sizes.data(), data.data(), sizeof sizes);
  if (data.size() - sizeof sizes < sizes[0]) {
    refuse(file, "truncated: " + std::to_string(sizes[0]) + " bytes of compressed data are needed, " +
                     std::to_string(data.size() - sizeof sizes) + " are there");
  }
  // PCL's writer lists padding in the header but leaves it out of the data; other writers may include it.
  const std::size_t with_padding = header.points * header.bytes_per_point();
  if (sizes[1] != with_padding) std::erase_if(header.fields, [](const PcdField& field) { return field.name == "_"; });
  if (sizes[1] != header.points * header.bytes_per_point()) {
    refuse(file, "malformed: the compressed data unpack to " + std::to_string(sizes[1]) +
                     " bytes, where the header needs " + std::to_string(with_padding));
  }
  if (sizes[1] > kLzfBestRatio * sizes[0]) refuse(file, "malformed: the data do not unpack");
}

/// @param header  checked by check_fields().
Places places_of(const PcdHeader& header) {
  Places places;
  std::size_t element = 0, byte = 0;
  for (const PcdField& field : header.fields) {
    const auto number = std::find(kNumbers.begin(), kNumbers.end(), field.name);
    if (number != kNumbers.end()) places[number - kNumbers.begin()] = {element, byte, field.size};
    element += field.count;
    byte += field.bytes();
  }
  return places;
}

/// Reads ASCII data: one line per point, with numbers only; lines may be blank. Numbers are parsed as double and then
/// rounded to float, as in PCL.
class AsciiPoints {
 public:
  AsciiPoints(const std::filesystem::path& file, const PcdHeader& header)
      : file_(file), expected_(header.points), wanted_(header.elements_per_point()), line_(header.data_line) {
    const Places places = places_of(header);
    for (std::size_t k = 0; k < places.size(); ++k) wanted_[places[k].element] = k;
  }

  std::vector<Numbers> read(std::string_view data) {
    std::vector<Numbers> points;
    Numbers numbers{};
    while (!data.empty()) {
      const std::size_t end = std::min(data.find('\n'), data.size());
      if (read_line(data.substr(0, end), numbers)) points.push_back(numbers);
      data.remove_prefix(std::min(end + 1, data.size()));
      ++line_;
    }
    if (points.size() != expected_) {
      refuse(file_, std::string(points.size() < expected_ ? "truncated" : "too long") + ": POINTS says " +
                        std::to_string(expected_) + ", but there are " + std::to_string(points.size()));
    }
    return points;
  }

 private:
  /// @returns whether the line has a point (false: it is blank).
  bool read_line(std::string_view line, Numbers& numbers) const {
    std::size_t words = 0;
    for_each_word(line, " \t\r", [&](std::string_view word) {
      const double value = read_number(word);
      if (words < wanted_.size() && wanted_[words]) numbers[*wanted_[words]] = static_cast<float>(value);
      ++words;
    });
    if (words != 0 && words != wanted_.size()) {
      wrong("must have " + std::to_string(wanted_.size()) + " numbers, not " + std::to_string(words));
    }
    return words != 0;
  }

  double read_number(std::string_view word) const {
    const std::string_view digits = word.starts_with('+') && !word.starts_with("+-") ? word.substr(1) : word;
    const char* const end = digits.data() + digits.size();
    double value = 0.0;
    const auto result = std::from_chars(digits.data(), end, value);
    if (result.ec != std::errc() || result.ptr != end) {
      wrong("'" + shown(word) + "' is not a number");
    }
    return value;
  }

  [[noreturn]] void wrong(const std::string& why) const {
    throw InputError(file_.string() + ":" + std::to_string(line_) + ": " + why);
  }

  const std::filesystem::path& file_;
  const std::size_t expected_;                      // number of points
  std::vector<std::optional<std::size_t>> wanted_;  // by element of a line: its index in kNumbers
  int line_;
};

/// @param data  checked by check_packed().
std::string unpack(const std::filesystem::path& file, std::string_view data) {
  std::array<std::uint32_t, 2> sizes{};
  std::memcpy(sizes.data(), data.data(), sizeof sizes);
  std::string plain(sizes[1], '\0');
  if (lzf_decompress(data.data() + sizeof sizes, sizes[0], plain.data(), sizes[1]) != sizes[1]) {
    refuse(file, "malformed: the data do not unpack");
  }
  return plain;
}

float number_at(const char* bytes, std::size_t size) {
  double wide = 0.0;
  float narrow = 0.0F;
  if (size == sizeof narrow) {
    std::memcpy(&narrow, bytes, sizeof narrow);
    return narrow;
  }
  std::memcpy(&wide, bytes, sizeof wide);
  return static_cast<float>(wide);
}

/// @param data  with the size that the header demands.   @param by_field  true: the data are ordered by field and then
///   by point (binary_compressed); false: by point and then by field.
std::vector<Numbers> read_binary(const PcdHeader& header, std::string_view data, bool by_field) {
  const Places places = places_of(header);
  std::vector<Numbers> points(header.points);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto [element, byte, size] = places[k];
    const char* from = data.data() + (by_field ? byte * header.points : byte);
    const std::size_t step = by_field ? size : header.bytes_per_point();
    for (std::size_t i = 0; i < header.points; ++i) points[i][k] = number_at(from + i * step, size);
  }
  return points;
}

/// @param data  the part of the file after the header.
std::vector<Numbers> read_data(const std::filesystem::path& file, PcdHeader header, std::string_view data) {
  check_fields(file, header);
  if (header.data == "ascii") return AsciiPoints(file, header).read(data);
  if (header.data == "binary") {
    check_binary(file, header, data);
    return read_binary(header, data, false);
  }
  check_packed(file, header, data);
  return read_binary(header, unpack(file, data), true);
}

InterestPoint to_point(const std::filesystem::path& file, std::size_t index, const Numbers& numbers) {
  const Eigen::Map<const Eigen::Matrix<float, 6, 1>> all(numbers.data());
  const std::string name = "point " + std::to_string(index);
  if (!all.allFinite()) refuse(file, name + " has a number that is not finite");
  InterestPoint point{all.head<3>(), all.tail<3>()};
  if (point.p_W.cwiseAbs().maxCoeff() > kFarthest) {
    refuse(file, name + " is farther than 100 km from the origin; are these metres?");
  }
  const float length = point.n_W.norm();
  if (!(length > 1e-6F) || !std::isfinite(length)) {
    refuse(file, name + " has a normal of no direction; its length must be about 1");
  }
  if (std::abs(length - 1.0F) > 1e-5F) point.n_W /= length;
  return point;
}

}  // namespace

std::vector<InterestPoint> read_points(const std::filesystem::path& file) {
  const std::string bytes = read_file_bytes(file, kMostBytes);
  const PcdHeader header = parse_pcd_header(file, bytes);
  const std::vector<Numbers> numbers = read_data(file, header, std::string_view(bytes).substr(header.data_offset));
  std::vector<InterestPoint> points;
  points.reserve(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) points.push_back(to_point(file, i, numbers[i]));
  return points;
}

std::string to_pcd(const std::vector<InterestPoint>& points) {
  const std::string count = std::to_string(points.size());
  std::string bytes =
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
      "FIELDS normal_x normal_y normal_z x y z _\nSIZE 4 4 4 4 4 4 1\nTYPE F F F F F F U\n"
      "COUNT 1 1 1 1 1 1 4\nWIDTH " +
      count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
  for (const InterestPoint& point : points) {
    for (const Eigen::Vector3f* vector : {&point.n_W, &point.p_W}) {
      bytes.append(reinterpret_cast<const char*>(vector->data()), 3 * sizeof(float));
    }
    bytes.append(4, '\0');
  }
  return bytes;
}

}  // namespace skein::sim
