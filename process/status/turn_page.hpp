// Shared memory in which a process that hosts a whole fleet records which program has its turn, for the launcher. The
// launcher owns the memory, so the contents survive when the process stops, exits or calls exec() without notice. Each
// thread of the process has a seat of its own in it. In a seat, one program at a time has its turn.
// Linux.   Threads: one thread writes to a seat, any thread reads. Program names are cut to 119 bytes, reasons to 255.
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
  /// The launcher's page, empty. @throws std::system_error
  TurnPage();
  /// Maps the launcher's page into this process. @param file  path() of that page. @throws std::system_error
  explicit TurnPage(const std::filesystem::path& file);
  ~TurnPage();
  TurnPage(const TurnPage&) = delete;
  TurnPage& operator=(const TurnPage&) = delete;

  /// The path under which processes of the same user can open the launcher's page.
  std::filesystem::path path() const;
  /// Empties the page for the next process.
  void clear();

  static constexpr std::size_t kSeats = 64;

  /// Records that a turn of `program` begins in a seat; leave() that it ends. @param seat  below kSeats
  void enter(std::size_t seat, const std::string& program);
  void leave(std::size_t seat);
  /// Records why the process ends during a turn. @param program  whose turn it is; empty: not known.
  void give_reason(const std::string& reason, const std::string& program = {});

  /// Turns begun plus turns ended in a seat: odd while a turn is under way.
  std::uint64_t turns(std::size_t seat) const;
  /// The program whose turn is under way in the seat; empty: none.
  std::string holder(std::size_t seat) const;
  /// Programs that may have ended the process: the one that give_reason() named, else all whose turns are under way.
  std::vector<std::string> holders() const;
  std::string reason() const;
  /// Id of the process that writes to the page; 0: none.
  pid_t process() const;

 private:
  struct Content;
  void map();
  [[noreturn]] void fail(const std::string& what);

  int fd_ = -1;
  Content* content_ = nullptr;
};

}  // namespace skein
