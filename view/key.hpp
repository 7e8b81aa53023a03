// The key of a run's page: users who have it may watch the run and give orders. Each run gets a new random key.
// Programs pass it on in a file that only its owner may read, never on a command line or in the environment.   Any
// thread.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace skein::view {

class Key {
 public:
  /// A new key of 256 random bits. @throws std::runtime_error when the system provides none.
  static Key draw();
  /// Reads a key from a file (process/files/private_file.hpp writes it). @throws InputError when the file has no key,
  /// or when other users may access it.
  static Key read_from(const std::filesystem::path& file);

  const std::string& text() const { return text_; }
  /// Whether this key was given. For texts of a key's length, the comparison takes constant time.
  bool opens(std::string_view given) const;

 private:
  explicit Key(std::string text) : text_(std::move(text)) {}

  std::string text_;  ///< 64 hexadecimal digits
};

}  // namespace skein::view
