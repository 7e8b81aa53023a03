// `skein doctor net`, which runs on several hosts at the same time: finds which of them receive messages from which
// others, by plain datagrams and by DDS.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "core/config/network_config.hpp"
#include "doctor/meeting.hpp"
#include "process/program.hpp"

namespace skein::doctor {

struct NetVisit {
  NetworkConfig network{};
  std::vector<std::string> domains{};  ///< names of all the fleet's domains, in the order of their numbers
  std::vector<std::string> only{};     ///< domains in which to take part; empty: all that leave the host
  std::vector<std::string> vendors{};
  int base = kFirstDomain;               ///< number of the fleet's first domain
  std::string name{};                    ///< name of this host; empty: its host name
  std::chrono::milliseconds time{5000};  ///< limit of the name look-up, and then of the meeting
  bool until_heard = false;              ///< end early, once all peers are heard and report that they hear this host
};

/// Looks up the peers' names until all are known, at most for `visit.time`. Then sends and receives greetings for the
/// same time, or until stopped, and calls `tell` with the result. Blocks.
/// @param tell  prints the result, flushes its output and returns an exit code. If a vendor then hangs while it leaves
///              its domains, the process exits with that code.
/// @returns that code. @throws InputError for an unknown domain, vendor or interface, if the UDP port for greetings is
/// in use, and if no chosen domain leaves the host.
int meet(const NetVisit& visit, StopSignal& stop, const std::function<int(const Meetings&)>& tell);

}  // namespace skein::doctor
