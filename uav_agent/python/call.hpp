// One call of a Python planner's plan(). The inputs of the call are valid until it ends: Python code that accesses them
// later gets a GoneError. Arrays of the inputs are views of the agent's memory; kept() detects that Python code still
// holds one after the call.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <utility>
#include <vector>

#include "uav_agent/python/module.hpp"

namespace skein::agent::python {

namespace py = pybind11;

class Call {
 public:
  /// @param in  must live until end(). @param order  the agent made the planner from it; must outlive this.
  Call(const PlannerInput& in, const Order& order) : in_(&in), order_(order) {}

  const Order& order() const { return order_; }
  /// The inputs. @param what  the part that is accessed, for the message: "inputs.map".
  /// @throws py::error_already_set after end(), with Python's skein.planner.GoneError.
  const PlannerInput& in(const std::string& what) const;
  /// A read-only array that refers to the agent's memory. @param name  for messages: "inputs.scans[0].points_W"
  py::array view(const std::string& name, const py::dtype& type, std::vector<py::ssize_t> shape,
                 std::vector<py::ssize_t> strides, const void* data);

  void end() { in_ = nullptr; }
  /// Call it after end(). @returns the name of the first view to which Python code still holds a reference, or an empty
  /// text. Views that only unreachable objects refer to do not count: if necessary, runs Python's garbage collector.
  std::string kept() const;

 private:
  const PlannerInput* in_;
  const Order& order_;
  /// Name and base object of each array, for kept(): an array that still exists holds a reference to its base.
  std::vector<std::pair<std::string, py::object>> views_;
};

}  // namespace skein::agent::python
