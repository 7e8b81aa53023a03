// The station's side of a watched run (--view-fd, --view-listen): it serves the page to browsers. It forwards the
// messages of sim_server to them, and adds the captures and their delivery, which only the station knows. It sends the
// browsers' orders to sim_server.
//
// The bus's own threads forward the messages of sim_server and do not wake the station's thread: the station's part in
// the lock-step takes the same turns whether or not browsers watch.
// Threads: one, except for callbacks from threads of the bus and of view::Server.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/inbox.hpp"
#include "station/scoreboard.hpp"
#include "view/feed.hpp"
#include "view/listener.hpp"
#include "view/server.hpp"

namespace skein::station {

struct ViewOptions {
  int listener = -1;   ///< descriptor of a socket that browsers connect to; -1: none
  std::string listen;  ///< NAME:PORT, where the station opens the socket itself, not `listener`; empty: none
  std::vector<std::string> names;  ///< by which browsers may ask for the page, besides those of the socket's address
  std::filesystem::path key;       ///< file with the page's key (view/key.hpp)
  std::filesystem::path script;    ///< file with the page's script
  std::string title;               ///< of the run, for people: "towers by kios"
};

/// The page, made ready before the run starts. @throws InputError for wrong options.
struct ReadyView {
  explicit ReadyView(const ViewOptions& options);

  std::unique_ptr<view::Listener> own;  ///< null: the launcher opened the socket
  int listener;
  view::Key key;
  view::Site site;
  std::string title;
};

class ViewNode {
 public:
  /// @param world, inbox  the station's participant in the world domain, and its inbox; they must outlive this.
  ViewNode(const ReadyView& ready, bus::Participant& world, bus::Inbox& inbox);

  /// Call it in each step: tells browsers the news in ledger and tally. @param standing  number of entries that stand.
  void end_step(const Scoreboard& scoreboard, const StepOutcome& outcome, std::uint64_t standing);
  /// Tells browsers of deliveries: those of the journal after a restart, or those of a step.
  void add_records(const std::vector<TallyRecord>& records);
  /// Ends at once, as if the process were killed.
  void stop() { server_->stop(); }

 private:
  view::Feed feed_;
  std::size_t entries_told_ = 0, scores_told_ = 0;
  std::unique_ptr<bus::Writer> orders_;
  std::unique_ptr<bus::Reader> story_, state_, clouds_;
  std::optional<view::Server> server_;
};

}  // namespace skein::station
