// Shows the progress of a run: on a terminal, one line that is rewritten; elsewhere, a new line every tenth of the
// mission.   Times in seconds.   Threads: one.
#pragma once

#include <ostream>
#include <string>

#include "process/status/status_lines.hpp"
#include "results/result.hpp"

namespace skein::cli {

class ProgressView {
 public:
  /// @param terminal  whether `out` can rewrite its last line.
  ProgressView(std::ostream& out, bool terminal) : out_(&out), terminal_(terminal) {}

  /// Writes to another stream from now on. @param out  must outlive this.
  void write_to(std::ostream& out, bool terminal);

  /// @param wall_s  wall time since the fleet's first step [s], for the speed.
  void progress(const status::Progress& progress, double wall_s);
  /// Shows which programs the fleet waits for: on a terminal always, elsewhere only if `wait.due`.
  void waiting_for(const status::WaitingFor& wait);
  void tally(const status::Tally& tally) { tally_ = tally; }
  /// Prints a message on a line of its own, above the progress.
  void message(const std::string& text);
  /// Ends the progress line.
  void finish();

 private:
  void show(const std::string& text);

  std::ostream* out_;
  bool terminal_;
  std::string shown_;
  status::Tally tally_;
  int tenths_shown_ = 0;
  double first_sim_s_ = 0.0, first_wall_s_ = -1.0;  ///< times of the first progress(); the speed is a mean since then
};

/// Prints the summary of a finished run. @param result  result.json. @param dir  the results folder
void print_summary(std::ostream& out, const Json& result, const std::filesystem::path& dir);

}  // namespace skein::cli
