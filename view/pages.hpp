// HTML of the pages that show runs: the page of a run, which its script fills; the login page, which asks for the key;
// and files for the browser.
// Pure except for find_script(), site_of() and kept_page(), which read the script's file; any thread.
#pragma once

#include <filesystem>
#include <string>

#include "view/key.hpp"
#include "view/server.hpp"

namespace skein::view {

/// File of the page's script. @throws InputError when it is missing.
std::filesystem::path find_script();
/// The content that the server serves for a run. @param script  file of the script.
/// @throws InputError when it cannot be read.
Site site_of(const std::string& title, const std::filesystem::path& script);

/// A self-contained page that shows one or two finished runs without any request: page, script and flight in one file.
/// @param flight  feed with the complete flight.
/// @param most_bytes  greatest size of a page with maps and LiDAR points. If it would be larger, the points are left
/// out, then also the maps, and the page says so. 0: it has neither, and does not mention them.
/// @throws InputError when the script is missing or damaged.
std::string kept_page(const std::string& title, const Feed& flight, std::size_t most_bytes = 0);

/// The login page, for browsers that have not presented the key. @param refused  whether they presented a wrong key
std::string door_page(bool refused = false);
/// The answer to the right key: leads the browser to the page.
std::string entered_page();
/// A local file that the user opens in a browser: it presents the key to the server, which then opens the page.
/// @param host  address and port of the page for a browser on this host.
/// @param waits  whether the file first waits until the page is served.
std::string key_file_page(const std::string& host, const Key& key, bool waits = false);
/// Content-Security-Policy of all served pages: they fetch nothing from other sites.
std::string page_policy();

}  // namespace skein::view
