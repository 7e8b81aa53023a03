// run_in_step LIBRARY:CLASS [--ros-args ...]: creates a node of a class that knows nothing of Skein, and spins it in
// the lock-step. The class is a component as in rclcpp_components: its constructor takes rclcpp::NodeOptions.
// run_in_step finds the class by that constructor's symbol (so the constructor must be defined outside of the class),
// and needs neither rclcpp_components nor a registration.
//   LIBRARY  a path, or the name of a library in LD_LIBRARY_PATH      CLASS  with its namespaces: my_pkg::MyNode
#include <dlfcn.h>
#include <sys/mman.h>

#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "skein_ros/planner.hpp"

namespace {

/// The library does not tell the size of the object. So there is room for one of this size; of the room, only the pages
/// that the object uses take memory. A larger object ends the program, because the pages behind cannot be written.
constexpr std::size_t kMostBytes = std::size_t{1} << 30;
constexpr std::size_t kGuardBytes = std::size_t{1} << 26;

void* make_room() {
  constexpr int kFlags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE;
  void* const room = ::mmap(nullptr, kMostBytes + kGuardBytes, PROT_NONE, kFlags, -1, 0);
  if (room == MAP_FAILED || ::mprotect(room, kMostBytes, PROT_READ | PROT_WRITE) != 0) {
    throw std::runtime_error("there is no address space for the node");
  }
  return room;
}

/// The symbol of CLASS::CLASS(const rclcpp::NodeOptions&).
std::string constructor_of(const std::string& name) {
  std::string mangled;
  std::istringstream text(name);
  for (std::string part; std::getline(text, part, ':');) {
    if (part.empty()) continue;
    mangled += std::to_string(part.size()) + part;
  }
  return "_ZN" + mangled + "C1ERKN6rclcpp11NodeOptionsE";
}

std::shared_ptr<rclcpp::Node> make_node(const std::string& library, const std::string& name) {
  void* const handle = ::dlopen(library.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (handle == nullptr) throw std::runtime_error(::dlerror());
  using Constructor = void (*)(void* self, const rclcpp::NodeOptions&);
  const auto construct = reinterpret_cast<Constructor>(::dlsym(handle, constructor_of(name).c_str()));
  if (construct == nullptr) {
    throw std::runtime_error(library + " has no class " + name +
                             " with a constructor from const rclcpp::NodeOptions& " +
                             "that is defined outside of the class");
  }
  void* const room = make_room();
  construct(room, rclcpp::NodeOptions());
  // rclcpp::Node must be the first base of the class, so that the object begins with its Node.
  return {static_cast<rclcpp::Node*>(room), [room](rclcpp::Node* node) {
            node->~Node();
            ::munmap(room, kMostBytes + kGuardBytes);
          }};
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const auto colon = what.find(':');
  if (colon == std::string::npos || colon == 0 || what[colon + 1] == '\0') {
    std::cerr << "usage: run_in_step LIBRARY:CLASS [--ros-args ...], such as libmy_pkg.so:my_pkg::MyNode\n";
    return 2;
  }
  return skein_ros::run(argc, argv, [&] { return make_node(what.substr(0, colon), what.substr(colon + 1)); });
}
