// The page of a run for a browser, as long as this command lives: its socket, which the station serves while the fleet
// flies, its key, and its replay once the run is over (docs/view.md).
// Threads: all calls from one; while the replay is served the server has a thread of its own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "cli/console.hpp"
#include "cli/run/fleet_plan.hpp"
#include "cli/run/preflight.hpp"
#include "view/key.hpp"
#include "view/listener.hpp"

namespace skein::cli {

class LivePage {
 public:
  /// Opens the socket, draws the key and writes it down for the browser and the station.
  /// @param port  0: any that is free. @throws InputError when it is taken, or the page's script is missing.
  explicit LivePage(std::uint16_t port);

  /// For the fleet's plan.
  WatchedBy watched() const;
  /// Where the page is, for people.
  std::string address() const;
  /// Serves a finished run until the user interrupts (Ctrl-C, SIGTERM, or the terminal goes).
  /// @throws InputError when the folder holds no result.
  void replay(const std::filesystem::path& run) const;

 private:
  const std::filesystem::path script_;  ///< before anything flies: it may be missing
  view::Listener listener_;
  view::Key key_;
  ScratchDir folder_;  ///< of the key
};

}  // namespace skein::cli
