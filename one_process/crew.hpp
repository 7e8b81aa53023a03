// The programs of a fleet as objects of this process. Each gets a turn when it can do something. Programs that share
// nothing but the bus, the agents, have theirs side by side where there are threads for it; all others have theirs
// alone. Nothing of a result depends on it: what a program hears in a turn is counted (docs/lockstep.md).
// What a process is to its program is kept up: a log of its own, a death that leaves no last words, standing still
// while it is stopped, an end by an exception; and the CPU time that the server is told is its own
// (process/host/thread_cpu.hpp).
// Threads: one, but for turns() and holder().
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

  /// @param pipe  for what the programs say and what becomes of them; must outlive this.
  /// @param page  where the launcher reads whose turn it is; null: nowhere. @param status_fd  of the pipe: the process
  ///               ends when a program closes it; -1: none. @param workers  for turns side by side, no more than there
  ///               are seats on the page, and output is led by threads (program_output.hpp); null: all turns are alone.
  Crew(StatusPipe& pipe, MakeProgram make_program, TurnPage* page = nullptr, int status_fd = -1,
       Workers* workers = nullptr);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  void obey(const shared_lines::Order& order);
  /// Asks all to end.
  void stop();
  /// A turn for everybody who can do something. @returns whether anybody had anything to do.
  bool round();
  bool empty() const { return places_.empty(); }
  /// At its next round a program gets a turn though nothing has arrived: something else has come about.
  void ring(const std::string& program);
  /// The first program that ended in any other way than it should.
  const std::optional<shared_lines::Ended>& failure() const { return failure_; }

  /// After so many rounds in which nobody had anything to do they wait for a clock, and whoever drives them naps.
  static constexpr int kIdleRounds = 3;
  static constexpr std::chrono::microseconds kNap{100};

  /// Each thread has a seat, in which one program at a time has its turn.
  std::size_t seats() const { return workers_ == nullptr ? 1 : static_cast<std::size_t>(workers_->threads()); }
  /// How many turns have begun and ended there; even: none is under way. From any thread.
  std::uint64_t turns(std::size_t seat = 0) const { return seats_[seat].turns; }
  /// Whose turn is under way there; null: nobody's. From any thread.
  const DeathNotice* holder(std::size_t seat) const { return seats_[seat].holder; }

 private:
  struct Place;
  struct Turn;
  struct Seat {
    std::atomic<std::uint64_t> turns = 0;
    std::atomic<const DeathNotice*> holder = nullptr;
  };
  /// How a turn left its program.
  struct Outcome {
    std::optional<int> code;  ///< it has ended
    int signal = 0;           ///< by which, if it did as if by one
    bool killed = false;
  };

  void start(const shared_lines::Start& order);
  void signal(Place& place, int signal);
  /// Whether a program can do something. @param any  set if it is more than looking around.
  bool is_due(Place& place, bool& any) const;
  /// Turns of programs that fly beside each other.
  void turns_beside(std::vector<Place*>& places);
  /// Whatever a program does: an exception is its death. @param work  returns its exit code when it has ended.
  void in_turn(Place& place, const std::function<std::optional<int>()>& work);
  Outcome outcome_of(Place& place, bool beside, const std::function<std::optional<int>()>& work);
  void settle(Place& place, const Outcome& outcome);
  std::optional<int> go_on(Place& place);
  void end(Place& place, int code, int signal);
  void kill(Place& place);
  /// Without its pipe the process cannot say anything: whose turn it is has closed it.
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
