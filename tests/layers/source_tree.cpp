#include "tests/layers/source_tree.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace skein::layers {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

bool is_cpp_file(const fs::path& file) {
  static const std::set<std::string> kExtensions = {".hpp", ".h", ".cpp", ".cc"};
  return kExtensions.contains(file.extension().string());
}

bool is_left_out(const std::string& folder) {
  return (folder.starts_with(".") && folder != ".ci") || folder.starts_with("build") || folder.starts_with("runs") ||
         folder == "node_modules";
}

std::vector<Include> read_includes(const fs::path& root, const SourceFile& file) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> includes;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    std::smatch match;
    // A directive in a comment is blank in `code`.
    if (file.code[i].find('#') == std::string::npos || !std::regex_search(file.lines[i], match, kInclude)) continue;
    std::string path = match[1];
    const fs::path beside = (fs::path(file.path).parent_path() / path).lexically_normal();
    if (!fs::exists(root / path) && fs::exists(root / beside)) path = beside.generic_string();
    includes.push_back({i + 1, path});
  }
  return includes;
}

/// Walks over C++ text and blanks everything but code; collects the comments.
class Blanker {
 public:
  explicit Blanker(const std::string& text) : text_(text), comments_(text) {
    std::ranges::replace_if(
        comments_, [](char c) { return c != '\n'; }, ' ');
    run();
  }

  const std::string& code() const { return text_; }
  const std::string& comments() const { return comments_; }

 private:
  void run() {
    while (at_ < text_.size()) {
      if (starts("//")) {
        take_comment("\n", 0);
      } else if (starts("/*")) {
        take_comment("*/", 2);
      } else if (starts("R\"") && !follows_word()) {
        blank_raw_string();
      } else if (text_[at_] == '"' || (text_[at_] == '\'' && !follows_word())) {
        blank_literal(text_[at_]);
      } else {
        ++at_;
      }
    }
  }

  bool starts(const char* what) const { return text_.compare(at_, std::char_traits<char>::length(what), what) == 0; }
  /// The ' in 1'000 opens no character, and FOUR"x" is not a raw string.
  bool follows_word() const {
    return at_ > 0 && (std::isalnum(static_cast<unsigned char>(text_[at_ - 1])) || text_[at_ - 1] == '_');
  }
  void blank_to(std::size_t end) {
    for (end = std::min(end, text_.size()); at_ < end; ++at_) {
      if (text_[at_] != '\n') text_[at_] = ' ';
    }
  }
  void take_comment(const std::string& mark, std::size_t more) {
    const std::size_t found = text_.find(mark, at_ + more);
    const std::size_t end = found == std::string::npos ? text_.size() : found + more;
    comments_.replace(at_, end - at_, text_, at_, end - at_);
    blank_to(end);
  }
  void blank_raw_string() {
    const std::size_t open = text_.find('(', at_);
    const std::string mark = ")" + text_.substr(at_ + 2, open - at_ - 2) + "\"";
    const std::size_t close = text_.find(mark, open);
    blank_to(close == std::string::npos ? text_.size() : close + mark.size());
  }
  void blank_literal(char quote) {
    std::size_t end = at_ + 1;
    while (end < text_.size() && text_[end] != quote && text_[end] != '\n') end += text_[end] == '\\' ? 2 : 1;
    blank_to(end + 1);
  }

  std::string text_, comments_;
  std::size_t at_ = 0;
};

}  // namespace

bool SourceFile::is_header() const { return is_cpp() && (path.ends_with(".hpp") || path.ends_with(".h")); }

std::string SourceFile::folder() const {
  const std::size_t slash = path.find('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

std::string SourceFile::name() const { return fs::path(path).filename().string(); }

bool SourceFile::is_test() const {
  return folder() == "tests" || fs::path(path).stem().string().ends_with("_test") ||
         fs::path(path).parent_path().filename() == "testing";
}

std::string blank_comments_and_literals(const std::string& text) { return Blanker(text).code(); }

std::string only_comments(const std::string& text) { return Blanker(text).comments(); }

std::vector<SourceFile> read_source_tree(const fs::path& root) {
  std::vector<SourceFile> files;
  for (auto it = fs::recursive_directory_iterator(root); it != fs::recursive_directory_iterator(); ++it) {
    if (it->is_directory() && is_left_out(it->path().filename().string())) it.disable_recursion_pending();
    if (!it->is_regular_file()) continue;
    std::ifstream in(it->path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    if (text.find('\0') != std::string::npos) continue;
    SourceFile file{it->path().lexically_relative(root).generic_string(), split_lines(text), {}, {}, {}};
    if (is_cpp_file(it->path())) {
      const Blanker parts(text);
      file.code = split_lines(parts.code());
      file.comments = split_lines(parts.comments());
      file.includes = read_includes(root, file);
    }
    files.push_back(std::move(file));
  }
  std::ranges::sort(files, {}, &SourceFile::path);
  return files;
}

}  // namespace skein::layers
