// PCL reads the data, but takes the header on trust and crashes on some malformed ones (an unknown line is
// enough). So the header is read and checked here, and PCL sees a plain one with the same content.
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
#include <map>
#include <sstream>
#include <string>
#include <string_view>

#include "core/file_bytes.hpp"

namespace skein::sim {
namespace {

constexpr std::uintmax_t kMostBytes = 1u << 30;
constexpr std::array<std::string_view, 10> kKeys = {"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                                                    "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
constexpr std::size_t kMostFields = 64;
constexpr std::size_t kMostElements = 4096;   // of one field
constexpr std::size_t kLongestHeader = 8192;  // bytes

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw InputError(file.string() + ": " + why);
}

struct PcdField {
  std::string name;
  char type = 'F';        ///< F float, I signed, U unsigned
  std::size_t size = 4;   ///< bytes of one element
  std::size_t count = 1;  ///< elements
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::size_t points = 0;
  std::string data;             ///< "ascii", "binary" or "binary_compressed"
  std::size_t data_offset = 0;  ///< bytes from the start of the file

  std::size_t elements_per_point() const {
    std::size_t sum = 0;
    for (const PcdField& field : fields) sum += field.count;
    return sum;
  }
  std::size_t bytes_per_point() const {
    std::size_t sum = 0;
    for (const PcdField& field : fields) sum += field.count * field.size;
    return sum;
  }
};

/// Parses the lines "WORD value value ...".
class HeaderParser {
 public:
  HeaderParser(const std::filesystem::path& file, std::string_view bytes) : file_(file) { read_lines(bytes); }

  PcdHeader header() const {
    PcdHeader header;
    header.data_offset = data_offset_;
    header.data = word("DATA");
    if (header.data != "ascii" && header.data != "binary" && header.data != "binary_compressed") {
      refuse("DATA", "must be ascii, binary or binary_compressed, not '" + header.data + "'");
    }
    read_fields(header);
    const std::size_t width = number(word("WIDTH"), "WIDTH", kMostPoints);
    const std::size_t height = number(word("HEIGHT"), "HEIGHT", kMostPoints);
    header.points = number(word("POINTS"), "POINTS", kMostPoints);
    if (width * height != header.points) refuse("POINTS", "must be WIDTH times HEIGHT");
    if (header.points == 0) refuse("POINTS", "must be at least 1: a scene without points has no score");
    return header;
  }

 private:
  struct Line {
    int number = 0;
    std::vector<std::string> words;
  };

  [[noreturn]] void refuse(const std::string& key, const std::string& why) const {
    const auto line = lines_.find(key);
    const std::string place = line == lines_.end() ? "" : ":" + std::to_string(line->second.number);
    throw InputError(file_.string() + place + ": " + key + ": " + why);
  }

  void read_lines(std::string_view bytes) {
    int number = 0;
    std::size_t at = 0;
    while (!lines_.contains("DATA")) {
      const std::size_t end = bytes.substr(0, kLongestHeader).find('\n', at);
      if (end == std::string_view::npos) throw InputError(file_.string() + ": not a PCD file: no line DATA");
      std::istringstream line{std::string(bytes.substr(at, end - at))};
      at = end + 1;
      ++number;
      std::string key;
      line >> key;
      if (key.empty() || key[0] == '#') continue;
      if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
        throw InputError(file_.string() + ":" + std::to_string(number) +
                         ": not a PCD file: its header has no such line");
      }
      Line& entry = lines_[key];
      if (entry.number != 0) refuse(key, "is given twice");
      entry.number = number;
      for (std::string word; line >> word;) entry.words.push_back(word);
    }
    data_offset_ = at;
  }

  const std::vector<std::string>& words(const std::string& key) const {
    const auto line = lines_.find(key);
    if (line == lines_.end()) refuse(key, "this line of the PCD header is missing");
    return line->second.words;
  }

  const std::string& word(const std::string& key) const {
    if (words(key).size() != 1) refuse(key, "must have one value");
    return words(key)[0];
  }

  std::size_t number(const std::string& text, const std::string& key, std::size_t most) const {
    std::size_t value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc() || result.ptr != text.data() + text.size() || value > most) {
      refuse(key, "must be a whole number within [0, " + std::to_string(most) + "], not '" + text + "'");
    }
    return value;
  }

