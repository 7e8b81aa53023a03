// The nodes of this folder as a module of Python, _skein_client: bytes in, bytes out. The package skein.client
// (python/skein/client) converts the bytes to messages and words the errors for users.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <thread>

#include "bus/lockstep/lockstep_node.hpp"
#include "bus/lockstep/self_signal.hpp"
#include "bus/program_bus.hpp"
#include "core/messages/view_topics.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "idl/message_definition.hpp"
#include "process/log_time.hpp"
#include "uav_agent/client/listener_node.hpp"
#include "uav_agent/client/scenario_dicts.hpp"
#include "uav_agent/client/user_node.hpp"

namespace py = pybind11;

namespace skein::agent {
namespace {

/// Version of the interface between the module and the package, which may be installed separately.
constexpr int kInterface = 1;
/// Longest time between two checks for Ctrl-C. Chosen.
constexpr std::chrono::milliseconds kLook{100};

/// The caller used an object wrongly. The text says how to use it.
class WrongUse : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};
/// The fleet goes on without this program, or sim_server is gone.
class Lost : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

py::bytes to_bytes(const std::vector<std::uint8_t>& payload) {
  return {reinterpret_cast<const char*>(payload.data()), payload.size()};
}

std::vector<std::uint8_t> from_bytes(const py::bytes& bytes) {
  const std::string_view text(bytes);
  return {text.begin(), text.end()};
}

/// The process and thread that made an object; only they may use it. A forked copy of the process does not have the
/// threads of the DDS vendor.
class Home {
 public:
  void check() const {
    if (::getpid() != pid_) throw WrongUse("a forked process must join by itself");
    if (std::this_thread::get_id() != thread_) throw WrongUse("use it only in the thread that joined");
  }
  bool is_copy() const { return ::getpid() != pid_; }

 private:
  const pid_t pid_ = ::getpid();
  const std::thread::id thread_ = std::this_thread::get_id();
};

/// A node and its bus, until close(). One process and thread uses both.
template <class Node>
class Joined {
 public:
  Joined(std::unique_ptr<bus::Bus> bus, std::unique_ptr<Node> node) : bus_(std::move(bus)), node_(std::move(node)) {}
  Joined(const Joined&) = delete;
  Joined& operator=(const Joined&) = delete;
  ~Joined() { close(); }

  /// @throws WrongUse after close(), from another thread and in a copy of the process.
  Node& node() {
    home_.check();
    if (!node_) throw WrongUse("this object is closed");
    return *node_;
  }
  void close() {
    if (home_.is_copy()) {  // destructors would wait for the DDS vendor's threads, which are not here
      static_cast<void>(node_.release());
      static_cast<void>(bus_.release());
      return;
    }
    const py::gil_scoped_release released;
    node_.reset();
    bus_.reset();
  }

 private:
  const Home home_;
  std::unique_ptr<bus::Bus> bus_;
  std::unique_ptr<Node> node_;
};

ProgramOptions options_of(const std::string& dds, std::uint64_t run, const std::string& security, int lease_s) {
  ProgramOptions options;
  options.dds = dds;
  options.run = RunId{run};
  options.security = security;
  options.lease_s = lease_s;
  return options;
}

/// The topic with this name in the domain of `id`, from the tables of core/topics.hpp. @throws InputError when there is
/// none.
topics::WireTopic known_topic(const std::string& ros_topic, const std::string& id) {
  const std::string name = wire_topic(ros_topic);
  for (const auto all :
       {topics::uav_topics(), topics::gcs_topics(), topics::viewer_topics(), topics::lockstep_topics()}) {
    for (const topics::TopicInfo& one : all) {
      if (const topics::WireTopic topic = topics::wire(one, id); topic.name == name) return topic;
    }
  }
  if (const std::string_view debug = topics::debug_name(name, id); !debug.empty()) return topics::debug(id, debug);
  throw InputError("'" + ros_topic + "' is not a topic of " + (id.empty() ? "a fleet" : id) + " (docs/topics.md)");
}

/// A topic of which the caller states the type, usually a radio topic; without a type, as known_topic().
topics::WireTopic topic_of(const std::string& ros_topic, const std::string& ros_type, const std::string& id) {
  if (ros_type.empty()) return known_topic(ros_topic, id);
  return {wire_topic(ros_topic), wire_type(ros_type), false, topics::radio_depth(topics::kMostRadioSources)};
}

/// The scenario's node with this name. @throws InputError when there is none.
Node node_named(const Scenario& scenario, const std::string& name) {
  for (const Node node : scenario.nodes()) {
    if (scenario.node_name(node) == name) return node;
  }
  throw InputError("'" + name + "' is not a UAV of this fleet, nor gcs");
}

Scenario scenario_of(const std::string& file) { return load_scenario(file, LoadOptions{.needs_scene_files = false}); }

/// A member of the lock-step that Python drives.
class Member {
 public:
  Member(const std::string& scenario, const std::string& name, int domain, const std::string& dds, std::uint64_t run,
         const std::string& security, const std::vector<std::string>& reads, const std::vector<std::string>& writes,
         int lease_s)
      : scenario_(scenario_of(scenario)), joined_(join(name, domain, dds, run, security, reads, writes, lease_s)) {}
  Member(const Member&) = delete;
  Member& operator=(const Member&) = delete;

