// The source tree as the rules see it: text files by their path below the root, C++ without comments and literals.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skein::layers {

struct Include {
  std::size_t line = 0;  ///< from 1
  std::string path;      ///< as written, but relative to the root if it was written relative to the file
};

struct SourceFile {
  std::string path;                   ///< below the root: "core/types.hpp"
  std::vector<std::string> lines;     ///< as they are
  std::vector<std::string> code;      ///< C++ only: the lines with blanks for comments, characters and strings
  std::vector<std::string> comments;  ///< C++ only: blanks for all but comments
  std::vector<Include> includes;      ///< C++ only

  bool is_header() const;
  bool is_cpp() const { return !code.empty(); }
  bool is_python() const { return path.ends_with(".py"); }
  bool is_javascript() const { return path.ends_with(".js") || path.ends_with(".mjs"); }
  /// "core" of "core/types.hpp"; empty for a file at the root.
  std::string folder() const;
  /// "types.hpp" of "core/types.hpp".
  std::string name() const;
  bool is_main() const { return name() == "main.cpp"; }
  /// A file under tests/, or a unit test beside the code.
  bool is_test() const;
};

/// All text files below `root`, sorted by path. Left out: folders that begin with '.' (except .ci), with "build" or
/// with "runs", and files that hold a zero byte.
std::vector<SourceFile> read_source_tree(const std::filesystem::path& root);

/// C++ text with blanks in place of comments, characters and strings (raw ones too); line breaks stay.
std::string blank_comments_and_literals(const std::string& text);

/// C++ text with blanks in place of everything but comments; line breaks stay.
std::string only_comments(const std::string& text);

}  // namespace skein::layers
