// Converts numbers, arrays and texts to Python and back.   Units are not converted.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <stdexcept>
#include <string>

#include "core/types.hpp"

namespace skein::agent::python {

namespace py = pybind11;

/// A planner returned a wrong value. The text names its place in the output and states the right values.
class WrongOutput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Place of a value in an output: "motion.waypoints[2].p_WB". The text is built only when text() is called.
class Place {
 public:
  explicit Place(const char* name) : name_(name) {}
  Place(const Place& parent, const char* name) : parent_(&parent), name_(name) {}
  Place(const Place& parent, std::size_t index) : parent_(&parent), index_(static_cast<std::ptrdiff_t>(index)) {}

  std::string text() const;
  /// @throws WrongOutput with the text "<place>: must be <wanted>, not <value>".
  [[noreturn]] void refuse(const std::string& wanted, py::handle value) const;

 private:
  const Place* parent_ = nullptr;
  const char* name_ = "";
  std::ptrdiff_t index_ = -1;
};

/// A new array, with memory of its own.
py::object to_array(const Vector3d& vector);
py::object to_array(const Matrix3d& matrix);
/// A text of any bytes: those that are not UTF-8 become surrogates.
py::object to_text(const std::string& bytes);

// All of these throw WrongOutput if the value has another type or is out of range.
Vector3d read_vector(py::handle value, const Place& place);
double read_number(py::handle value, const Place& place);
std::int64_t read_integer(py::handle value, const Place& place);
bool read_bool(py::handle value, const Place& place);
/// The UTF-8 bytes of a text, which must not contain NUL.
std::string read_text(py::handle value, const Place& place);
std::string read_bytes(py::handle value, const Place& place);
/// The items of a list or tuple. @param of  their name in the error message: "Waypoints".
py::tuple read_list(py::handle value, const Place& place, const std::string& of);

}  // namespace skein::agent::python
