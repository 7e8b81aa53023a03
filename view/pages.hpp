// The HTML of a run's page while it is served: the page itself, which its script fills, and the door before it.
// Pure but for find_script() and site_of(); any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "view/key.hpp"
#include "view/server.hpp"

namespace skein::view {

/// The page's script. @throws InputError when it is not there.
std::filesystem::path find_script();
/// What is served, for a run of this name. @param script  a file. @throws InputError when it cannot be read.
Site site_of(const std::string& title, const std::filesystem::path& script);

/// For who has not shown the key. @param refused  it was a wrong one
std::string door_page(bool refused = false);
/// Follows the key's being shown: leads to the page.
std::string entered_page();
/// A file for a browser: shows the key at the door, and so opens the page.
std::string key_file_page(std::uint16_t port, const Key& key);
/// Content-Security-Policy of all pages that are served: nothing is fetched from elsewhere.
std::string page_policy();

}  // namespace skein::view
