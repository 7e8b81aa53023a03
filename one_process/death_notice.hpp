// When the process dies, by a signal or because somebody called exit(), the launcher must be able to say of whom: all
// programs die with it. Each thread works for one program at a time.   Threads: any, each for itself.
#pragma once

#include <array>
#include <string>

namespace skein::one_process {

class DeathNotice {
 public:
  /// @param log  descriptor that takes what is said of its end; -1: stderr.
  explicit DeathNotice(const std::string& program, int log = -1);
  ~DeathNotice();
  DeathNotice(const DeathNotice&) = delete;
  DeathNotice& operator=(const DeathNotice&) = delete;

  /// Should the process die from here on by what this thread does, it is this program's doing.
  void enter() const;
  const std::string& program() const { return program_; }
  /// For which program this thread is at work; null: none.
  static const DeathNotice* here();

  /// Watches over this process. Once. @param fd  of the status pipe.
  static void watch(int fd);
  /// Gives up this program, which does not end its turn: the process ends, as if the program had been aborted.
  [[noreturn]] void give_up(const std::string& why) const;
  /// The same for the program for which this thread is at work, in handlers of signals.
  [[noreturn]] static void give_up_at_once();
  /// This thread works for nobody any more.
  static void stand_down();

  /// What may happen to a process through no wish of its own.
  static const std::array<int, 5> kSignals;

 private:
  friend void tell_of_death(int signal);

  const std::string program_;
  const int log_;
  std::array<std::string, 5> lines_;  ///< by signal, ready to be written by a handler
};

}  // namespace skein::one_process
