// Who may come in: the decisions about a request that need nothing but its header lines.   Pure; any thread.
//
// Host: a page of another name that resolves to the loopback (DNS rebinding) is refused. Origin: so are requests that a
// page of elsewhere makes its reader's browser send. Cookie: so is whoever has not shown the key.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "view/key.hpp"

namespace skein::view {

class Door {
 public:
  Door(std::uint16_t port, Key key);

  /// 127.0.0.1, localhost or [::1], with the port.
  bool knows_host(std::string_view host) const;
  /// Whether a page of ours sends it. @param host  a known one
  bool is_own_origin(std::string_view origin, std::string_view host) const;
  /// Whether a Cookie header holds the key.
  bool opens(std::string_view cookie) const;
  const Key& key() const { return key_; }
  /// For a Set-Cookie header. Cookies do not know ports, so its name holds ours.
  std::string cookie() const;

 private:
  const std::uint16_t port_;
  const Key key_;
};

/// The value of a field in the body of a form (application/x-www-form-urlencoded), as it stands there; empty: none.
std::string_view form_field(std::string_view body, std::string_view name);

}  // namespace skein::view
