// Runs a fleet with some programs on other hosts (`skein run --place`): local programs are children of this process,
// remote ones are children of a `skein --host` there (host_service.hpp). If the launcher loses contact with a host, the
// programs there count as ended. Linux. Threads: everything from one thread, which must live as long as the programs.
#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cli/place/host_link.hpp"
#include "cli/place/placed_paths.hpp"
#include "cli/place/placement.hpp"
#include "host/domain_block.hpp"
#include "host/preflight.hpp"
#include "host/supervisor.hpp"

namespace skein::cli {

class PlacedFleet final : public ProgramHost {
 public:
  /// Connects to the hosts. @throws InputError when a host cannot be reached, has another build, is the same machine as
  ///   another host, or does not know the launcher's address although the user gave no --network.
  PlacedFleet(const FleetPlan& plan, const std::vector<PlacedHost>& hosts);
  /// Ends the local programs and, by closing the connections, the remote ones.
  ~PlacedFleet() override;

  /// Takes DDS domains that are free on all hosts, for the lifetime of this object. @param base  as for DomainBlock.
  /// @throws InputError when there are none.
  void take_domains(std::optional<int> base, int size);
  const DomainBlock& domains() const { return *domains_; }
  /// How DDS reaches the hosts, as a value of --network. If the user gave none, the domain of each placed program has
  /// as peers the program's host and this host, and all other domains stay on this host. nullopt: all domains do.
  const std::optional<std::string>& network() const { return network_; }
  /// Runs a doctor on each host and here at the same time: they check that DDS connects the hosts in the domains of the
  /// placed programs. @param tell  receives a message, since this takes a while. @throws InputError with what the
  ///   doctors found wrong; Interrupted.
  void ask_doctors(const std::function<void(const std::string&)>& tell);
  /// Warnings for a secured run: on hosts where the login is not root, agents have no user ids of their own.
  std::vector<std::string> security_warnings() const;
  /// "jurong on hostB, raffles on hostC".
  std::string text() const;

  void start(const ProgramSpec& spec) override;
  std::vector<Event> wait(std::chrono::milliseconds limit) override;
  void send(const std::string& program, const std::string& line) override;
  void signal(const std::string& program, int signal) override;
  bool has_stopped(const std::string& program) override;
  std::vector<Event> end_all(std::chrono::milliseconds grace) override;
  std::vector<std::string> running() const override;
  bool running(const std::string& program) const override;
  std::vector<std::string> collect(const std::filesystem::path& out) override;
  std::vector<std::string> processes() const override { return running(); }
  double cpu_s(const std::string& process) const override;
  double memory_share_mb(const std::string& process) const override;

 private:
  using Clock = std::chrono::steady_clock;
  struct Use {
    double cpu_s = 0.0, memory_mb = 0.0;
  };
  struct There;  ///< a host and its programs

  std::vector<std::unique_ptr<There>> connect(const std::vector<PlacedHost>& hosts) const;
  void meet(There& there, const std::vector<std::unique_ptr<There>>& all) const;
  std::optional<std::string> network_of_hosts() const;
  There* of(const std::string& program) const;
  ProgramSpec doctor(const std::string& name, const std::vector<std::string>& domains) const;
  void launch(There& there, const ProgramSpec& spec, const PlacedProgram& placed);
  void hear(There& there, const Frame& frame, std::vector<Event>& events);
  void take_news(std::vector<Event>& events);
  void keep_log(const Frame& frame);
  static void keep_file(const Frame& frame, const std::filesystem::path& out);

  const FleetPlan plan_;
  const ScratchDir scratch_;  ///< logs of the connections and the doctors
  std::vector<std::unique_ptr<There>> hosts_;
  Supervisor here_;
  std::optional<DomainBlock> domains_;
  std::optional<std::string> network_;
  std::map<std::string, std::filesystem::path> logs_;  ///< on this host, by remote program
};

}  // namespace skein::cli
