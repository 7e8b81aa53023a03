// The YAML of a file for docker-compose, written by the YAML library. docker-compose fills in variables (`${X}`) when
// it reads the file, so what a user named is told from what is ours: a user's text is read back as it was given,
// whatever is in it.   Pure; an object belongs to one thread.
#pragma once

#include <yaml-cpp/emitter.h>

#include <string>
#include <vector>

namespace skein::cli {

/// A text on one line of a file's comment, that nothing can end before the line does: other characters than printable
/// ASCII are written as bash takes them within single quotes, 'a'$'\x0a''b'.
std::string in_comment(const std::string& text);

class ComposeYaml {
 public:
  ComposeYaml() { out_.SetIndent(2); }

  ComposeYaml& begin_map() { return put(YAML::BeginMap); }
  ComposeYaml& end_map() { return put(YAML::EndMap); }
  ComposeYaml& begin_list() { return put(YAML::BeginSeq); }
  ComposeYaml& end_list() { return put(YAML::EndSeq); }
  ComposeYaml& blank_line() { return put(YAML::Newline); }
  ComposeYaml& anchor(const char* name) { return put(YAML::Anchor(name)); }
  ComposeYaml& alias(const char* name) { return put(YAML::Alias(name)); }

  /// The key of what comes next. @param name  a word of ours, or the name of a member
  ComposeYaml& key(const std::string& name);
  /// What is ours: docker-compose fills in its variables.
  ComposeYaml& own(const std::string& text);
  ComposeYaml& flag(bool truth) { return put(truth); }
  ComposeYaml& number(int number) { return put(number); }
  ComposeYaml& own(const std::vector<std::string>& texts);
  /// What a user may have named: docker-compose reads exactly this. @throws InputError for what YAML cannot hold
  ComposeYaml& literal(const std::string& text);

  /// @throws std::logic_error when something was begun and not ended
  std::string text() const;

 private:
  template <typename T>
  ComposeYaml& put(const T& value) {
    out_ << value;
    return *this;
  }

  YAML::Emitter out_;
};

}  // namespace skein::cli
