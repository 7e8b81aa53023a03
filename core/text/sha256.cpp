#include "core/text/sha256.hpp"

#include <openssl/evp.h>

#include <bit>
#include <stdexcept>

namespace skein {
namespace {

/// OpenSSL fails here only if it runs out of memory.
void must(bool ok) {
  if (!ok) throw std::runtime_error("OpenSSL cannot compute SHA-256");
}

/// Fetched once. With EVP_sha256(), each new context would search OpenSSL's providers, which takes longer than to hash
/// a short text.
const EVP_MD* method() {
  static const EVP_MD* const fetched = EVP_MD_fetch(nullptr, "SHA256", nullptr);
  return fetched;
}

}  // namespace

void Sha256::Free::operator()(evp_md_ctx_st* context) const { EVP_MD_CTX_free(context); }

Sha256::Sha256() : context_(EVP_MD_CTX_new()) {
  must(context_ && method() != nullptr && EVP_DigestInit_ex(context_.get(), method(), nullptr) == 1);
}

Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;

Sha256::Sha256(const Sha256& other) : context_(EVP_MD_CTX_new()) {
  must(context_ && EVP_MD_CTX_copy_ex(context_.get(), other.context_.get()) == 1);
}

Sha256& Sha256::operator=(const Sha256& other) {
  if (this != &other) must(EVP_MD_CTX_copy_ex(context_.get(), other.context_.get()) == 1);
  return *this;
}

Sha256& Sha256::add_double(double value) { return add_word(std::bit_cast<std::uint64_t>(value)); }

Sha256& Sha256::add(const Vector3d& value) { return add(value.x()).add(value.y()).add(value.z()); }

Sha256& Sha256::add(const Quaterniond& value) { return add(value.w()).add(value.x()).add(value.y()).add(value.z()); }

Sha256& Sha256::add(std::string_view text) {
  add_word(text.size());
  update(text.data(), text.size());
  return *this;
}

Sha256& Sha256::add(std::span<const std::uint8_t> bytes) {
  update(bytes.data(), bytes.size());
  return *this;
}

Sha256& Sha256::add_word(std::uint64_t value) {
  std::array<std::uint8_t, 8> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(value >> (8 * i));
  update(bytes.data(), bytes.size());
  return *this;
}

void Sha256::update(const void* data, std::size_t size) { must(EVP_DigestUpdate(context_.get(), data, size) == 1); }

std::array<std::uint8_t, 32> Sha256::digest() const {
  const Sha256 finished(*this);  // a copy, because finishing ends a context
  std::array<std::uint8_t, 32> bytes{};
  unsigned size = 0;
  must(EVP_DigestFinal_ex(finished.context_.get(), bytes.data(), &size) == 1 && size == bytes.size());
  return bytes;
}

std::string Sha256::hex() const { return to_hex(digest()); }

std::string to_hex(std::span<const std::uint8_t> bytes) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  text.reserve(2 * bytes.size());
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

}  // namespace skein
