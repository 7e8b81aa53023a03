// Whom a doctor heard, domain by domain, and what that means. Programs of a fleet hear each other by DDS; plain
// datagrams beside it tell a network that carries nothing from one that does not carry DDS.   Pure; one thread.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "doctor/finding.hpp"
#include "doctor/greeting.hpp"
#include "doctor/network_facts.hpp"

namespace skein::doctor {

/// Another doctor, in one domain.
struct Acquaintance {
  Greeting last{};             ///< of its greetings, the latest
  std::string from{};          ///< its address, as datagrams have it; as it says itself where none arrived
  std::set<std::string> at{};  ///< own addresses at which they arrived
  bool small = false, large = false;
  std::set<std::string> dds{};  ///< vendors by which it was heard
  double clock_ahead_s = 0.0;   ///< its time of day less ours
};

/// One domain here.
struct Meeting {
  std::string domain{};
  int number = 0, base = 0;
  std::string address{};                         ///< own one; empty: whichever the vendor chooses
  std::size_t largest = 0;                       ///< datagram that its network carries [bytes]
  std::vector<std::string> vendors{};            ///< by which it was joined
  std::string trouble{};                         ///< why it could not be joined as it should; empty: it was
  std::vector<PeerFacts> peers{};                ///< named ones
  std::map<std::string, std::string> refused{};  ///< what the kernel says of datagrams to an address
  std::map<std::uint32_t, Acquaintance> heard{};
};

/// All domains in which this host takes part.
struct Meetings {
  std::uint32_t id = 0;  ///< our own
  std::string name{};
  std::vector<Meeting> domains{};
  std::map<std::string, std::set<std::string>> elsewhere{};  ///< by sender's address: domains that are none of ours

  /// A datagram of `size` bytes arrived from one address at another. Our own ones count for nothing.
  void note_datagram(const Greeting& greeting, const std::string& from, const std::string& at, std::size_t size,
                     double now_s);
  /// A sample arrived in a domain.
  void note_sample(Meeting& meeting, const Greeting& greeting);
  /// What we would say in a domain now.
  Greeting greeting(const Meeting& meeting) const;
};

/// What is to be said of one peer in one domain.
struct PeerState {
  Verdict verdict = Verdict::ok;
  std::string peer{};  ///< as the network's text names it, else as it calls itself
  std::string address{};
  std::string name{};  ///< as it calls itself; empty: not heard
  bool small = false, large = false;
  std::vector<std::string> dds{};  ///< vendors heard
  std::optional<bool> hears_us{};  ///< by DDS; nullopt: it has not said
  std::string hint{};              ///< empty: all is well
};

/// The named peers in their order, then who else was heard. This host itself is left out.
std::vector<PeerState> judge_meeting(const Meetings& all, const Meeting& meeting);

/// Whether nothing is left to be waited for: all named peers are heard, and all say that they hear this host.
bool all_hear_each_other(const Meetings& all);
/// kExitCheckFailed when a named peer was not heard as it should, or a domain could not be joined.
int exit_code(const Meetings& all);
void print(std::ostream& out, const Meetings& all);
Json as_json(const Meetings& all);

}  // namespace skein::doctor
