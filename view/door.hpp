// Access control of the page: those decisions about an HTTP request that need only its headers.   Pure; any thread.
//
// Host: refuses requests for another name that resolves to an address of this host (DNS rebinding). Its port may be the
// browser's end of a tunnel, so it is not compared. Origin: refuses requests that a page of another site makes the
// browser send. Cookie: refuses browsers that have not presented the key.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "view/key.hpp"

namespace skein::view {

class Door {
 public:
  /// @param names  host names that requests may use, beside 127.0.0.1, localhost and ::1. @param key  opens the page
  Door(std::vector<std::string> names, Key key);

  /// Whether the name in a Host header is an accepted one; ignores the port.
  bool knows_host(std::string_view host) const;
  /// Whether the Origin header is that of this server's own page. @param host  Host header that knows_host() accepts
  bool is_own_origin(std::string_view origin, std::string_view host) const;
  /// Whether the Cookie header holds the key. @param host  as above
  bool opens(std::string_view cookie, std::string_view host) const;
  const Key& key() const { return key_; }
  /// Value of a Set-Cookie header. Browsers share cookies between ports, so the cookie's name has the port of `host`.
  std::string cookie(std::string_view host) const;

 private:
  std::vector<std::string> names_;
  const Key key_;
};

/// The value of a field in the body of a form (application/x-www-form-urlencoded), not decoded; empty: no such field.
std::string_view form_field(std::string_view body, std::string_view name);

}  // namespace skein::view
