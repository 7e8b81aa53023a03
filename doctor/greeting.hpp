// What the doctors of several hosts send each other, as datagrams of their own and as DDS samples: who they are.
// Pure; safe from any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace skein::doctor {

/// UDP, at all hosts alike; below the ports of all DDS domains.
inline constexpr int kGreetingPort = 7390;

struct Greeting {
  std::uint32_t id = 0;                    ///< of the doctor that sent it, drawn when it starts
  std::string name{};                      ///< of its host, as its user calls it
  std::string domain{};                    ///< by name: numbers may differ
  int base = 0;                            ///< of its fleet's domains
  std::string address{};                   ///< its own one in that domain's network
  std::vector<std::string> vendors{};      ///< that it uses
  std::string by{};                        ///< of a sample: the vendor that it was written by
  std::size_t size = 0;                    ///< that it was sent with [bytes]
  double sent_s = 0.0;                     ///< its time of day
  std::vector<std::uint32_t> heard_udp{};  ///< whom it has heard in that domain so far
  std::vector<std::uint32_t> heard_dds{};
};

/// @param size  bytes of the result at least; it is filled up with blanks.
std::vector<std::uint8_t> bytes_of(Greeting greeting, std::size_t size = 0);
/// @returns nullopt for what is none.
std::optional<Greeting> read_greeting(std::span<const std::uint8_t> bytes);

}  // namespace skein::doctor
