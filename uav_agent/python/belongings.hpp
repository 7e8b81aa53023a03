// The state that each planner has for itself although several share one interpreter: its modules, the first entry of
// Python's search path, and the states of the global random generators of `random` and NumPy.
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
  /// @param folder  of the planner's file. @param seed, uav  seed the generators.
  Belongings(std::string folder, std::uint64_t seed, const std::string& uav);
  ~Belongings();
  Belongings(const Belongings&) = delete;
  Belongings& operator=(const Belongings&) = delete;

  /// Makes Python use the modules, search path and generators of this planner, and stores those of the former one.
  void enter();
  /// Call it after code of the planner has run: modules imported since enter() belong to this planner.
  void note_modules();

 private:
  struct Generators;
  void put_away();

  static Belongings* current;  ///< the planner whose modules Python uses now

  const std::string folder_;
  py::dict modules_;
  py::ssize_t modules_seen_ = 0;  ///< number of all modules in the last note_modules()
  std::unique_ptr<Generators> generators_;
};

}  // namespace skein::agent::python
