// The message by which doctors (`skein doctor net`) on several hosts introduce themselves to each other. They send it
// as plain UDP datagrams and as DDS samples.
// Pure; safe from any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace skein::doctor {

/// UDP port for greetings, the same on all hosts; below the ports of all DDS domains.
inline constexpr int kGreetingPort = 7390;

struct Greeting {
  std::uint32_t id = 0;                    ///< sender's random id, drawn at its start; never 0
  std::string name{};                      ///< name of the sender's host (--as; default: its host name)
  std::string domain{};                    ///< domain's name: the hosts may number it differently
  int base = 0;                            ///< first domain of the sender's fleet (--domain)
  std::string address{};                   ///< sender's address in that domain's network
  std::vector<std::string> vendors{};      ///< DDS vendors that the sender uses in that domain
  std::string by{};                        ///< DDS vendor that wrote this sample; empty in a datagram
  std::size_t size = 0;                    ///< requested size of a large datagram [bytes]; else 0
  double sent_s = 0.0;                     ///< sender's time of day, since 1970 [s]
  std::vector<std::uint32_t> heard_udp{};  ///< ids of the doctors heard in that domain by UDP
  std::vector<std::uint32_t> heard_dds{};  ///< the same by DDS
};

/// @param size  minimum size of the result [bytes]; shorter text is padded with blanks.
std::vector<std::uint8_t> bytes_of(Greeting greeting, std::size_t size = 0);
/// @returns nullopt if the bytes are not a greeting.
std::optional<Greeting> read_greeting(std::span<const std::uint8_t> bytes);

}  // namespace skein::doctor
