// Raw participants that get past their own library's checks, see impostor.cpp. A file for each vendor, since their
// headers do not go together.
#pragma once

#include <functional>
#include <string>

#include "bus/bus.hpp"

namespace skein::test {

struct Disguise {
  int own = 0;    ///< the domain that the certificate is for, and that the participant joins
  int other = 0;  ///< the domain whose ports and number it uses
  bus::BusConfig config;
  std::string topic, type;  ///< that it reads, as on the wire
};

/// How many writers has it matched?
using Count = std::function<int()>;

/// They stay until the process ends. @throws std::runtime_error when the library refuses.
Count join_cyclonedds(const Disguise& disguise);
Count join_fastdds(const Disguise& disguise);

}  // namespace skein::test
