#include "uav_agent/python/interpreter.hpp"

#include <dlfcn.h>
#include <pybind11/embed.h>

#include <cstdlib>

#include "core/types.hpp"
#include "uav_agent/python/inputs.hpp"
#include "uav_agent/python/maps.hpp"

namespace skein::agent::python {
namespace {

/// Environment variable with which `skein check-planner` sets another hash seed, and so another order of sets of texts.
/// 0, the default: hashes are not randomised.
constexpr const char* kHashSeed = "SKEIN_HASH_SEED";

void require(const PyStatus& status) {
  if (PyStatus_Exception(status) == 0) return;
  throw InputError(std::string("--planner py:...: Python cannot be started: ") +
                   (status.err_msg != nullptr ? status.err_msg : "no reason given"));
}

/// Makes the symbols of Python's library global: NumPy's modules look them up in the process, but dlopen() has loaded
/// skein_python and its libraries with local symbols.
void show_symbols() {
  Dl_info info{};
  if (::dladdr(reinterpret_cast<void*>(&Py_InitializeFromConfig), &info) != 0) {
    ::dlopen(info.dli_fname, RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD);
  }
}

/// The Python program of the user's virtual environment, or else Debian's.
std::string program_name() {
  const char* environment = std::getenv("VIRTUAL_ENV");
  const std::string own = environment == nullptr ? "" : std::string(environment) + "/bin/python3";
  std::error_code none;
  return !own.empty() && std::filesystem::exists(own, none) ? own : "/usr/bin/python3";
}

/// Starts Python so that no run depends on the locale, the order of hashes or the user's settings of the interpreter.
/// Python leaves signals to the agent.
void start() {
  PyPreConfig before;
  PyPreConfig_InitPythonConfig(&before);
  before.utf8_mode = 1;
  before.coerce_c_locale = 0;
  before.configure_locale = 0;
  require(Py_PreInitialize(&before));
  PyConfig config;
  PyConfig_InitPythonConfig(&config);
  const char* const chosen = std::getenv(kHashSeed);
  config.use_hash_seed = 1;
  config.hash_seed = chosen == nullptr ? 0 : std::strtoul(chosen, nullptr, 10);  // format: decimal
  config.install_signal_handlers = 0;
  config.buffered_stdio = 0;
  config.optimization_level = 0;
  config.parse_argv = 0;
  PyStatus status = PyConfig_SetBytesString(&config, &config.program_name, program_name().c_str());
  if (PyStatus_Exception(status) == 0) status = Py_InitializeFromConfig(&config);
  PyConfig_Clear(&config);
  require(status);
}

Interpreter* started(const std::filesystem::path& package_folder) {
  show_symbols();
  start();
  try {
    if (!package_folder.empty()) py::module_::import("sys").attr("path").attr("insert")(0, package_folder.string());
    // NumPy warns if its environment variable disables a feature that the processor does not have.
    py::module_::import("warnings").attr("filterwarnings")("ignore", "During parsing environment variable");
    py::module_::import("_skein_planner");
    auto embedded = py::module_::import("skein._embedded");
    if (!package_folder.empty()) py::module_::import("sys").attr("path").attr("pop")(0);
    embedded.attr("prepare")();
    return new Interpreter{embedded, Words(py::module_::import("skein.planner"))};  // never deleted
  } catch (py::error_already_set& error) {
    throw InputError("--planner py:...: a Python package that planners need is missing: " + std::string(error.what()) +
                     "\nDebian's packages python3-skein and python3-numpy have it");
  }
}

}  // namespace

PYBIND11_EMBEDDED_MODULE(_skein_planner, module) {
  register_inputs(module);
  register_maps(module);
}

Words::Words(const py::module_& planner)
    : agent_config(planner.attr("AgentConfig")),
      beam_scan(planner.attr("BeamScan")),
      camera(planner.attr("Camera")),
      firing(planner.attr("Firing")),
      fleet_member(planner.attr("FleetMember")),
      flight_config(planner.attr("FlightConfig")),
      flight_state(planner.attr("FlightState")),
      gimbal_command(planner.attr("GimbalCommand")),
      gimbal_state(planner.attr("GimbalState")),
      goal(planner.attr("Goal")),
      gone_error(planner.attr("GoneError")),
      hold(planner.attr("Hold")),
      key_frame(planner.attr("KeyFrame")),
      link_quality(planner.attr("LinkQuality")),
      oriented_box(planner.attr("OrientedBox")),
      outcome(planner.attr("Outcome")),
      path(planner.attr("Path")),
      peer(planner.attr("Peer")),
      planner_input(planner.attr("PlannerInput")),
      planner_output(planner.attr("PlannerOutput")),
      radio_message(planner.attr("RadioMessage")),
      scan(planner.attr("Scan")),
      setpoint(planner.attr("Setpoint")),
      stake(planner.attr("Stake")),
      state(planner.attr("State")),
      tracking_state(planner.attr("TrackingState")),
      trajectory_command(planner.attr("TrajectoryCommand")),
      vehicle(planner.attr("Vehicle")),
      waypoint(planner.attr("Waypoint")) {}

const Interpreter& interpreter(const std::filesystem::path& package_folder) {
  static const Interpreter* const the_one = started(package_folder);
  return *the_one;
}

std::string explanation(py::error_already_set& error) {
  try {
    const py::object frames = error.trace() ? py::object(error.trace()) : py::object(py::none());
    return interpreter().embedded.attr("explain")(error.value(), frames).cast<std::string>();
  } catch (py::error_already_set& another) {  // the text of the exception cannot be made
    return another.what();
  }
}

bool is_wrong_input(const py::error_already_set& error) { return error.matches(interpreter().embedded.attr("Wrong")); }

}  // namespace skein::agent::python
