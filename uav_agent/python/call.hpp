// One call of plan(): what its inputs refer to is there until it is over. Whoever asks later gets an error, and whoever
// keeps a view of the agent's memory is found out when the call ends.
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
  /// @param order  of the planner; outlives this.
  Call(const PlannerInput& in, const Order& order) : in_(&in), order_(order) {}

  const Order& order() const { return order_; }
  /// @param what  is asked for: "inputs.map". @throws py::error_already_set, GoneError, when the call is over.
  const PlannerInput& in(const std::string& what) const;
  /// An array of the agent's memory that cannot be written to. @param name  for people: "inputs.scans[0].points_W"
  py::array view(const std::string& name, const py::dtype& type, std::vector<py::ssize_t> shape,
                 std::vector<py::ssize_t> strides, const void* data);

  void end() { in_ = nullptr; }
  /// After the end: the name of a view that somebody still has; empty: there is none.
  std::string kept() const;

 private:
  const PlannerInput* in_;
  const Order& order_;
  std::vector<std::pair<std::string, py::object>> views_;  ///< what each array holds on to
};

}  // namespace skein::agent::python
