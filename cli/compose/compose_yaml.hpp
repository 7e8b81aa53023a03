// Writes the YAML of a file for docker-compose with the YAML library. docker-compose substitutes variables (`${X}`)
// when it reads the file. So Skein's own texts and users' texts are written by different functions: a user's text is
// read back exactly as it was given.   Pure; an object belongs to one thread.
#pragma once

#include <yaml-cpp/emitter.h>

#include <string>
#include <vector>

namespace skein::cli {

/// A text for one line of a comment. So that the text cannot end the line, bytes other than printable ASCII are written
/// as bash reads them within single quotes: 'a'$'\x0a''b'.
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

  /// The key of the next value. @param name  a word of Skein's own, or the name of a member
  ComposeYaml& key(const std::string& name);
  /// A text of Skein's own: docker-compose substitutes its variables.
  ComposeYaml& own(const std::string& text);
  ComposeYaml& flag(bool truth) { return put(truth); }
  ComposeYaml& number(int number) { return put(number); }
  ComposeYaml& own(const std::vector<std::string>& texts);
  /// A text that a user may have chosen: docker-compose reads exactly this. @throws InputError if YAML cannot hold it
  ComposeYaml& literal(const std::string& text);

  /// The whole file. @throws std::logic_error when a map or list was begun and not ended
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
