// The page of a run for a browser, as long as this command lives: its socket, which the station serves while the fleet
// flies, its key, and its replay once the run is over (docs/view.md).
// Threads: all calls from one; while the replay is served the server has a thread of its own.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "cli/console.hpp"
#include "cli/run/fleet_plan.hpp"
#include "cli/run/preflight.hpp"
#include "view/feed.hpp"
#include "view/key.hpp"
#include "view/listener.hpp"

namespace skein::cli {

class LivePage {
 public:
  /// Opens the socket, draws the key and writes it down for the browser and the station.
  /// @param in_container  the socket is only proven to be free: an engine opens it for the station in its container
  /// @throws InputError when it is taken, or the page's script is missing.
  explicit LivePage(const view::Endpoint& endpoint, bool in_container = false);

  /// For the fleet's plan.
  WatchedBy watched() const;
  const view::Key& key() const { return key_; }
  const view::Endpoint& endpoint() const { return endpoint_; }
  /// Tells people where the page is, and the risk if others than programs of this host reach it; opens the user's
  /// browser where there is one. @param in_browser  the user may be there to look
  void announce(const std::function<void(const std::string&)>& say, bool in_browser) const;
  /// Serves a finished run until the user interrupts (Ctrl-C, SIGTERM, or the terminal goes).
  /// @throws InputError when the folder holds no result, or the port is not to be had any more.
  void replay(const std::filesystem::path& run);
  /// The same of a run that the page has followed, unless it is to close. What is in the way is told, no more.
  void stay_as_replay(const std::filesystem::path& run, const ViewOptions& options, const Console& console);
  /// The same of what has been told already.
  void show(view::Feed& feed, const std::string& title);

 private:
  std::string address() const;

  const std::filesystem::path script_;  ///< before anything flies: it may be missing
  std::optional<view::Listener> listener_;
  const view::Endpoint endpoint_;
  const view::Key key_;
  ScratchDir folder_;  ///< of the key
};

/// Names of files in a folder of a page.
inline constexpr const char *kViewKey = "view.key", *kViewDoor = "view.html", *kViewScript = "live.js";

/// What a station in a container reads: the key and the script. Makes the folder, of mode 0700.
/// @throws InputError when the script is missing, std::runtime_error when the folder cannot be written.
void write_for_station(const std::filesystem::path& folder, const view::Key& key);

}  // namespace skein::cli
