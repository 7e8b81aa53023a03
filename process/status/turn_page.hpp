// Whose turn it is in a process that is home to a whole fleet: memory that this process writes and the launcher reads.
// It is the launcher's, so that it outlives a process that stops, exits or becomes another one without a word. Each
// thread of the process has a seat of its own there, in which one program at a time has its turn.
// Linux.   Threads: one writes in a seat; any reads.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace skein {

class TurnPage {
 public:
  /// An empty page. @throws std::system_error
  TurnPage();
  /// The page of another process. @param file  its path() there. @throws std::system_error
  explicit TurnPage(const std::filesystem::path& file);
  ~TurnPage();
  TurnPage(const TurnPage&) = delete;
  TurnPage& operator=(const TurnPage&) = delete;

  /// Under which processes of the same user find it.
  std::filesystem::path path() const;
  /// For the next process.
  void clear();

  static constexpr std::size_t kSeats = 64;

  /// A turn begins, or ends. @param seat  below kSeats
  void enter(std::size_t seat, const std::string& program);
  void leave(std::size_t seat);
  /// Why the process ends in a turn that is under way. @param program  whose turn; empty: it is not known.
  void give_reason(const std::string& reason, const std::string& program = {});

  /// How many turns have begun and ended in a seat; odd: one is under way.
  std::uint64_t turns(std::size_t seat) const;
  /// The program whose turn is under way there; empty: none.
  std::string holder(std::size_t seat) const;
  /// The programs whose turns are under way: those that may have ended the process. If one has given the reason, it.
  std::vector<std::string> holders() const;
  std::string reason() const;
  /// Of the process that writes; 0: none.
  pid_t process() const;

 private:
  struct Content;
  void map();

  int fd_ = -1;
  Content* content_ = nullptr;
};

}  // namespace skein