  /// Waits for the next step. @returns false after the last one.
  bool next() {
    UserNode& node = joined_.node();
    {
      const py::gil_scoped_release released;
      if (!std::exchange(started_, true)) node.start();
      if (node.has_step()) {
        node.answer();
        node.turn(false);
      }
    }
    while (!node.end() && !node.has_step()) turn(node);
    if (!node.end()) return true;
    end();
    return false;
  }

  py::list messages() {
    py::list list;
    for (const WireMessage& message : in_step().take()) {
      list.append(py::make_tuple(message.topic.substr(2), to_bytes(message.payload)));
    }
    return list;
  }
  std::uint64_t k() { return in_step().step().k(); }
  std::int64_t tick() { return in_step().step().tick(); }
  bool final_step() { return in_step().step().final_step(); }
  bool station_linked() { return in_step().station_linked(); }
  std::size_t undelivered() { return in_step().undelivered(); }
  int joins() { return joined_.node().joins(); }

  std::string say(const std::string& topic, const py::bytes& payload) {
    static constexpr const char* kSaid[] = {"sent", "undeclared", "full", "closed"};
    return kSaid[static_cast<std::size_t>(in_step().say(wire_topic(topic), from_bytes(payload)))];
  }
  void open(const std::string& topic, const std::string& type, const std::vector<std::string>& targets) {
    in_step().open(topic, type, targets);
  }
  void listen(const std::string& topic, const std::string& type) { in_step().listen(topic, type); }
  py::tuple sending(const std::string& topic) { return status(in_step().sending(topic)); }
  py::tuple listening(const std::string& topic) { return status(in_step().listening(topic)); }

  void close() { joined_.close(); }

 private:
  Joined<UserNode> join(const std::string& name, int domain, const std::string& dds, std::uint64_t run,
                        const std::string& security, const std::vector<std::string>& reads,
                        const std::vector<std::string>& writes, int lease_s) {
    const Node node = node_named(scenario_, name);
    UserTopics topics;
    for (const std::string& topic : reads) topics.reads.push_back(known_topic(topic, name));
    for (const std::string& topic : writes) topics.writes.push_back(known_topic(topic, name));
    ProgramOptions options = options_of(dds, run, security, lease_s);
    options.domain = domain - node_domain(0, node);  // the fleet's first domain, by which networks are numbered
    if (const char* network = std::getenv("SKEIN_NETWORK"); network != nullptr && *network != '\0') {
      options.network = network;
    }
    auto bus = bus::make_bus(options, scenario_, 1);
    auto user = std::make_unique<UserNode>(scenario_, node, domain, *bus, std::move(topics));
    return {std::move(bus), std::move(user)};
  }
  UserNode& in_step() {
    UserNode& node = joined_.node();
    if (!node.has_step()) throw WrongUse("there is no step to be answered: take one first");
    return node;
  }
  static py::tuple status(const bus::RadioTopics::Status& status) {
    return py::make_tuple(status.open, status.refusal, status.unheard);
  }

