// The rules for names of files in comments and documents, and of tests in documents.
#include <algorithm>
#include <map>
#include <regex>
#include <set>

#include "tests/layers/rules.hpp"

namespace skein::layers {
namespace {

/// All paths of the tree, and their endings after each slash.
class Paths {
 public:
  explicit Paths(const Tree& tree) {
    for (const SourceFile& file : tree) {
      folders_.insert(file.folder());
      add(file.path);
      add(file.path.substr(0, file.path.rfind('.')) + ".*");
    }
  }
  bool has(const std::string& tail) const { return tails_.contains(tail); }
  /// Whether the root has a folder of this name.
  bool has_folder(const std::string& name) const { return folders_.contains(name); }

 private:
  void add(const std::string& path) {
    tails_.insert(path);
    for (std::size_t at = 0; (at = path.find('/', at)) != std::string::npos;) tails_.insert(path.substr(++at));
  }

  std::set<std::string> tails_, folders_;
};

std::string name_of(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// The file names of a page's code blocks: "```cmake CMakeLists.txt".
std::set<std::string> files_to_write(const SourceFile& page) {
  static const std::regex kBlock(R"(^```\w+ (\S+)$)");
  std::set<std::string> names;
  std::smatch block;
  for (const std::string& line : page.lines) {
    if (std::regex_match(line, block, kBlock)) names.insert(name_of(block[1]));
  }
  return names;
}

bool is_page(const SourceFile& file) {
  return file.path == "README.md" || file.path == "CONTRIBUTING.md" ||
         (file.folder() == "docs" && file.path.ends_with(".md"));
}

/// Whether a path refers to this tree at all, and not to a user's or a run's files, whose folders have other names. A
/// name without a folder on a page may be that of a reader's planner, but readers need no headers of their own.
bool is_ours(const std::string& path, const Paths& paths, bool in_comment) {
  static const std::regex kCpp(R"(.*\.[ch]pp)"), kHeader(R"(.*\.hpp)");
  const std::size_t slash = path.find('/');
  if (slash == std::string::npos) return std::regex_match(path, in_comment ? kCpp : kHeader);
  return paths.has_folder(path.substr(0, slash)) || std::regex_match(path, kCpp);
}

/// The names of all tests of C++, by suite.
std::map<std::string, std::set<std::string>> tests_by_suite(const Tree& tree) {
  static const std::regex kTest(R"(\b(?:TYPED_)?TEST(?:_[FP])?\(\s*(\w+),\s*(\w+)\s*\))");
  std::map<std::string, std::set<std::string>> tests;
  for (const SourceFile& file : tree) {
    for (std::size_t i = 0; i < file.code.size(); ++i) {
      if (file.code[i].find("TEST") == std::string::npos) continue;
      // A line break may stand before the name.
      const bool breaks = file.code[i].ends_with(',') && i + 1 < file.code.size();
      const std::string text = breaks ? file.code[i] + file.code[i + 1] : file.code[i];
      std::smatch test;
      if (std::regex_search(text, test, kTest)) tests[test[1]].insert(test[2]);
    }
  }
  return tests;
}

}  // namespace

Violations check_references(const Tree& tree) {
  static const std::regex kPath(R"((^|[^\w/.$<*-])((?:[A-Za-z_][\w-]*/)*\w[\w.-]*\.)"
                                R"((?:[ch]pp|[ch]|idl|md|ya?ml|json|cmake|py|sh|txt|\*))(?![\w/*]))");
  const Paths paths(tree);
  Violations violations;
  for (const SourceFile& file : tree) {
    if (!file.is_cpp() && !is_page(file)) continue;
    const std::set<std::string> to_write = files_to_write(file);
    const std::vector<std::string>& lines = file.is_cpp() ? file.comments : file.lines;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (auto match = std::sregex_iterator(lines[i].begin(), lines[i].end(), kPath); match != std::sregex_iterator();
           ++match) {
        const std::string path = (*match)[2];
        if (!is_ours(path, paths, file.is_cpp()) || paths.has(path) || to_write.contains(name_of(path))) continue;
        violations.push_back(file.path + ":" + std::to_string(i + 1) + ": there is no " + path);
      }
    }
  }
  return violations;
}

Violations check_named_tests(const Tree& tree) {
  static const std::regex kName(R"(`([A-Z]\w*)\.([A-Z]\w*)(\.\.\.)?`(?! \((?:gone\)|now )))");
  const auto tests = tests_by_suite(tree);
  Violations violations;
  for (const SourceFile& file : tree) {
    if (!is_page(file)) continue;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      const std::string& line = file.lines[i];
      for (auto match = std::sregex_iterator(line.begin(), line.end(), kName); match != std::sregex_iterator();
           ++match) {
        const auto suite = tests.find((*match)[1]);
        if (suite == tests.end()) continue;  // not a suite at all, or one that is gone
        const std::string name = (*match)[2];
        const auto first = suite->second.lower_bound(name);
        const bool is_shortened = (*match)[3].matched;
        const bool exists = first != suite->second.end() && (is_shortened ? first->starts_with(name) : *first == name);
        if (exists) continue;
        violations.push_back(file.path + ":" + std::to_string(i + 1) + ": there is no test " + match->str());
      }
    }
  }
  return violations;
}

}  // namespace skein::layers
