// PCL reads the data, but takes the header on trust, skips what is named "_" and reads 0 where it finds no number. So
// the form of a file is checked here, and PCL sees one with a plain header and nothing strange behind it.
#include "sim_server/scene_files/point_file.hpp"

#include <pcl/PCLPointCloud2.h>
#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string_view>

#include "core/file_bytes.hpp"
#include "sim_server/scene_files/limits.hpp"
#include "sim_server/scene_files/pcd_header.hpp"

namespace skein::sim {
namespace {

constexpr std::array<const char*, 6> kNumbers = {"x", "y", "z", "normal_x", "normal_y", "normal_z"};
/// The most that LZF can pack into one byte: a reference of three bytes stands for 264.
constexpr std::size_t kLzfBestRatio = 88;

using Numbers = std::array<float, kNumbers.size()>;  ///< of one point, in the order of kNumbers

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

/// @param header  loses its padding when the data have none.
void check_packed(const std::filesystem::path& file, PcdHeader& header, std::string_view data) {
  std::array<std::uint32_t, 2> sizes{};  // packed, unpacked
  if (data.size() < sizeof sizes) refuse(file, "truncated: the sizes of the compressed data are missing");
  std::memcpy(sizes.data(), data.data(), sizeof sizes);
  if (data.size() - sizeof sizes < sizes[0]) {
    refuse(file, "truncated: " + std::to_string(sizes[0]) + " bytes of compressed data are needed, " +
                     std::to_string(data.size() - sizeof sizes) + " are there");
  }
  // PCL's writer names padding in the header and leaves it out of the data; others may not.
  const std::size_t with_padding = header.points * header.bytes_per_point();
  if (sizes[1] != with_padding) std::erase_if(header.fields, [](const PcdField& field) { return field.name == "_"; });
  if (sizes[1] != header.points * header.bytes_per_point()) {
    refuse(file, "malformed: the compressed data unpack to " + std::to_string(sizes[1]) +
                     " bytes, where the header needs " + std::to_string(with_padding));
  }
  if (sizes[1] > kLzfBestRatio * sizes[0]) refuse(file, "malformed: the data do not unpack");
}

/// ASCII: one line a point, nothing but numbers.
class AsciiPoints {
 public:
  AsciiPoints(const std::filesystem::path& file, const PcdHeader& header)
      : file_(file), per_line_(header.elements_per_point()), line_(header.data_line) {}

  /// @returns the lines of the points without those between that are blank.
  std::string check(std::string_view data, std::size_t expected) {
    std::string text;
    std::size_t points = 0;
    while (!data.empty()) {
      const std::size_t end = std::min(data.find('\n'), data.size());
      if (check_line(data.substr(0, end))) {
        text.append(data.substr(0, end)) += '\n';
        ++points;
      }
      data.remove_prefix(std::min(end + 1, data.size()));
      ++line_;
    }
    if (points != expected) {
      refuse(file_, std::string(points < expected ? "truncated" : "too long") + ": POINTS says " +
                        std::to_string(expected) + ", but there are " + std::to_string(points));
    }
    return text;
  }

 private:
  /// @returns whether there is a point on it.
  bool check_line(std::string_view line) const {
    static constexpr std::string_view kSpace = " \t\r";  // PCL's idea of it
    std::size_t words = 0;
    for (std::size_t at = line.find_first_not_of(kSpace); at != std::string_view::npos;
         at = line.find_first_not_of(kSpace, at), ++words) {
      const std::size_t end = std::min(line.find_first_of(kSpace, at), line.size());
      check_number(line.substr(at, end - at));
      at = end;
    }
    if (words != 0 && words != per_line_) {
      wrong("must have " + std::to_string(per_line_) + " numbers, not " + std::to_string(words));
    }
    return words != 0;
  }

  void check_number(std::string_view word) const {
    const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
    const char* const end = digits.data() + digits.size();
    double value = 0.0;
    const auto result = std::from_chars(digits.data(), end, value);
    if (result.ec != std::errc() || result.ptr != end) {
      constexpr std::size_t kShown = 40;
      wrong("'" + std::string(word.substr(0, kShown)) + "' is not a number");
    }
  }

  [[noreturn]] void wrong(const std::string& why) const {
    throw InputError(file_.string() + ":" + std::to_string(line_) + ": " + why);
  }

  const std::filesystem::path& file_;
  const std::size_t per_line_;
  int line_;
};

/// PCL writes to the console; what it has to say stands in our own messages.
class QuietPcl {
 public:
  QuietPcl() : before_(pcl::console::getVerbosityLevel()) { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }
  ~QuietPcl() { pcl::console::setVerbosityLevel(before_); }
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;

