#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "scenes/files/limits.hpp"
#include "scenes/files/mesh_checks.hpp"
#include "scenes/files/plain_model.hpp"
#include "scenes/files/words.hpp"

namespace skein::sim {
namespace {

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat;
  std::optional<PlyType> count;  ///< of a list: the type of its length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyForm { kAscii, kLittleEndian, kBigEndian };

class PlainPly {
 public:
  PlainPly(const std::filesystem::path& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

  std::string plain() {
    read_header();
    for (const PlyElement& element : elements_) {
      if (element.properties.empty()) {
        if (element.name == "vertex" && element.count > 0) wrong("its vertices need the properties x, y and z");
        continue;
      }
      for (std::uint64_t i = 0; i < element.count; ++i) read(element);
    }
    if (triangles_ == 0) check_count(file_, 0);
    return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(vertices_) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(faces_) +
           "\nproperty list uint uint vertex_indices\nend_header\n" + vertex_bytes_ + face_bytes_;
  }

 private:
  void read_header() {
    if (next_line() != std::vector<std::string>{"ply"}) wrong("it does not begin with 'ply'");
    bool has_form = false;
    for (std::vector<std::string> words = next_line(); words != std::vector<std::string>{"end_header"};
         words = next_line()) {
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "format" && words.size() == 3) {
        has_form = true;
        if (words[1] == "binary_little_endian") {
          form_ = PlyForm::kLittleEndian;
        } else if (words[1] == "binary_big_endian") {
          form_ = PlyForm::kBigEndian;
        } else if (words[1] != "ascii") {
          wrong("unknown format '" + shown(words[1]) + "'");
        }
      } else if (words[0] == "element" && words.size() == 3) {
        add_element(words);
      } else if (words[0] == "property" && words.size() >= 3 && !elements_.empty()) {
        add_property(words);
      } else {
        wrong("unknown line in its header: '" + shown(words[0]) + "'");
      }
    }
    if (!has_form) wrong("its header has no line 'format'");
  }

  void add_element(const std::vector<std::string>& words) {
    PlyElement element{.name = words[1], .count = 0, .properties = {}};
    const char* const end = words[2].data() + words[2].size();
    const auto result = std::from_chars(words[2].data(), end, element.count);
    if (result.ec != std::errc() || result.ptr != end) wrong("'" + shown(words[2]) + "' is not a number of elements");
    if (element.count > bytes_.size()) wrong("truncated: its header promises more than the file can hold");
    if (element.name == "face") {
      faces_ = element.count;
      if (faces_ > kMostTriangles) refuse_count(file_, "more");
    }
    if (element.name == "vertex") vertices_ = element.count;
    for (const PlyElement& other : elements_) {
      if (other.name == element.name) wrong("two elements are named '" + shown(element.name) + "'");
    }
    elements_.push_back(std::move(element));
  }

  void add_property(const std::vector<std::string>& words) {
    PlyProperty property;
    property.name = words.back();
    if (words.size() == 5 && words[1] == "list") {
      property.count = type(words[2]);
      property.type = type(words[3]);
    } else if (words.size() == 3) {
      property.type = type(words[1]);
    } else {
      wrong("unknown property '" + shown(words.back()) + "'");
    }
    elements_.back().properties.push_back(property);
  }

  PlyType type(const std::string& word) const {
    constexpr std::array<std::array<const char*, 2>, 8> kNames = {{{"char", "int8"},
                                                                   {"uchar", "uint8"},
                                                                   {"short", "int16"},
                                                                   {"ushort", "uint16"},
                                                                   {"int", "int32"},
                                                                   {"uint", "uint32"},
                                                                   {"float", "float32"},
                                                                   {"double", "float64"}}};
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      if (word == kNames[i][0] || word == kNames[i][1]) return static_cast<PlyType>(i);
    }
    wrong("unknown type '" + shown(word) + "'");
  }

  void read(const PlyElement& element) {
    std::array<std::optional<double>, 3> p_W;
    bool has_corners = false;
    for (const PlyProperty& property : element.properties) {
      const bool corners = element.name == "face" && property.count &&
                           (property.name == "vertex_indices" || property.name == "vertex_index");
      if (corners && !has_corners) {
        has_corners = true;
        copy_face(property);
      } else if (property.count) {
        for (std::uint64_t left = list_length(*property.count); left > 0; --left) value(property.type);
      } else {
        const double read = value(property.type);
        const std::size_t axis = std::string_view("xyz").find(property.name);
        if (property.name.size() == 1 && axis < p_W.size()) p_W[axis] = read;
      }
    }
    if (element.name == "face" && !has_corners) wrong("its faces have no list 'vertex_indices'");
    if (element.name == "vertex") copy_vertex(p_W);
  }

