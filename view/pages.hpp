// The HTML of a run's page while it is served: the page itself, which its script fills, and the door before it.
// Pure but for find_site(); any thread.
#pragma once

#include <cstdint>
#include <string>

#include "view/key.hpp"
#include "view/server.hpp"

namespace skein::view {

/// What is served, for a run of this name. @throws InputError when the page's script is not there.
Site find_site(const std::string& title);

/// For who has not shown the key. @param refused  it was a wrong one
std::string door_page(bool refused = false);
/// Follows the key's being shown: leads to the page.
std::string entered_page();
/// A file for a browser: shows the key at the door, and so opens the page.
std::string key_file_page(std::uint16_t port, const Key& key);
/// Content-Security-Policy of all pages that are served: nothing is fetched from elsewhere.
std::string page_policy();

}  // namespace skein::view
