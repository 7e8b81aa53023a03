// The programs of a fleet of which some run on other hosts (`skein run --place`): those here are children of this
// process, those there of a process that serves it (host_service.hpp). A host of which nothing is heard any more is the
// end of its programs. Linux. Threads: everything from one thread, which must live as long as the programs.
#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cli/host/domain_block.hpp"
#include "cli/host/supervisor.hpp"
#include "cli/place/host_link.hpp"
#include "cli/place/placed_paths.hpp"
#include "cli/place/placement.hpp"
#include "cli/run/preflight.hpp"

namespace skein::cli {

class PlacedFleet final : public ProgramHost {
 public:
  /// Connects to the hosts. @throws InputError when one cannot be reached, has another build, or is another one's
  ///   machine.
  PlacedFleet(const FleetPlan& plan, const std::vector<PlacedHost>& hosts);
  /// Ends what runs here and, by closing the connections, what runs there.
  ~PlacedFleet() override;

  /// Takes domains that are free on all hosts, for as long as this lives. @throws InputError when there are none.
  void take_domains(std::optional<int> base, int size);
  const DomainBlock& domains() const { return *domains_; }
  /// How the fleet's domains reach the hosts, as --network takes it: the user's own text, else each placed UAV's domain
  /// has its host and this one as peers, and nothing else leaves this host. nullopt: nothing does.
  const std::optional<std::string>& network() const { return network_; }
  /// Asks a doctor on each host at the same time whether they hear each other in the placed domains.
  /// @param tell  hears that it takes its time. @throws InputError with what is in the way; Interrupted.
  void ask_doctors(const std::function<void(const std::string&)>& tell);
  /// What the user should know of a secured run there.
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
  struct There;  ///< a host, and what runs there

  std::vector<std::unique_ptr<There>> connect(const std::vector<PlacedHost>& hosts) const;
  void meet(There& there, const std::vector<std::unique_ptr<There>>& others) const;
  std::optional<std::string> network_of_hosts() const;
  There* of(const std::string& program) const;
  ProgramSpec doctor(const std::string& name, const std::vector<std::string>& domains) const;
  void launch(There& there, const ProgramSpec& spec, const PlacedProgram& placed);
  void hear(There& there, const Frame& frame, std::vector<Event>& events);
  void take_news(std::vector<Event>& events);
  void keep_log(const Frame& frame);
  static void keep_file(const Frame& frame, const std::filesystem::path& out);

  const FleetPlan plan_;
  const ScratchDir scratch_;  ///< what the connections complain of
  std::vector<std::unique_ptr<There>> hosts_;
  Supervisor here_;
  std::optional<DomainBlock> domains_;
  std::optional<std::string> network_;
  std::map<std::string, std::filesystem::path> logs_;  ///< here, of programs there
};

}  // namespace skein::cli
