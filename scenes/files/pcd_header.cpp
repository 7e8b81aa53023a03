#include "scenes/files/pcd_header.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <sstream>

#include "core/text/whole_number.hpp"
#include "core/types.hpp"
#include "scenes/files/limits.hpp"
#include "scenes/files/words.hpp"

namespace skein::sim {
namespace {

constexpr std::array<std::string_view, 10> kKeys = {"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                                                    "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
constexpr std::size_t kMostFields = 64;
constexpr std::size_t kMostElements = 4096;   // of one field
constexpr std::size_t kLongestHeader = 8192;  // bytes

/// Reads the lines "WORD value value ...".
class HeaderParser {
 public:
  HeaderParser(const std::filesystem::path& file, std::string_view bytes) : file_(file) { read_lines(bytes); }

  PcdHeader header() const {
    PcdHeader header;
    header.data_offset = data_offset_;
    header.data_line = lines_.at("DATA").number + 1;
    header.data = word("DATA");
    if (header.data != "ascii" && header.data != "binary" && header.data != "binary_compressed") {
      refuse("DATA", "must be ascii, binary or binary_compressed, not '" + shown(header.data) + "'");
    }
    read_fields(header);
    const std::size_t width = number(word("WIDTH"), "WIDTH", kMostPoints);
    const std::size_t height = number(word("HEIGHT"), "HEIGHT", kMostPoints);
    header.points = number(word("POINTS"), "POINTS", kMostPoints);
    if (width * height != header.points) {
      refuse("POINTS", "must be WIDTH times HEIGHT, " + std::to_string(width * height));
    }
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
    const auto value = parse_whole<std::size_t>(text);
    if (!value || *value > most) {
      refuse(key, "must be a whole number within [0, " + std::to_string(most) + "], not '" + shown(text) + "'");
    }
    return *value;
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
        refuse("SIZE", "field '" + shown(field.name) + "' cannot have " + std::to_string(field.size) + " bytes");
      }
      if (field.count == 0) refuse("COUNT", "must be at least 1");
      if (field.name != "_" && std::count(names.begin(), names.end(), field.name) > 1) {
        refuse("FIELDS", "'" + shown(field.name) + "' is named twice");
      }
      header.fields.push_back(std::move(field));
    }
  }

  const std::filesystem::path& file_;
  std::map<std::string, Line> lines_;
  std::size_t data_offset_ = 0;
};

}  // namespace

std::size_t PcdHeader::elements_per_point() const {
  std::size_t sum = 0;
  for (const PcdField& field : fields) sum += field.count;
  return sum;
}

std::size_t PcdHeader::bytes_per_point() const {
  std::size_t sum = 0;
  for (const PcdField& field : fields) sum += field.bytes();
  return sum;
}

PcdHeader parse_pcd_header(const std::filesystem::path& file, std::string_view bytes) {
  return HeaderParser(file, bytes).header();
}

}  // namespace skein::sim
