// The web page of a run, which exists until this command ends: its socket, on which the station serves the page while
// the fleet flies, its key, and its replay after the run (docs/view.md).
// Threads: all calls from one; while this command serves the replay, the server has a thread of its own.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <ostream>
#include <string>

#include "host/preflight.hpp"
#include "run/fleet_plan.hpp"
#include "view/feed.hpp"
#include "view/key.hpp"
#include "view/listener.hpp"

namespace skein::cli {

class LivePage {
 public:
  /// Opens the socket, draws a random key, and writes it to files for the browser and the station.
  /// @param in_container  closes the socket again, since the container engine opens it for the station
  /// @throws InputError if the port is taken, or the page's script is missing.
  explicit LivePage(const view::Endpoint& endpoint, bool in_container = false);

  /// The socket and files, for FleetPlan::watched.
  WatchedBy watched() const;
  const view::Key& key() const { return key_; }
  const view::Endpoint& endpoint() const { return endpoint_; }
  /// Prints where the page is, and warns if other hosts can reach it.
  /// @param say  receives the messages, a line each. @param in_browser  also opens the user's browser, if there is one
  void announce(const std::function<void(const std::string&)>& say, bool in_browser) const;
  /// Serves the replay of a finished run until a signal ends it (SIGINT, SIGTERM, or SIGHUP of a closed terminal).
  /// @throws InputError if the folder holds no result, or another program has taken the port.
  void replay(const std::filesystem::path& run);
  /// The same for the run that the page has shown, unless `options.close`. Only prints an InputError, never throws it.
  /// @param err  receives the messages
  void stay_as_replay(const std::filesystem::path& run, const ViewOptions& options, std::ostream& err);
  /// The same for a feed that already holds a run.
  void show(view::Feed& feed, const std::string& title);

 private:
  const std::filesystem::path script_;  ///< found before anything flies, since it may be missing
  std::optional<view::Listener> listener_;
  const view::Endpoint endpoint_;
  const view::Key key_;
  ScratchDir folder_;  ///< holds the key and the page that opens with it
};

/// Names of a page's files: its key, the local HTML file that opens it with the key, and its script.
inline constexpr const char *kViewKey = "view.key", *kViewDoor = "view.html", *kViewScript = "live.js";

/// Writes the files that a station in a container reads: the key and the script. Creates the folder, with mode 0700.
/// @throws InputError if the script is missing, std::runtime_error if the folder cannot be written.
void write_for_station(const std::filesystem::path& folder, const view::Key& key);

}  // namespace skein::cli