  void turn(UserNode& node) {
    {
      const py::gil_scoped_release released;
      const auto rest = node.rest();
      node.turn(node.inbox().dispatch(std::min(rest.longest, kLook), rest.rings));
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }

  void end() {
    const UserNode& node = joined_.node();
    const bus::NodeEnd end = *node.end();
    const std::string name = node.member();
    const bool late = node.came_too_late();
    close();
    if (end == bus::NodeEnd::server_gone) throw Lost(name + ": sim_server is gone");
    if (end != bus::NodeEnd::finished && end != bus::NodeEnd::stopped) {
      throw Lost(name + ": the fleet goes on without this program");
    }
    if (late) spdlog::info("{}: the run was over", name);
  }

  const Scenario scenario_;
  Joined<UserNode> joined_;
  bool started_ = false;
};

class Listener {
 public:
  Listener(int domain, const std::string& dds, std::uint64_t run, const std::string& security, const std::string& id,
           const std::vector<std::pair<std::string, std::string>>& topics, std::size_t most)
      : joined_(join(domain, dds, run, security, id, topics, most)) {}
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  /// (topic, payload), or None when nothing came within `timeout_s`.
  py::object next(double timeout_s) {
    ListenerNode& node = joined_.node();
    constexpr double kMsPerS = 1e3;  // formula
    for (auto left = std::chrono::milliseconds(static_cast<std::int64_t>(kMsPerS * timeout_s));; left -= kLook) {
      std::optional<ListenerNode::Heard> heard;
      {
        const py::gil_scoped_release released;
        heard = node.next(std::clamp(left, std::chrono::milliseconds(0), kLook));
      }
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (heard) return py::make_tuple(heard->topic.substr(2), to_bytes(heard->sample.payload));
      if (left <= kLook) return py::none();
    }
  }
  bool has_writers() { return joined_.node().has_writers(); }
  std::uint64_t missed() { return joined_.node().missed(); }

  void close() { joined_.close(); }

 private:
  static Joined<ListenerNode> join(int domain, const std::string& dds, std::uint64_t run, const std::string& security,
                                   const std::string& id,
                                   const std::vector<std::pair<std::string, std::string>>& topics, std::size_t most) {
    std::vector<topics::WireTopic> wire;
    for (const auto& [topic, type] : topics) wire.push_back(topic_of(topic, type, id));
    constexpr int kLease_s = 20;  // chosen
    auto bus = bus::make_bus({.vendor = dds, .lease_s = kLease_s, .security = security, .run = RunId{run}});
    auto node = std::make_unique<ListenerNode>(*bus, domain, wire, most);
    return {std::move(bus), std::move(node)};
  }

  Joined<ListenerNode> joined_;
};

}  // namespace
}  // namespace skein::agent

PYBIND11_MODULE(_skein_client, module) {
  using namespace skein;
  using namespace skein::agent;
  spdlog::set_default_logger(make_log("skein", ""));
  // When a fault stops a user's command, the launcher itself stops this process and continues it later. sim_server's
  // order to stop may be read only after that. A second stop would then never end, so the order has no effect here.
  bus::set_self_signals({.kill = {}, .stop = [] {}});
  py::register_exception<WrongUse>(module, "WrongUse");
  py::register_exception<Lost>(module, "Lost");
  py::register_exception<InputError>(module, "WrongInput");
  module.attr("interface") = kInterface;
  module.def("definition", [](const std::string& type) {
    try {
      return message_definition(wire_type(type)).text;
    } catch (const std::out_of_range&) {
      throw py::key_error(type);
    }
  });
  module.def("config", [](const std::string& file, const std::string& name) {
    const Scenario scenario = scenario_of(file);
    return to_python(scenario, node_named(scenario, name));
  });
  module.def("radio", [](const std::string& file, const std::string& name) {
    const Scenario scenario = scenario_of(file);
    return radio_of(scenario, node_named(scenario, name));
  });
  module.def("type_of", [](const std::string& topic, const std::string& id) {
    const std::string type = known_topic(topic, id).type;  // "nav_msgs::msg::dds_::Odometry_"
    const std::size_t last = type.rfind(':') + 1;
    return type.substr(0, type.find(':')) + "/msg/" + type.substr(last, type.size() - last - 1);
  });
  py::class_<Member>(module, "Member")
      .def(py::init<const std::string&, const std::string&, int, const std::string&, std::uint64_t, const std::string&,
                    const std::vector<std::string>&, const std::vector<std::string>&, int>())
      .def("next", &Member::next)
      .def("messages", &Member::messages)
      .def("say", &Member::say)
      .def("open", &Member::open)
      .def("listen", &Member::listen)
      .def("sending", &Member::sending)
      .def("listening", &Member::listening)
      .def("close", &Member::close)
      .def_property_readonly("k", &Member::k)
      .def_property_readonly("tick", &Member::tick)
      .def_property_readonly("final_step", &Member::final_step)
      .def_property_readonly("station_linked", &Member::station_linked)
      .def_property_readonly("undelivered", &Member::undelivered)
      .def_property_readonly("joins", &Member::joins);
  py::class_<Listener>(module, "Listener")
      .def(py::init<int, const std::string&, std::uint64_t, const std::string&, const std::string&,
                    const std::vector<std::pair<std::string, std::string>>&, std::size_t>())
      .def("next", &Listener::next)
      .def("has_writers", &Listener::has_writers)
      .def("missed", &Listener::missed)
      .def("close", &Listener::close);
}
