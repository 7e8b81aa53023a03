#include "process/health/heartbeat.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace skein {

void Heartbeat::beat(Clock::time_point now) {
  if (file_.empty() || now < next_) return;
  next_ = now + std::chrono::seconds(2);  // health checks of containers allow 20 s
  const int fd = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  if (fd < 0) return;
  ::futimens(fd, nullptr);
  ::close(fd);
}

}  // namespace skein
