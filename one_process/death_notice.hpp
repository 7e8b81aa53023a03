// When the process dies, by a signal or because somebody called exit(), the launcher must be able to say of whom: all
// programs die with it.   Threads: enter() from the one that works for all programs; the rest from any.
#pragma once

#include <array>
#include <string>

namespace skein::one_process {

class DeathNotice {
 public:
  explicit DeathNotice(const std::string& program);
  ~DeathNotice();
  DeathNotice(const DeathNotice&) = delete;
  DeathNotice& operator=(const DeathNotice&) = delete;

  /// Should the process die from here on, it is this program's doing.
  void enter() const;

  /// Watches over this process. Once. @param fd  of the status pipe.
  static void watch(int fd);
  /// Gives up a program that does not end its turn: the process ends, as if the program had been aborted.
  [[noreturn]] static void give_up(const std::string& why);
  /// The same, for handlers of signals.
  [[noreturn]] static void give_up_at_once();
  /// The process ends as it should.
  static void stand_down();

  /// What may happen to a process through no wish of its own.
  static const std::array<int, 5> kSignals;

 private:
  friend void tell_of_death(int signal);

  const std::string program_;
  std::array<std::string, 5> lines_;  ///< by signal, ready to be written by a handler
};

}  // namespace skein::one_process