  void read_fields(PcdHeader& header) const {
    const auto& names = words("FIELDS");
    const auto& sizes = words("SIZE");
    const auto& types = words("TYPE");
    const std::vector<std::string> counts =
        lines_.contains("COUNT") ? words("COUNT") : std::vector<std::string>(names.size(), "1");
    if (names.empty() || names.size() > kMostFields) refuse("FIELDS", "must name 1 to 64 fields");
    if (sizes.size() != names.size()) refuse("SIZE", "must have one value for each of FIELDS");
    if (types.size() != names.size()) refuse("TYPE", "must have one value for each of FIELDS");
    if (counts.size() != names.size()) refuse("COUNT", "must have one value for each of FIELDS");
    for (std::size_t i = 0; i < names.size(); ++i) {
      PcdField field{names[i], types[i][0], number(sizes[i], "SIZE", 8), number(counts[i], "COUNT", kMostElements)};
      if (!std::all_of(names[i].begin(), names[i].end(), [](unsigned char c) { return c > ' ' && c < 0x7f; })) {
        refuse("FIELDS", "field " + std::to_string(i) + " has a name with strange characters");
      }
      if (types[i] != "F" && types[i] != "I" && types[i] != "U") refuse("TYPE", "must be F, I or U");
      const bool whole = field.size == 1 || field.size == 2;
      if (!(field.size == 4 || field.size == 8 || (whole && field.type != 'F'))) {
        refuse("SIZE", "field '" + field.name + "' cannot have " + std::to_string(field.size) + " bytes");
      }
      if (field.count == 0) refuse("COUNT", "must be at least 1");
      header.fields.push_back(std::move(field));
    }
  }

  const std::filesystem::path& file_;
  std::map<std::string, Line> lines_;
  std::size_t data_offset_ = 0;
};

/// ASCII data: as many numbers as announced, and nothing that PCL would read as 0 or skip.
void check_ascii(const std::filesystem::path& file, const PcdHeader& header, std::string_view data, int line) {
  const std::size_t per_line = header.elements_per_point();
  std::size_t points = 0;
  while (!data.empty()) {
    const std::size_t end = std::min(data.find('\n'), data.size());
    std::istringstream words{std::string(data.substr(0, end))};
    data.remove_prefix(std::min(end + 1, data.size()));
    std::size_t count = 0;
    for (std::string word; words >> word; ++count) {
      double value = 0.0;
      const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
      if (result.ec != std::errc() || result.ptr != word.data() + word.size()) {
        throw InputError(file.string() + ":" + std::to_string(line) + ": '" + word + "' is not a number");
      }
    }
    if (count != 0 && count != per_line) {
      throw InputError(file.string() + ":" + std::to_string(line) + ": must have " + std::to_string(per_line) +
                       " numbers, not " + std::to_string(count));
    }
    points += count != 0;
    ++line;
  }
  if (points != header.points) {
    throw InputError(file.string() + ": " + (points < header.points ? "truncated" : "too long") + ": POINTS says " +
                     std::to_string(header.points) + ", but there are " + std::to_string(points));
  }
}

void check_length(const std::filesystem::path& file, const PcdHeader& header, std::string_view bytes) {
  const std::string_view data = bytes.substr(header.data_offset);
  const std::size_t needed = header.points * header.bytes_per_point();
  if (header.data == "ascii") {
    const std::string_view head = bytes.substr(0, header.data_offset);
    return check_ascii(file, header, data, static_cast<int>(std::count(head.begin(), head.end(), '\n')) + 1);
  }
  std::size_t expected = needed;
  if (header.data == "binary_compressed") {
    std::uint32_t sizes[2] = {0, 0};  // compressed, uncompressed
    if (data.size() >= sizeof sizes) std::memcpy(sizes, data.data(), sizeof sizes);
    if (data.size() >= sizeof sizes && sizes[1] != needed) {
      throw InputError(file.string() + ": malformed: the compressed data unpack to " + std::to_string(sizes[1]) +
                       " bytes, where the header needs " + std::to_string(needed));
    }
    expected = sizeof sizes + sizes[0];
  }
  if (data.size() < expected) {
    throw InputError(file.string() + ": truncated: " + std::to_string(expected) + " bytes of data are needed, " +
                     std::to_string(data.size()) + " are there");
  }
}

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