  void copy_vertex(const std::array<std::optional<double>, 3>& p_W) {
    for (const std::optional<double>& coordinate : p_W) {
      if (!coordinate) wrong("its vertices need the properties x, y and z");
      const auto number = static_cast<float>(*coordinate);
      if (!(std::abs(number) <= kFarthest)) {
        wrong("a vertex is not finite, or farther than 100 km from the origin; are these metres?");
      }
      append(vertex_bytes_, std::bit_cast<std::uint32_t>(number));
    }
  }

  void copy_face(const PlyProperty& property) {
    const std::uint64_t corners = list_length(*property.count);
    if (corners < 3) wrong("a face needs at least three vertices");
    if (corners > kMostCorners) wrong("a face has more than " + std::to_string(kMostCorners) + " vertices");
    triangles_ += corners - 2;
    if (triangles_ > kMostTriangles) refuse_count(file_, "more");
    append(face_bytes_, static_cast<std::uint32_t>(corners));
    for (std::uint64_t i = 0; i < corners; ++i) {
      const double index = value(property.type);
      if (!(index >= 0.0 && index < static_cast<double>(vertices_)) || index != std::floor(index)) {
        wrong("a face needs a vertex that the file does not have");
      }
      append(face_bytes_, static_cast<std::uint32_t>(index));
    }
  }

  /// Reads the length of a list; throws if the file has fewer bytes left.
  std::uint64_t list_length(PlyType type) {
    const double length = value(type);
    if (!(length >= 0.0 && length <= static_cast<double>(bytes_.size() - at_)) || length != std::floor(length)) {
      wrong("a list is longer than the file, or its length is not a whole number");
    }
    return static_cast<std::uint64_t>(length);
  }

  /// The next number; a double can represent every value of each type.
  double value(PlyType type) {
    if (form_ == PlyForm::kAscii) return ascii_value();
    constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
    const std::size_t size = kSizes.at(static_cast<std::size_t>(type));
    if (bytes_.size() - at_ < size) wrong("truncated");
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t place = form_ == PlyForm::kLittleEndian ? i : size - 1 - i;
      bits |= std::uint64_t{static_cast<unsigned char>(bytes_[at_ + i])} << (8 * place);
    }
    at_ += size;
    switch (type) {
      case PlyType::kInt8:
        return static_cast<std::int8_t>(bits);
      case PlyType::kInt16:
        return static_cast<std::int16_t>(bits);
      case PlyType::kInt32:
        return static_cast<std::int32_t>(bits);
      case PlyType::kFloat:
        return double{std::bit_cast<float>(static_cast<std::uint32_t>(bits))};
      case PlyType::kDouble:
        return std::bit_cast<double>(bits);
      default:
        return static_cast<double>(bits);
    }
  }

  double ascii_value() {
    constexpr std::string_view kSpace = " \t\r\n\v\f";
    const std::size_t begin = std::min(bytes_.find_first_not_of(kSpace, at_), bytes_.size());
    if (begin == bytes_.size()) wrong("truncated");
    at_ = std::min(bytes_.find_first_of(kSpace, begin), bytes_.size());
    const std::string_view word = bytes_.substr(begin, at_ - begin);
    double number = 0.0;
    const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool tiny_or_huge = result.ec == std::errc::result_out_of_range;
    if ((result.ec != std::errc() && !tiny_or_huge) || result.ptr != digits.data() + digits.size()) {
      wrong("a number is needed, not '" + shown(word) + "'");
    }
    return tiny_or_huge ? double{parsed_float(word).value_or(0.0F)} : number;
  }

  /// The words of the next line of the header.
  std::vector<std::string> next_line() {
    const std::size_t end = bytes_.find('\n', at_);
    if (end == std::string_view::npos) wrong("truncated: its header has no end");
    std::vector<std::string> words;
    for_each_word(bytes_.substr(at_, end - at_), " \t\r", [&](std::string_view word) { words.emplace_back(word); });
    at_ = end + 1;
    return words;
  }

  static void append(std::string& bytes, std::uint32_t value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }

  [[noreturn]] void wrong(const std::string& what) const { refuse(file_, "not a readable PLY: " + what); }

  const std::filesystem::path& file_;
  const std::string_view bytes_;
  std::size_t at_ = 0;
  PlyForm form_ = PlyForm::kAscii;
  std::vector<PlyElement> elements_;
  std::uint64_t vertices_ = 0;
  std::uint64_t faces_ = 0;
  std::uint64_t triangles_ = 0;
  std::string vertex_bytes_;
  std::string face_bytes_;
};

}  // namespace

std::string plain_ply(const std::filesystem::path& file, const std::string& bytes) {
  return PlainPly(file, bytes).plain();
}

}  // namespace skein::sim
