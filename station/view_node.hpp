// The station's side of a run that is watched (--view-fd, --view-listen): it serves the page to browsers. What
// sim_server tells goes to them as it comes; what only the station knows, captures and what became of them, it adds.
// What browsers ask of the run goes back to sim_server.
//
// What comes from sim_server is handed on by the bus's own threads and wakes nobody: the station's part in the
// lock-step takes the same turns whether or not somebody looks on.
// Threads: one, but for what the bus and the server's thread call.
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
  int listener = -1;               ///< a socket that browsers connect to
  std::string listen;              ///< else NAME:PORT, where the station opens one itself; empty: nobody watches
  std::vector<std::string> names;  ///< by which browsers may ask for the page, beside those of that socket
  std::filesystem::path key;       ///< file (view/key.hpp)
  std::filesystem::path script;    ///< of the page, a file
  std::string title;               ///< of the run, for people: "towers by kios"
};

/// Its page, before anything flies. @throws InputError for what is wrong with the options.
struct ReadyView {
  explicit ReadyView(const ViewOptions& options);

  std::unique_ptr<view::Listener> own;  ///< null: it is the launcher's
  int listener;
  view::Key key;
  view::Site site;
  std::string title;
};

class ViewNode {
 public:
  /// @param world, inbox  of the station; they must outlive this.
  ViewNode(const ReadyView& ready, bus::Participant& world, bus::Inbox& inbox);

  /// After each step: what is news of the ledger and the tally.
  void end_step(const Scoreboard& scoreboard, const StepOutcome& outcome, std::uint64_t standing);
  /// What a journal of an earlier life had in it.
  void add_records(const std::vector<TallyRecord>& records);
  /// As a process does that is killed.
  void stop() { server_->stop(); }

 private:
  view::Feed feed_;
  std::size_t entries_told_ = 0, scores_told_ = 0;
  std::unique_ptr<bus::Writer> orders_;
  std::unique_ptr<bus::Reader> story_, state_, clouds_;
  std::optional<view::Server> server_;
};

}  // namespace skein::station
