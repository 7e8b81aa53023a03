#include "bus/unsent.hpp"

#include <spdlog/spdlog.h>

namespace skein::bus {

void Unsent::note(const std::string& topic, std::string_view why) {
  ++count_;
  const std::scoped_lock lock(mutex_);
  if (!told_.insert(topic).second) return;
  spdlog::warn("{}: a sample was not sent: {}; further ones are only counted", topic, why);
}

}  // namespace skein::bus
