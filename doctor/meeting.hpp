// Which other doctors (`skein doctor net` on other hosts) a doctor has heard in each domain, and what that means for a
// fleet. A fleet's programs communicate by DDS. Doctors also send plain datagrams, to distinguish a network that
// carries nothing from one that only does not carry DDS.   Pure; one thread.
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

/// Another doctor that was heard in one domain.
struct Acquaintance {
  Greeting last{};             ///< its latest greeting
  std::string from{};          ///< source address of its datagrams; without datagrams, the address in its greeting
  std::set<std::string> at{};  ///< own addresses at which its datagrams arrived
  bool small = false, large = false;  ///< whether small datagrams, and datagrams of Meeting::largest, arrived
  std::set<std::string> dds{};        ///< vendors by which its samples arrived
  double clock_ahead_s = 0.0;         ///< its time of day minus this host's
};

/// One domain in which this host takes part.
struct Meeting {
  std::string domain{};
  int number = 0, base = 0;
  std::string address{};                          ///< own address; empty: the vendor chooses
  std::size_t largest = 0;                        ///< largest datagram that fits into one packet [bytes]; 0: unknown
  std::vector<std::string> vendors{};             ///< vendors by which it was joined
  std::string trouble{};                          ///< why joining it failed, wholly or in part; empty: no failure
  std::vector<PeerFacts> peers{};                 ///< peers that the network lists
  std::map<std::string, std::string> refused{};   ///< by destination address: error of datagrams to it
  std::map<std::uint32_t, Acquaintance> heard{};  ///< by id
};

/// All domains in which this host takes part.
struct Meetings {
  std::uint32_t id = 0;  ///< this doctor's own
  std::string name{};
  std::vector<Meeting> domains{};
  std::map<std::string, std::set<std::string>> elsewhere{};  ///< by sender's address: domains not in `domains`

  /// Records a datagram of `size` bytes that arrived from one address at another. Ignores this doctor's own.
  /// @param now_s  time of day, since 1970 [s]
  void note_datagram(const Greeting& greeting, const std::string& from, const std::string& at, std::size_t size,
                     double now_s);
  /// Records a sample that arrived in a domain. Ignores this doctor's own.
  void note_sample(Meeting& meeting, const Greeting& greeting);
  /// The greeting to send in a domain now; the caller adds `by` and `sent_s`.
  Greeting greeting(const Meeting& meeting) const;
};

/// Judgement of one peer in one domain.
struct PeerState {
  Verdict verdict = Verdict::ok;
  std::string peer{};  ///< name in the network's configuration; if not listed: `name`
  std::string address{};
  std::string name{};  ///< its own name for itself; empty: not heard
  bool small = false, large = false;
  std::vector<std::string> dds{};  ///< vendors heard
  std::optional<bool> hears_us{};  ///< by DDS; nullopt: unknown, because the peer was not heard
  std::string hint{};              ///< probable cause and remedy; empty: all is well
};

/// First the listed peers, in their order, then other doctors that were heard. Without this host itself.
std::vector<PeerState> judge_meeting(const Meetings& all, const Meeting& meeting);

/// Whether nothing is left to wait for: exit_code() is kExitDone, and all peers report that they hear this host.
bool all_hear_each_other(const Meetings& all);
/// kExitCheckFailed if a listed peer was not fully heard, or a domain could not be joined; else kExitDone.
int exit_code(const Meetings& all);
void print(std::ostream& out, const Meetings& all);
Json as_json(const Meetings& all);

}  // namespace skein::doctor
