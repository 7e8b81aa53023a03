// Whose turn it is in a process that is home to a whole fleet: one page of memory that this process writes and the
// launcher reads. The page is the launcher's, so that it outlives a process that stops, exits or becomes another one
// without a word.   Linux.   Threads: one writes; any reads.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>

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

  /// A turn begins, or ends.
  void enter(const std::string& program);
  void leave();
  /// Why the process ends in this turn.
  void give_reason(const std::string& reason);

  /// How many turns have begun and ended; odd: one is under way.
  std::uint64_t turns() const;
  /// The program whose turn is under way; empty: none.
  std::string holder() const;
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