/// One float field of each point, whatever lies between.
class Column {
 public:
  Column(const std::filesystem::path& file, const pcl::PCLPointCloud2& cloud, const std::string& name) : cloud_(cloud) {
    const auto field = std::find_if(cloud.fields.begin(), cloud.fields.end(),
                                    [&](const pcl::PCLPointField& candidate) { return candidate.name == name; });
    if (field == cloud.fields.end()) {
      refuse(file, "has no field '" + name + "'; x, y, z and normal_x, _y, _z are needed");
    }
    if (field->count != 1 ||
        (field->datatype != pcl::PCLPointField::FLOAT32 && field->datatype != pcl::PCLPointField::FLOAT64)) {
      refuse(file, "the field '" + name + "' must be one float (TYPE F, COUNT 1)");
    }
    offset_ = field->offset;
    is_double_ = field->datatype == pcl::PCLPointField::FLOAT64;
  }

  float at(std::size_t point) const {
    const std::uint8_t* bytes = cloud_.data.data() + point * cloud_.point_step + offset_;
    if (is_double_) {
      double value = 0.0;
      std::memcpy(&value, bytes, sizeof value);
      return static_cast<float>(value);
    }
    float value = 0.0F;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }

 private:
  const pcl::PCLPointCloud2& cloud_;
  std::size_t offset_ = 0;
  bool is_double_ = false;
};

PcdHeader read_pcd_header(const std::filesystem::path& file, std::string_view bytes) {
  const PcdHeader header = HeaderParser(file, bytes).header();
  check_length(file, header, bytes);
  return header;
}

/// The header as PCL likes it best: nothing unknown, in the usual order.
std::string plain_header(const PcdHeader& header) {
  std::ostringstream fields, sizes, types, counts;
  for (const PcdField& field : header.fields) {
    fields << ' ' << field.name;
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

/// @param bytes the whole file, whose header was checked.
pcl::PCLPointCloud2 read_cloud(const std::filesystem::path& file, const PcdHeader& header, std::string_view bytes) {
  const QuietPcl quiet;
  const std::string text = plain_header(header).append(bytes.substr(header.data_offset));
  std::istringstream stream(text);
  pcl::PCLPointCloud2 cloud;
  Eigen::Vector4f origin;
  Eigen::Quaternionf orientation;
  int version = 0, kind = 0, failed = 0;
  unsigned body = 0;
  pcl::PCDReader reader;
  try {
    failed = reader.readHeader(stream, cloud, origin, orientation, version, kind, body);
    if (failed == 0) {
      cloud.data.resize(std::size_t{cloud.point_step} * header.points);
      stream.clear();
      stream.seekg(body);
      failed = header.data == "ascii" ? reader.readBodyASCII(stream, cloud, version)
                                      : reader.readBodyBinary(reinterpret_cast<const unsigned char*>(text.data()),
                                                              cloud, version, header.data == "binary_compressed", body);
    }
  } catch (const std::exception& error) {
    refuse(file, std::string("not a readable PCD file: ") + error.what());
  }
  const bool complete = failed == 0 && std::size_t{cloud.width} * cloud.height == header.points &&
                        cloud.data.size() >= header.points * cloud.point_step &&
                        cloud.point_step >= header.bytes_per_point();
  if (!complete) refuse(file, "malformed: PCL cannot unpack its data");
  return cloud;
}

}  // namespace

std::vector<InterestPoint> read_points(const std::filesystem::path& file) {
  const std::string bytes = read_file_bytes(file, kMostBytes);
  const PcdHeader header = read_pcd_header(file, bytes);
  const pcl::PCLPointCloud2 cloud = read_cloud(file, header, bytes);
  const Column x(file, cloud, "x"), y(file, cloud, "y"), z(file, cloud, "z");
  const Column nx(file, cloud, "normal_x"), ny(file, cloud, "normal_y"), nz(file, cloud, "normal_z");
  std::vector<InterestPoint> points;
  points.reserve(header.points);
  for (std::size_t i = 0; i < header.points; ++i) {
    InterestPoint point{{x.at(i), y.at(i), z.at(i)}, {nx.at(i), ny.at(i), nz.at(i)}};
    if (!point.p_W.allFinite() || !point.n_W.allFinite()) {
      refuse(file, "point " + std::to_string(i) + " has a number that is not finite");
    }
    const float length = point.n_W.norm();
    if (!(length > 1e-6F) || !std::isfinite(length)) {
      refuse(file, "point " + std::to_string(i) + " has a normal of no direction");
    }
    // A unit normal stays as it is, bit for bit.
    if (std::abs(length - 1.0F) > 1e-5F) point.n_W /= length;
    points.push_back(point);
  }
  return points;
}

}  // namespace skein::sim
