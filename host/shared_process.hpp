// All programs of a fleet in one process (one_process/). Its events report each program as if it were a process.
// Threads: the launcher's one.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "host/supervisor.hpp"
#include "process/status/turn_page.hpp"

namespace skein::cli {

class SharedProcess final : public ProgramHost {
 public:
  /// @param process  runs all programs; starts with the first one. The constructor adds --turn-page to its arguments.
  /// @param patience_s  wall time that a turn may take. When a turn takes longer and the process does not end itself
  ///                    (it may be stopped), the launcher kills it; 0: no limit.
  explicit SharedProcess(ProgramSpec process, double patience_s = 0.0);

  void start(const ProgramSpec& spec) override;
  std::vector<Event> wait(std::chrono::milliseconds limit) override;
  void send(const std::string& program, const std::string& line) override;
  void signal(const std::string& program, int signal) override;
  bool has_stopped(const std::string& program) override { return stopped_.erase(program) > 0; }
  std::vector<Event> end_all(std::chrono::milliseconds grace) override;
  std::vector<std::string> running() const override { return {running_.begin(), running_.end()}; }
  bool running(const std::string& program) const override { return running_.contains(program); }
  std::vector<std::string> processes() const override { return supervisor_.processes(); }
  double cpu_s(const std::string& process) const override { return supervisor_.cpu_s(process); }
  double memory_share_mb(const std::string& process) const override { return supervisor_.memory_share_mb(process); }

 private:
  std::vector<Event> translated(const std::vector<Event>& events);
  void hear(const std::string& text, std::vector<Event>& events);
  void on_death(const Event& event, std::vector<Event>& events);
  /// Ends the process when a turn takes too long.
  void look_after_turns();
  /// Finds the program in whose turn the process ended, and writes the reason to its log. @returns its name; empty: no
  /// program is to blame, or one of several is, which the log of the process then names.
  std::string blame(const ExitStatus& exit);

  ProgramSpec process_;
  Supervisor supervisor_;
  TurnPage page_;
  const std::chrono::duration<double> patience_;
  struct Seat {
    std::uint64_t turn = 0;
    std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now();
  };
  std::array<Seat, TurnPage::kSeats> seats_;
  std::set<std::string> running_, stopped_;
  std::map<std::string, std::filesystem::path> logs_;
  bool explained_ = false;  ///< the process itself has reported which program's end was fatal
};

}  // namespace skein::cli
