// Certificates, keys and signed documents of DDS Security, made for one run. The authorities' own keys never leave this
// process. Not thread-safe.
#pragma once

#include <memory>
#include <string>

struct evp_pkey_st;
struct x509_st;

namespace skein::cli {

/// The identity of a DDS participant, as PEM texts.
struct Identity {
  std::string subject;  ///< as in its permissions (RFC 2253): "CN=station,O=Skein,C=NL"
  std::string certificate;
  std::string key;
};

/// A certificate authority with a key (EC, prime256v1) and a self-signed certificate of its own. All functions throw
/// std::runtime_error when OpenSSL fails.
class Authority {
 public:
  /// @param name  common name of the authority.
  explicit Authority(const std::string& name);

  /// The authority's own certificate (PEM).
  std::string certificate() const;
  /// A new key, with a certificate that cannot sign other certificates. @param name  the common name.
  Identity issue(const std::string& name) const;
  /// The text as a signed S/MIME message (PKCS #7), as DDS Security requires of governance and permissions.
  std::string sign(const std::string& text) const;

 private:
  struct Free {
    void operator()(evp_pkey_st* key) const;
    void operator()(x509_st* certificate) const;
  };
  using Key = std::unique_ptr<evp_pkey_st, Free>;
  using Certificate = std::unique_ptr<x509_st, Free>;

  static Key new_key();
  /// @param issuer  null: self-signed
  static Certificate certify(const std::string& name, evp_pkey_st* key, x509_st* issuer, evp_pkey_st* issuer_key);

  Key key_;
  Certificate certificate_;
};

}  // namespace skein::cli
