// The programs of a fleet as objects in this process. Each program gets a turn when it has something to do. Agents
// share nothing but the bus, so their turns run in parallel if there are threads; every other program has its turn
// alone. Results do not depend on this: what a program receives in a turn is counted (docs/lockstep.md).
// A program behaves as in a process of its own: it has its own log; when it is killed, it writes nothing more; while it
// is stopped, it gets no turns; an exception ends it; and the CPU time that the server measures is the server's own
// (process/host/thread_cpu.hpp).
// Threads: one, except for turns() and holder().
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/lockstep/fleet_program.hpp"
#include "one_process/death_notice.hpp"
#include "process/host/workers.hpp"
#include "process/status/shared_lines.hpp"
#include "process/status/status_pipe.hpp"
#include "process/status/turn_page.hpp"

namespace skein::one_process {

class Crew {
 public:
  /// Makes a program by its name in a run ("uav_agent-jurong").
  using MakeProgram = std::function<std::unique_ptr<bus::FleetProgram>(const std::string& name)>;

  /// @param pipe  gets the programs' status lines and news of their ends; must outlive this.
  /// @param page  shows the launcher whose turn it is; null: there is none.
  /// @param status_fd  descriptor of the pipe: the process ends when a program closes it; -1: not checked.
  /// @param workers  threads for turns in parallel, at most TurnPage::kSeats, after ProgramOutput::lead_by_thread();
  ///                 null: there are no turns in parallel.
  Crew(StatusPipe& pipe, MakeProgram make_program, TurnPage* page = nullptr, int status_fd = -1,
       Workers* workers = nullptr);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  void obey(const shared_lines::Order& order);
  /// Asks all programs to end.
  void stop();
  /// Gives a turn to each program that can do something. @returns whether any program had something to do.
  bool round();
  bool empty() const { return places_.empty(); }
  /// Gives a program a turn in the next round although no sample has arrived for it.
  void ring(const std::string& program);
  /// The first program that failed: it ended with another exit code than 0, or by a signal.
  const std::optional<shared_lines::Ended>& failure() const { return failure_; }

  /// After this many idle rounds, programs can only wait for wall time to pass: the caller of round() sleeps for kNap.
  static constexpr int kIdleRounds = 3;
  static constexpr std::chrono::microseconds kNap{100};

  /// Number of seats. Each thread has a seat, in which one program at a time has its turn.
  std::size_t seats() const { return workers_ == nullptr ? 1 : static_cast<std::size_t>(workers_->threads()); }
  /// Turns begun plus turns ended in a seat: odd while a turn is under way. Any thread.
  std::uint64_t turns(std::size_t seat = 0) const { return seats_[seat].turns; }
  /// The program whose turn is under way in a seat; null: none. Any thread.
  const DeathNotice* holder(std::size_t seat) const { return seats_[seat].holder; }

 private:
  struct Place;
  struct Turn;
  struct Seat {
    std::atomic<std::uint64_t> turns = 0;
    std::atomic<const DeathNotice*> holder = nullptr;
  };
  /// The state of a program after its turn.
  struct Outcome {
    std::optional<int> code;  ///< exit code, if the program has ended
    int signal = 0;           ///< signal that would have ended a process of its own; 0: none
    bool killed = false;      ///< by a fault
  };

  void start(const shared_lines::Start& order);
  void signal(Place& place, int signal);
  /// Whether a program is to get a turn. @param any  set if the program has something to do, and not only polls.
  bool is_due(Place& place, bool& any) const;
  /// Gives these programs their turns in parallel, and empties the list.
  void turns_beside(std::vector<Place*>& places);
  /// Runs part of a program as its turn; an exception ends the program. @param work  returns its exit code if it ended.
  void in_turn(Place& place, const std::function<std::optional<int>()>& work);
  Outcome outcome_of(Place& place, bool beside, const std::function<std::optional<int>()>& work);
  void settle(Place& place, const Outcome& outcome);
  std::optional<int> go_on(Place& place);
  void end(Place& place, int code, int signal);
  void kill(Place& place);
  /// Ends the process if the status pipe was closed, since it cannot report anything then: the program whose turn it is
  /// has closed it.
  void check_pipe(const Place& place, bool beside) const;
  Place* find(const std::string& program);

  StatusPipe& pipe_;
  const MakeProgram make_program_;
  TurnPage* const page_;
  const int status_fd_;
  Workers* const workers_;
  ino_t pipe_inode_ = 0;
  std::vector<std::unique_ptr<Place>> places_;
  std::optional<shared_lines::Ended> failure_;
  std::array<Seat, TurnPage::kSeats> seats_;
};

}  // namespace skein::one_process
