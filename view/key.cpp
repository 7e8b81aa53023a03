#include "view/key.hpp"

#include <sys/random.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "core/files/file_bytes.hpp"
#include "core/text/sha256.hpp"
#include "core/types.hpp"

namespace skein::view {
namespace {

constexpr std::size_t kBytes = 32;

}  // namespace

Key Key::draw() {
  std::array<std::uint8_t, kBytes> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw std::runtime_error(std::string("no random numbers: ") + std::strerror(errno));
  }
  return Key(to_hex(bytes));
}

Key Key::read_from(const std::filesystem::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) == 0 && (status.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    throw InputError(file.string() + ": others may read this key; it must be a file of mode 0600");
  }
  std::string text = read_file_bytes(file, 1024);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  if (text.size() != 2 * kBytes || text.find_first_not_of("0123456789abcdef") != std::string::npos) {
    throw InputError(file.string() + ": is not a key of a page");
  }
  return Key(std::move(text));
}

bool Key::opens(std::string_view given) const {
  if (given.size() != text_.size()) return false;
  volatile unsigned char differences = 0;  // volatile: no compiler may leave the loop early
  for (std::size_t i = 0; i < text_.size(); ++i) {
    differences = static_cast<unsigned char>(differences | (given[i] ^ text_[i]));
  }
  return differences == 0;
}

}  // namespace skein::view
