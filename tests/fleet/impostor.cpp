// A raw DDS participant that gets past the checks of its own library: it joins the domain that its certificate is for,
// but on the ports, and with the id, of another domain. Only the participants of that domain can still reject it.
//   impostor VENDOR OWN_DOMAIN OTHER_DOMAIN FILE SECURITY_DIR TOPIC TYPE
// Keeps FILE up to date with TOPIC, the number of writers that its reader has matched, and 0. Runs until it is killed.
#include "impostor.hpp"

#include <chrono>
#include <thread>

#include "process/files/atomic_file.hpp"

int main(int argc, char** argv) {
  if (argc != 8) return 2;
  const std::string vendor = argv[1];
  const skein::test::Disguise disguise{
      std::stoi(argv[2]), std::stoi(argv[3]), {.vendor = vendor, .security = argv[5]}, argv[6], argv[7]};
  const skein::test::Count matched = vendor == "fastdds" ? join_fastdds(disguise) : join_cyclonedds(disguise);
  for (int before = -1;;) {
    const int now = matched();
    if (now != before) {
      skein::write_file_atomically(argv[4], disguise.topic + " " + std::to_string(before = now) + " 0\n");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // polling period; nothing depends on it
  }
}
