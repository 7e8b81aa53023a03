// The programs of a fleet as objects of this process. Each gets a turn when it can do something, on one thread, so that
// at any time at most one of them is at work.
// What a process is to its program is kept up: a log of its own, a death that leaves no last words, standing still
// while it is stopped, an end by an exception; and the CPU time that the server is told is its own
// (process/thread_cpu.hpp).
// Threads: one, but for turns() and whose_turn().
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/lockstep/fleet_program.hpp"
#include "process/shared_lines.hpp"
#include "process/status_pipe.hpp"
#include "process/turn_page.hpp"

namespace skein::one_process {

class Crew {
 public:
  /// Makes a program by its name in a run ("uav_agent-jurong").
  using MakeProgram = std::function<std::unique_ptr<bus::FleetProgram>(const std::string& name)>;

  /// @param pipe  for what the programs say and what becomes of them; must outlive this.
  /// @param page  where the launcher reads whose turn it is; null: nowhere. @param status_fd  of the pipe: the process
  ///               ends when a program closes it; -1: none.
  Crew(StatusPipe& pipe, MakeProgram make_program, TurnPage* page = nullptr, int status_fd = -1);
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

  /// How many turns have begun; even: none is under way. From any thread.
  std::uint64_t turns() const { return turns_; }

 private:
  struct Place;
  struct Turn;

  void start(const shared_lines::Start& order);
  void signal(Place& place, int signal);
  /// Whatever a program does: an exception is its death. @param work  @returns its exit code when it has ended.
  void in_turn(Place& place, const std::function<std::optional<int>()>& work);
  std::optional<int> go_on(Place& place);
  void end(Place& place, int code, int signal);
  void kill(Place& place);
  /// Without its pipe the process cannot say anything: whose turn it is has closed it.
  void check_pipe(const Place& place) const;
  Place* find(const std::string& program);

  StatusPipe& pipe_;
  const MakeProgram make_program_;
  TurnPage* const page_;
  const int status_fd_;
  ino_t pipe_inode_ = 0;
  std::vector<std::unique_ptr<Place>> places_;
  std::optional<shared_lines::Ended> failure_;
  std::atomic<std::uint64_t> turns_ = 0;
};

}  // namespace skein::one_process
