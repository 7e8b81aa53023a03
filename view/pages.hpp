// The HTML of a run's page while it is served: the page itself, which its script fills, and the door before it.
// Pure but for find_script() and site_of(); any thread.
#pragma once

#include <filesystem>
#include <string>

#include "view/key.hpp"
#include "view/server.hpp"

namespace skein::view {

/// The page's script. @throws InputError when it is not there.
std::filesystem::path find_script();
/// What is served, for a run of this name. @param script  a file. @throws InputError when it cannot be read.
Site site_of(const std::string& title, const std::filesystem::path& script);

/// One file that shows a finished run, or two, without any request: page, script and flight.
/// @param flight  all of it.
/// @param most_bytes  maps and LiDAR points are in the page as long as it is not larger: points go first, and the page
/// says so. 0: it has neither, nor a word of them. @throws InputError when the script is missing.
std::string kept_page(const std::string& title, const Feed& flight, std::size_t most_bytes = 0);

/// For who has not shown the key. @param refused  it was a wrong one
std::string door_page(bool refused = false);
/// Follows the key's being shown: leads to the page.
std::string entered_page();
/// A file for a browser: shows the key at the door, and so opens the page.
/// @param host  where a browser of this host finds the page, with its port. @param waits  until somebody serves it
std::string key_file_page(const std::string& host, const Key& key, bool waits = false);
/// Content-Security-Policy of all pages that are served: nothing is fetched from elsewhere.
std::string page_policy();

}  // namespace skein::view
