// Raw DDS participants that get past the checks of their own library (impostor.cpp). Each vendor has a file of its own,
// because their headers cannot be combined.
#pragma once

#include <functional>
#include <string>

#include "bus/bus.hpp"

namespace skein::test {

struct Disguise {
  int own = 0;    ///< the domain that the certificate is for, and that the participant joins
  int other = 0;  ///< the domain whose ports and id the participant uses
  bus::BusConfig config;
  std::string topic, type;  ///< that the participant reads, with their names on the wire
};

/// Returns the number of writers that the participant's reader has matched.
using Count = std::function<int()>;

/// The participants stay until the process ends. @throws std::runtime_error when the library refuses.
Count join_cyclonedds(const Disguise& disguise);
Count join_fastdds(const Disguise& disguise);

}  // namespace skein::test
