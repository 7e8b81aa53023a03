// What belongs to one planner of an interpreter that several may share: its modules, the head of Python's search path,
// and the states of the global random generators, `random`'s and NumPy's.
// Threads: the interpreter's.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <string>

namespace skein::agent::python {

namespace py = pybind11;

class Belongings {
 public:
  /// @param folder  of the planner's file. @param seed, uav  that the generators are seeded with.
  Belongings(std::string folder, std::uint64_t seed, const std::string& uav);
  ~Belongings();
  Belongings(const Belongings&) = delete;
  Belongings& operator=(const Belongings&) = delete;

  /// From here on they are what Python finds; those of the planner before are put away.
  void enter();
  /// After code of the planner has run: modules that it has imported meanwhile are its own.
  void note_modules();

 private:
  struct Generators;
  void put_away();

  static Belongings* current;  ///< of whom Python's are just now

  const std::string folder_;
  py::dict modules_;
  py::ssize_t modules_seen_ = 0;  ///< of all, when they were looked through last
  std::unique_ptr<Generators> generators_;
};

}  // namespace skein::agent::python
