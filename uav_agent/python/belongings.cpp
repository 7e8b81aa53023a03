#include "uav_agent/python/belongings.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "uav_agent/python/interpreter.hpp"

namespace skein::agent::python {
namespace {

constexpr std::size_t kWords = 624;  // format of a Mersenne Twister: its words; one more counts the words used up

using Twister = std::vector<std::uint32_t>;

/// The two global generators, and where the states of their Mersenne Twisters are in memory. Reading the states through
/// Python would take longer than plan() of a small planner. NumPy states the address of its own; find_random() searches
/// that of `random`. If it finds none, getstate() and setstate() are used.
class Globals {
 public:
  Globals() {
    const py::tuple both = interpreter().embedded.attr("generators")();
    random = both[0], numpy = both[1];
    const py::object numpy_bits = numpy.attr("_bit_generator");
    const auto address = numpy_bits.attr("ctypes").attr("state_address").cast<std::uintptr_t>();
    numpy_bits.inc_ref();  // for as long as its address is used
    numpy_twister = {reinterpret_cast<std::uint32_t*>(address), kWords + 1};
    random_twister = find_random();
  }

  py::object random, numpy;
  std::span<std::uint32_t> numpy_twister, random_twister;  ///< random_twister is empty if it was not found

 private:
  /// Searches the object for the numbers that getstate() returns, so that a build with another layout is not misread.
  /// CPython stores the count before the words.
  std::span<std::uint32_t> find_random() const {
    Twister words;
    const py::tuple numbers = random.attr("getstate")().cast<py::tuple>()[1];
    for (const py::handle number : numbers) words.push_back(number.cast<std::uint32_t>());
    std::rotate(words.begin(), words.end() - 1, words.end());
    const auto size = py::module_::import("_random").attr("Random").attr("__basicsize__").cast<std::size_t>();
    const std::span<std::uint32_t> object{reinterpret_cast<std::uint32_t*>(random.ptr()), size / sizeof(std::uint32_t)};
    const auto found = std::ranges::search(object, words);
    return found.empty() ? std::span<std::uint32_t>() : std::span(found);
  }
};

const Globals& globals() {
  static const Globals& kGlobals = *new Globals();
  return kGlobals;
}

}  // namespace

struct Belongings::Generators {
  Twister random, numpy;
  py::object random_state = py::none(), gauss_next = py::none();  ///< of `random`
  py::object numpy_rest = py::none();  ///< NumPy's whole state, if it has a Gaussian number in store; else None

  void save() {
    const Globals& of = globals();
    gauss_next = of.random.attr("gauss_next");
    if (of.random_twister.empty()) random_state = of.random.attr("getstate")();
    random.assign(of.random_twister.begin(), of.random_twister.end());
    const bool untouched = std::ranges::equal(numpy, of.numpy_twister) && numpy_rest.is_none();
    if (untouched) return;
    numpy.assign(of.numpy_twister.begin(), of.numpy_twister.end());
    const py::object state = of.numpy.attr("get_state")(false);
    numpy_rest = state["has_gauss"].cast<int>() != 0 ? state : py::object(py::none());
  }

  /// @param in_store  whether NumPy's generator may now have a Gaussian number in store, of another planner.
  void load(bool in_store) const {
    const Globals& of = globals();
    if (of.random_twister.empty()) of.random.attr("setstate")(random_state);
    std::ranges::copy(random, of.random_twister.begin());
    of.random.attr("gauss_next") = gauss_next;
    if (!numpy_rest.is_none()) {
      of.numpy.attr("set_state")(numpy_rest);
    } else if (in_store) {
      const py::object state = of.numpy.attr("get_state")(false);
      state["has_gauss"] = 0;
      state["gauss"] = 0.0;
      of.numpy.attr("set_state")(state);
    }
    std::ranges::copy(numpy, of.numpy_twister.begin());
  }
};

Belongings* Belongings::current = nullptr;

Belongings::Belongings(std::string folder, std::uint64_t seed, const std::string& uav)
    : folder_(std::move(folder)), generators_(std::make_unique<Generators>()) {
  if (current != nullptr) current->put_away();
  current = nullptr;
  interpreter().embedded.attr("seed")(seed, uav);
  generators_->save();
  enter();
}

Belongings::~Belongings() {
  if (current == this) {
    put_away();
    current = nullptr;
  }
}

void Belongings::enter() {
  if (current == this) return;
  if (current != nullptr) current->put_away();
  // A planner that was destroyed may have left a number in store.
  const bool in_store = current == nullptr || !current->generators_->numpy_rest.is_none();
  py::module_ sys = py::module_::import("sys");
  for (const auto& [name, module] : modules_) sys.attr("modules")[name] = module;
  sys.attr("path")[py::int_(0)] = folder_;
  generators_->load(in_store);
  modules_seen_ = PyDict_Size(sys.attr("modules").ptr());
  current = this;
}

void Belongings::put_away() {
  const py::dict all = py::module_::import("sys").attr("modules");
  note_modules();
  for (const auto& [name, module] : modules_) {
    if (all.contains(name)) PyDict_DelItem(all.ptr(), name.ptr());
  }
  generators_->save();
}

void Belongings::note_modules() {
  PyObject* const all = PyImport_GetModuleDict();
  if (PyDict_Size(all) == modules_seen_) return;
  modules_seen_ = PyDict_Size(all);
  for (const py::handle name : interpreter().embedded.attr("own_modules")(folder_)) {
    modules_[name] = py::reinterpret_borrow<py::dict>(all)[name];
  }
}

}  // namespace skein::agent::python
