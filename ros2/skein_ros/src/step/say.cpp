#include "say.hpp"

#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <mutex>
#include <set>

namespace skein_ros {

void say(const std::string& text) { std::cerr << "[skein_ros] " + text + "\n"; }

void say_once(const std::string& text) {
  static std::mutex mutex;
  static std::set<std::string> said;
  const std::scoped_lock lock(mutex);
  if (said.insert(text).second) say(text);
}

void fail(const std::string& why) {
  say(why);
  std::fflush(nullptr);
  ::_exit(kFailed);
}

}  // namespace skein_ros
