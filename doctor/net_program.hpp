// `skein doctor net`: who hears whom, by plain datagrams and by DDS, among hosts on which it runs at the same time.
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
  std::vector<std::string> domains{};  ///< all of the fleet, by name, in their order
  std::vector<std::string> only{};     ///< in which to take part; empty: all that leave the host
  std::vector<std::string> vendors{};
  int base = kFirstDomain;
  std::string name{};  ///< of this host; empty: its own
  std::chrono::milliseconds time{5000};
  bool until_heard = false;  ///< ends sooner, once all named peers are heard, hear this host, and know that
};

/// Names of peers are asked for until all are known, at most for `time`; then it speaks and listens for as long, or
/// until it is stopped, and has `tell` say what came of it.
/// @param tell  returns an exit code, and what it prints is flushed: where a vendor does not come back from leaving its
///              domains, the process ends with that.
/// @returns that code. @throws InputError for a domain, a vendor or an interface that is not there, and when there is
/// nothing to try.
int meet(const NetVisit& visit, StopSignal& stop, const std::function<int(const Meetings&)>& tell);

}  // namespace skein::doctor
