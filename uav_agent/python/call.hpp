// One call of a Python planner's plan(): its inputs are valid until the call ends. Accessing them later raises an
// error, and kept() detects code that still holds a view of the agent's memory.
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
  /// @param in  must live until end(). @param order  of the planner; must outlive this.
  Call(const PlannerInput& in, const Order& order) : in_(&in), order_(order) {}

  const Order& order() const { return order_; }
  /// The inputs. @param what  the requested part: "inputs.map". @throws py::error_already_set, GoneError, after end().
  const PlannerInput& in(const std::string& what) const;
  /// A read-only array that refers to the agent's memory. @param name  for messages: "inputs.scans[0].points_W"
  py::array view(const std::string& name, const py::dtype& type, std::vector<py::ssize_t> shape,
                 std::vector<py::ssize_t> strides, const void* data);

  void end() { in_ = nullptr; }
  /// After end(): the name of a view to which Python code still holds a reference; empty: none.
  std::string kept() const;

 private:
  const PlannerInput* in_;
  const Order& order_;
  std::vector<std::pair<std::string, py::object>> views_;  ///< name and base object of each array, for kept()
};

}  // namespace skein::agent::python
