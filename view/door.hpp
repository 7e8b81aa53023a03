// Who may come in: the decisions about a request that need nothing but its header lines.   Pure; any thread.
//
// Host: a page of another name that resolves to an address of this host (DNS rebinding) is refused. The port in it is
// the browser's end of whatever tunnel leads here, and tells nothing. Origin: so are requests that a page of elsewhere
// makes its reader's browser send. Cookie: so is whoever has not shown the key.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "view/key.hpp"

namespace skein::view {

class Door {
 public:
  /// @param names  by which browsers may ask for the page, beside 127.0.0.1, localhost and ::1
  Door(std::vector<std::string> names, Key key);

  /// Of a Host header, with whatever port.
  bool knows_host(std::string_view host) const;
  /// Whether a page of ours sends it. @param host  a known one
  bool is_own_origin(std::string_view origin, std::string_view host) const;
  /// Whether a Cookie header holds the key. @param host  a known one
  bool opens(std::string_view cookie, std::string_view host) const;
  const Key& key() const { return key_; }
  /// For a Set-Cookie header. Cookies do not know ports, so its name holds the browser's. @param host  a known one
  std::string cookie(std::string_view host) const;

 private:
  std::vector<std::string> names_;
  const Key key_;
};

/// The value of a field in the body of a form (application/x-www-form-urlencoded), as it stands there; empty: none.
std::string_view form_field(std::string_view body, std::string_view name);

}  // namespace skein::view
