// Checks an OBJ file and copies its vertices and faces (plain_model.hpp).
#include <algorithm>
#include <charconv>
#include <string_view>
#include <vector>

#include "scenes/files/limits.hpp"
#include "scenes/files/mesh_checks.hpp"
#include "scenes/files/plain_model.hpp"
#include "scenes/files/words.hpp"

namespace skein::sim {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

/// Copies vertices and faces of an OBJ file, line by line.
class PlainObj {
 public:
  PlainObj(const std::filesystem::path& file, std::string_view text)
      : file_(file), text_(text.starts_with(kByteOrderMark) ? text.substr(kByteOrderMark.size()) : text) {}

  std::string plain() {
    while (at_ < text_.size()) {
      read_line();
      if (words_.empty()) continue;
      if (words_[0] == "v") copy_vertex();
      if (words_[0] == "f") copy_face();
    }
    if (triangles_ == 0) check_count(file_, 0);
    return std::move(plain_);
  }

 private:
  /// Splits the next line into words. A backslash at the end of a line continues it in the next line.
  void read_line() {
    words_.clear();
    for (bool goes_on = true; goes_on && at_ < text_.size();) {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      std::string_view line = text_.substr(at_, end - at_);
      at_ = end + 1;
      ++line_;
      if (line.ends_with('\r')) line.remove_suffix(1);
      goes_on = line.ends_with('\\');
      if (goes_on) line.remove_suffix(1);
      for_each_word(line.substr(0, line.find('#')), " \t\r\v\f", [this](auto word) { words_.push_back(word); });
    }
  }

  /// Copies x, y and z; some programs add a weight or a colour behind them.
  void copy_vertex() {
    if (words_.size() < 4) wrong("a vertex needs three numbers");
    if (words_.size() == 5 && parsed_float(words_[4]) != 1.0F) wrong("a vertex with a weight other than 1");
    plain_ += 'v';
    for (std::size_t i = 1; i < 4; ++i) {
      const std::optional<float> number = parsed_float(words_[i]);
      if (!number) wrong("a number is needed, not '" + shown(words_[i]) + "'");
      if (!(std::abs(*number) <= kFarthest)) {
        wrong("a vertex that is not finite, or farther than 100 km from the origin; are these metres?");
      }
      append_plain(plain_, *number);
    }
    plain_ += '\n';
    ++vertices_;
  }

  void copy_face() {
    const std::size_t corners = words_.size() - 1;
    if (corners < 3) wrong("a face needs at least three vertices");
    if (corners > kMostCorners) wrong("a face has more than " + std::to_string(kMostCorners) + " vertices");
    triangles_ += corners - 2;
    if (triangles_ > kMostTriangles) refuse_count(file_, "more");
    plain_ += 'f';
    for (std::size_t i = 1; i <= corners; ++i) plain_ += ' ' + std::to_string(vertex(words_[i]));
    plain_ += '\n';
  }

  /// The number of the vertex at a corner of a face, from 1. In the file, -1 stands for the last vertex before the
  /// face, -2 for the one before it, and so on. Slashes separate the number from those of texture coordinates and
  /// normals.
  std::int64_t vertex(std::string_view corner) const {
    const std::string_view word = corner.substr(0, corner.find('/'));
    std::int64_t index = 0;
    const auto result = std::from_chars(word.data(), word.data() + word.size(), index);
    if (result.ec != std::errc() || result.ptr != word.data() + word.size()) {
      wrong("the number of a vertex is needed, not '" + shown(corner) + "'");
    }
    if (index < 0) index += vertices_ + 1;
    if (index < 1 || index > vertices_)
      wrong("a face names a vertex that does not precede it: '" + shown(corner) + "'");
    return index;
  }

  [[noreturn]] void wrong(const std::string& what) const {
    throw InputError(file_.string() + ":" + std::to_string(line_) + ": not a readable OBJ: " + what);
  }

  const std::filesystem::path& file_;
  const std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 0;
  std::vector<std::string_view> words_;
  std::int64_t vertices_ = 0;
  std::size_t triangles_ = 0;
  std::string plain_;
};

}  // namespace

std::string plain_obj(const std::filesystem::path& file, const std::string& bytes) {
  return PlainObj(file, bytes).plain();
}

}  // namespace skein::sim
