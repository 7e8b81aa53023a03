// Functions of the shared object skein_python, and the Planner that they create for a planner in Python.
#include "uav_agent/python/module.hpp"

#include <spdlog/fmt/fmt.h>

#include "uav_agent/python/belongings.hpp"
#include "uav_agent/python/call.hpp"
#include "uav_agent/python/inputs.hpp"
#include "uav_agent/python/interpreter.hpp"
#include "uav_agent/python/outputs.hpp"
#include "uav_agent/python/parameters.hpp"
#include "uav_agent/python/values.hpp"

#define SKEIN_VISIBLE __attribute__((visibility("default")))

namespace skein::agent::python {
namespace {

/// plan() of the Python planner failed. The agent ends, with this text as the last lines of its log.
class PlannerFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Runs code of the user's planner before the flight. An error is then a mistake of the user, not a failed flight.
/// @param what  what failed, for the message. @throws InputError
auto as_input(const Order& order, const std::string& what, const auto& work) {
  const std::string head = "--planner " + text_of(order.planner) + ": " + what;
  try {
    return work();
  } catch (py::error_already_set& error) {
    if (is_wrong_input(error)) throw InputError(head + ": " + std::string(py::str(error.value())));
    throw InputError(head + ":\n" + explanation(error));
  } catch (const WrongOutput& error) {
    throw InputError(head + ": " + error.what());
  }
}

class PythonPlanner final : public Planner {
 public:
  explicit PythonPlanner(const Order& order)
      : order_(order),
        name_(order.agent.me().name),
        belongings_(order.planner.file.parent_path().string(), order.seed, name_),
        rules_{order_} {
    const auto& embedded = interpreter().embedded;
    const py::object type = as_input(order_, "cannot be loaded", [&] {
      return py::object(embedded.attr("load")(order_.planner.file.string(), order_.planner.class_name));
    });
    const py::dict values =
        as_input(order_, "wrong parameters", [&] { return read_parameters(type, order_.parameters); });
    planner_ = as_input(order_, "cannot be created",
                        [&] { return py::object(embedded.attr("construct")(type, values, to_python(order_.agent))); });
    ask();
    if (order_.debug_from_s) debugger_ = embedded.attr("Debugger")(*order_.debug_from_s);
    plan_ = planner_.attr("plan");
    belongings_.note_modules();
  }
  PythonPlanner(const PythonPlanner&) = delete;
  PythonPlanner& operator=(const PythonPlanner&) = delete;

  PlannerOutput plan(const PlannerInput& in) override {
    belongings_.enter();
    const auto call = std::make_shared<Call>(in, order_);
    PlannerOutput output;
    try {
      {
        const py::object inputs = inputs_of(call);
        const py::object given = debugger_ ? debugger_.attr("call")(plan_, inputs) : plan_(inputs);
        output = read_output(given, rules_);
      }
      call->end();
      if (const std::string kept = debugger_ ? "" : call->kept(); !kept.empty()) {
        throw WrongOutput(kept + " was kept, but is valid only during the call: keep a copy (array.copy())");
      }
    } catch (py::error_already_set& error) {
      call->end();
      fail(in, explanation(error) + "\n", "failed");
    } catch (const WrongOutput& error) {
      call->end();
      fail(in, "", std::string("was refused: ") + error.what());
    }
    belongings_.note_modules();
    return output;
  }

  bool wants_scans() const override { return wants_scans_; }
  bool wants_beams() const override { return wants_beams_; }
  bool wants_world_map() const override { return wants_world_map_; }
  const FlightConfig* flight() const override { return flight_ ? &*flight_ : nullptr; }
  std::vector<std::string> debug_names() const override { return rules_.debug_names; }

 private:
  /// Asks the planner for everything that must not change during the flight.
  void ask() {
    const auto wish = [&](const char* name) {
      return as_input(order_, std::string(name) + "()", [&] { return read_bool(planner_.attr(name)(), Place(name)); });
    };
    wants_scans_ = wish("wants_scans");
    wants_beams_ = wish("wants_beams");
    wants_world_map_ = wish("wants_world_map");
    as_input(order_, "flight()", [&] {
      if (const py::object flight = planner_.attr("flight")(); !flight.is_none()) {
        flight_ = read_flight_config(flight);
      }
    });
    rules_.flown = flight_.has_value();
    as_input(order_, "debug_names()", [&] {
      for (const py::handle name : interpreter().embedded.attr("names_of")(planner_.attr("debug_names")())) {
        rules_.debug_names.push_back(read_text(name, Place("debug_names()")));
      }
    });
  }

  /// The last line names the UAV, the planner and the time, because the launcher shows only the end of a log.
  [[noreturn]] void fail(const PlannerInput& in, const std::string& traceback, const std::string& how) const {
    throw PlannerFailure(fmt::format("{}{}'s planner {} {}, at step {} ({:.2f} s)", traceback, name_,
                                     text_of(order_.planner), how, in.k, seconds(in.tick)));
  }

  const Order order_;
  const std::string name_;
  Belongings belongings_;
  OutputRules rules_;
  py::object planner_, plan_, debugger_;
  std::optional<FlightConfig> flight_;
  bool wants_scans_ = false, wants_beams_ = false, wants_world_map_ = false;
};

}  // namespace
}  // namespace skein::agent::python

extern "C" SKEIN_VISIBLE const char* skein_python_interface() { return skein::agent::python::kInterfaceVersion; }

extern "C" SKEIN_VISIBLE void skein_make_python_planner(const skein::agent::python::Order& order,
                                                        std::unique_ptr<skein::agent::Planner>& planner) {
  skein::agent::python::interpreter(order.package_folder);
  planner = std::make_unique<skein::agent::python::PythonPlanner>(order);
}