 private:
  const pcl::console::VERBOSITY_LEVEL before_;
};

/// The header as PCL likes it best: nothing unknown, in the usual order. Fields that nobody asks for are named by their
/// number, padding too, which PCL would take out of packed data.
std::string plain_header(const PcdHeader& header) {
  std::ostringstream fields, sizes, types, counts;
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    const PcdField& field = header.fields[i];
    const bool needed = std::find(kNumbers.begin(), kNumbers.end(), field.name) != kNumbers.end();
    fields << ' ' << (needed ? field.name : "field" + std::to_string(i));
    sizes << ' ' << field.size;
    types << ' ' << field.type;
    counts << ' ' << field.count;
  }
  std::ostringstream text;
  text << "VERSION 0.7\nFIELDS" << fields.str() << "\nSIZE" << sizes.str() << "\nTYPE" << types.str() << "\nCOUNT"
       << counts.str() << "\nWIDTH " << header.points << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << header.points
       << "\nDATA " << header.data << '\n';
  return text.str();
}

/// @param data  what follows the header; its form was checked.
pcl::PCLPointCloud2 decode(const std::filesystem::path& file, const PcdHeader& header, std::string_view data) {
  const QuietPcl quiet;
  pcl::PCLPointCloud2 cloud;
  int failed = 0;
  try {
    std::istringstream head(plain_header(header));
    Eigen::Vector4f origin;
    Eigen::Quaternionf orientation;
    int version = 0, kind = 0;
    unsigned ignored = 0;
    pcl::PCDReader reader;
    failed = reader.readHeader(head, cloud, origin, orientation, version, kind, ignored);
    if (cloud.point_step != header.bytes_per_point()) failed = -1;
    if (failed == 0 && header.data == "ascii") {
      std::istringstream lines{std::string(data)};
      failed = reader.readBodyASCII(lines, cloud, version);
    } else if (failed == 0) {
      failed = reader.readBodyBinary(reinterpret_cast<const unsigned char*>(data.data()), cloud, version,
                                     header.data == "binary_compressed", 0);
    }
  } catch (const std::exception& error) {
    refuse(file, std::string("not a readable PCD file: ") + error.what());
  }
  const bool complete = failed == 0 && std::size_t{cloud.width} * cloud.height == header.points &&
                        cloud.data.size() == header.points * cloud.point_step;
  if (!complete) refuse(file, "malformed: the data do not unpack");
  return cloud;
}

/// @param data  what follows the header.
pcl::PCLPointCloud2 check_and_decode(const std::filesystem::path& file, PcdHeader header, std::string_view data) {
  check_fields(file, header);
  if (header.data == "ascii") return decode(file, header, AsciiPoints(file, header).check(data, header.points));
  if (header.data == "binary") {
    check_binary(file, header, data);
  } else {
    check_packed(file, header, data);
  }
  return decode(file, header, data);
}

/// One number of each point, whatever lies between.
class Column {
 public:
  /// @param name  of a float field that the cloud has.
  Column(const pcl::PCLPointCloud2& cloud, const std::string& name) : cloud_(cloud) {
    const auto field = std::find_if(cloud.fields.begin(), cloud.fields.end(),
                                    [&](const pcl::PCLPointField& candidate) { return candidate.name == name; });
    offset_ = field->offset;
    is_double_ = field->datatype == pcl::PCLPointField::FLOAT64;
  }

  float at(std::size_t point) const {
    const std::uint8_t* bytes = cloud_.data.data() + point * cloud_.point_step + offset_;
    double wide = 0.0;
    float narrow = 0.0F;
    if (is_double_) {
      std::memcpy(&wide, bytes, sizeof wide);
      return static_cast<float>(wide);
    }
    std::memcpy(&narrow, bytes, sizeof narrow);
    return narrow;
  }

 private:
  const pcl::PCLPointCloud2& cloud_;
  std::size_t offset_ = 0;
  bool is_double_ = false;
};

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
  const pcl::PCLPointCloud2 cloud = check_and_decode(file, header, std::string_view(bytes).substr(header.data_offset));
  std::vector<Column> columns;
  for (const char* name : kNumbers) columns.emplace_back(cloud, name);
  std::vector<InterestPoint> points;
  points.reserve(header.points);
  for (std::size_t i = 0; i < header.points; ++i) {
    Numbers numbers{};
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = columns[k].at(i);
    points.push_back(to_point(file, i, numbers));
  }
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
