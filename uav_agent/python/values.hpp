// Numbers and arrays on their way into Python and out of it.   Units: as they are.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <stdexcept>
#include <string>

#include "core/types.hpp"

namespace skein::agent::python {

namespace py = pybind11;

/// A planner gave something that cannot be flown; the text says where it stands and what would be right.
class WrongOutput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Where in an output something stands: "motion.waypoints[2].p_WB". It costs nothing until its text is asked for.
class Place {
 public:
  explicit Place(const char* name) : name_(name) {}
  Place(const Place& parent, const char* name) : parent_(&parent), name_(name) {}
  Place(const Place& parent, std::size_t index) : parent_(&parent), index_(static_cast<std::ptrdiff_t>(index)) {}

  std::string text() const;
  /// @throws WrongOutput "place: must be `wanted`, not what it is".
  [[noreturn]] void refuse(const std::string& wanted, py::handle value) const;

 private:
  const Place* parent_ = nullptr;
  const char* name_ = "";
  std::ptrdiff_t index_ = -1;
};

/// An array of three that is Python's own.
py::object to_array(const Vector3d& vector);
py::object to_array(const Matrix3d& matrix);
/// A text whatever bytes it has.
py::object to_text(const std::string& bytes);

// @throws WrongOutput
Vector3d read_vector(py::handle value, const Place& place);
double read_number(py::handle value, const Place& place);
std::int64_t read_integer(py::handle value, const Place& place);
bool read_bool(py::handle value, const Place& place);
/// Bytes of a text, without NUL.
std::string read_text(py::handle value, const Place& place);
std::string read_bytes(py::handle value, const Place& place);
/// A list or tuple, and no text. @param of  for people: "Waypoints"
py::tuple read_list(py::handle value, const Place& place, const std::string& of);

}  // namespace skein::agent::python
