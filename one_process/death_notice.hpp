// Tells the launcher which program caused the death of the process, by a signal or a call of exit(): all programs of
// the process die with it. A thread works for one program at a time.   Threads: any; the state is per thread.
#pragma once

#include <array>
#include <string>

namespace skein::one_process {

class DeathNotice {
 public:
  /// @param log  descriptor of the log in which give_up() writes why the program ends; -1: stderr.
  explicit DeathNotice(const std::string& program, int log = -1);
  ~DeathNotice();
  DeathNotice(const DeathNotice&) = delete;
  DeathNotice& operator=(const DeathNotice&) = delete;

  /// From now on this thread works for this program: if the thread makes the process die, the program is the cause.
  void enter() const;
  const std::string& program() const { return program_; }
  /// The notice of the program that this thread works for; null: none.
  static const DeathNotice* here();

  /// Begins to watch this process. Call it once. @param fd  descriptor of the status pipe
  static void watch(int fd);
  /// Ends the process because this program does not end its turn, as if the program had been aborted.
  [[noreturn]] void give_up(const std::string& why) const;
  /// The same for the program that this thread works for; may be called in signal handlers.
  [[noreturn]] static void give_up_at_once();
  /// From now on this thread works for no program.
  static void stand_down();

  /// The signals that are watched: those of a crash.
  static const std::array<int, 5> kSignals;

 private:
  friend void tell_of_death(int signal);

  const std::string program_;
  const int log_;
  std::array<std::string, 5> lines_;  ///< by signal: the line that the signal handler writes, made in advance
};

}  // namespace skein::one_process
