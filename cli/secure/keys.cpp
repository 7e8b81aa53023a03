#include "cli/secure/keys.hpp"

#include <openssl/bio.h>
#include <openssl/ec.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include <array>
#include <stdexcept>

#include "core/text/sha256.hpp"

namespace skein::cli {
namespace {

/// From a day ago, for clocks that differ, to a month from now: far longer than any run.
constexpr long kValidFrom_s = -24L * 3600, kValidUntil_s = 30L * 24 * 3600;

/// @throws std::runtime_error with OpenSSL's reason
void must(bool ok, const char* what) {
  if (ok) return;
  std::array<char, 256> reason{};
  ERR_error_string_n(ERR_get_error(), reason.data(), reason.size());
  throw std::runtime_error(std::string("OpenSSL cannot ") + what + ": " + reason.data());
}

struct FreeOthers {
  void operator()(BIO* bio) const { BIO_free_all(bio); }
  void operator()(PKCS7* message) const { PKCS7_free(message); }
  void operator()(X509_EXTENSION* extension) const { X509_EXTENSION_free(extension); }
};
using Bio = std::unique_ptr<BIO, FreeOthers>;

Bio memory() {
  Bio bio(BIO_new(BIO_s_mem()));
  must(bio != nullptr, "get memory");
  return bio;
}

std::string text_of(const Bio& bio) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(bio.get(), &data);
  return {data, static_cast<std::size_t>(size)};
}

std::string pem(X509* certificate) {
  const Bio bio = memory();
  must(PEM_write_bio_X509(bio.get(), certificate) == 1, "write a certificate");
  return text_of(bio);
}

/// "CN=..,O=..,C=..": Fast DDS compares this text, Cyclone DDS its parts.
std::string subject_of(X509* certificate) {
  const Bio bio = memory();
  must(X509_NAME_print_ex(bio.get(), X509_get_subject_name(certificate), 0, XN_FLAG_RFC2253) >= 0, "print a name");
  return text_of(bio);
}

void add_extension(X509* certificate, int kind, const char* value) {
  const std::unique_ptr<X509_EXTENSION, FreeOthers> extension(X509V3_EXT_conf_nid(nullptr, nullptr, kind, value));
  must(extension && X509_add_ext(certificate, extension.get(), -1) == 1, "extend a certificate");
}

/// The name itself if it fits into a certificate (RFC 5280, ub-common-name). Otherwise its beginning, with a digest by
/// which it differs from other names. "uav_agent-UAV" does not fit if the name of the UAV is long.
std::string common_name(const std::string& name) {
  constexpr std::size_t kLongest = 64, kDigest = 16;
  if (name.size() <= kLongest) return name;
  return name.substr(0, kLongest - kDigest - 1) + "-" + Sha256().add(name).hex().substr(0, kDigest);
}

/// Adds the parts in reverse order, since RFC 2253 prints the last part first.
void set_name(X509_NAME* subject, const std::string& name) {
  const auto add = [&](const char* part, const std::string& value) {
    must(X509_NAME_add_entry_by_txt(subject, part, MBSTRING_UTF8, reinterpret_cast<const unsigned char*>(value.data()),
                                    static_cast<int>(value.size()), -1, 0) == 1,
         "name a certificate");
  };
  add("C", "NL");
  add("O", "Skein");
  add("CN", common_name(name));
}

}  // namespace

void Authority::Free::operator()(evp_pkey_st* key) const { EVP_PKEY_free(key); }
void Authority::Free::operator()(x509_st* certificate) const { X509_free(certificate); }

Authority::Key Authority::new_key() {
  Key key(EVP_EC_gen("prime256v1"));
  must(key != nullptr, "make a key");
  return key;
}

Authority::Certificate Authority::certify(const std::string& name, evp_pkey_st* key, x509_st* issuer,
                                          evp_pkey_st* issuer_key) {
  Certificate certificate(X509_new());
  X509* x509 = certificate.get();
  must(x509 != nullptr && X509_set_version(x509, X509_VERSION_3) == 1, "begin a certificate");
  std::uint64_t serial = 0;
  must(RAND_bytes(reinterpret_cast<unsigned char*>(&serial), sizeof serial) == 1, "draw a number");
  ASN1_INTEGER_set_uint64(X509_get_serialNumber(x509), serial >> 1);
  X509_gmtime_adj(X509_getm_notBefore(x509), kValidFrom_s);
  X509_gmtime_adj(X509_getm_notAfter(x509), kValidUntil_s);
  set_name(X509_get_subject_name(x509), name);
  must(X509_set_issuer_name(x509, X509_get_subject_name(issuer != nullptr ? issuer : x509)) == 1 &&
           X509_set_pubkey(x509, key) == 1,
       "fill a certificate");
  add_extension(x509, NID_basic_constraints, issuer != nullptr ? "critical,CA:FALSE" : "critical,CA:TRUE");
  must(X509_sign(x509, issuer_key, EVP_sha256()) > 0, "sign a certificate");
  return certificate;
}

Authority::Authority(const std::string& name)
    : key_(new_key()), certificate_(certify(name, key_.get(), nullptr, key_.get())) {}

std::string Authority::certificate() const { return pem(certificate_.get()); }

Identity Authority::issue(const std::string& name) const {
  const Key key = new_key();
  const Certificate certificate = certify(name, key.get(), certificate_.get(), key_.get());
  const Bio bio = memory();
  must(PEM_write_bio_PKCS8PrivateKey(bio.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) == 1, "write a key");
  return {subject_of(certificate.get()), pem(certificate.get()), text_of(bio)};
}

std::string Authority::sign(const std::string& text) const {
  const Bio in(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
  const int flags = PKCS7_TEXT | PKCS7_DETACHED;
  const std::unique_ptr<PKCS7, FreeOthers> message(
      PKCS7_sign(certificate_.get(), key_.get(), nullptr, in.get(), flags));
  must(message != nullptr && BIO_reset(in.get()) == 1, "sign a document");
  const Bio out = memory();
  must(SMIME_write_PKCS7(out.get(), message.get(), in.get(), flags) == 1, "write a signed document");
  return text_of(out);
}

}  // namespace skein::cli
