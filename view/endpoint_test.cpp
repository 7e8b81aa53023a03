#include "view/endpoint.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "core/types.hpp"

namespace skein::view {
namespace {

TEST(Endpoints, AreOnTheLoopbackUnlessAnAddressIsGiven) {
  EXPECT_EQ(read_endpoint("8080"), (Endpoint{"127.0.0.1", 8080}));
  EXPECT_EQ(read_endpoint("0"), (Endpoint{"127.0.0.1", 0}));
  EXPECT_EQ(read_endpoint("localhost:8080"), (Endpoint{"127.0.0.1", 8080}));
  EXPECT_EQ(read_endpoint("0.0.0.0:8080"), (Endpoint{"0.0.0.0", 8080}));
  EXPECT_EQ(read_endpoint("192.0.2.7:65535"), (Endpoint{"192.0.2.7", 65535}));
  EXPECT_EQ(read_endpoint("[::1]:8080"), (Endpoint{"::1", 8080}));
  EXPECT_EQ(read_endpoint("[0:0:0::1]:8080"), (Endpoint{"::1", 8080}))
      << "addresses are written as browsers write them";
  EXPECT_EQ(read_endpoint("[2001:DB8::7]:80"), (Endpoint{"2001:db8::7", 80}));
}

TEST(Endpoints, InvalidEndpointsAreRefused) {
  for (const char* wrong : {"",
                            "http",
                            "65536",
                            "-1",
                            "+1",
                            "8080 ",
                            "0x50",
                            ":8080",
                            "0.0.0.0",
                            "0.0.0.0:",
                            "::1:8080",
                            "[::1]",
                            "[::1]:",
                            "[127.0.0.1]:80",
                            "example.org:80",
                            "1.2.3:80",
                            "1.2.3.4.5:80",
                            "[::g]:80",
                            "127.0.0.1:80:80",
                            "127.0.0.1:99999",
                            "[::1%lo]:80"}) {
    EXPECT_THROW(read_endpoint(wrong), InputError) << wrong;
  }
}

TEST(Endpoints, KnowWhetherOnlyThisHostReachesThem) {
  for (const char* near : {"8080", "127.0.0.1:1", "127.0.0.2:1", "[::1]:1"}) {
    EXPECT_TRUE(read_endpoint(near).is_loopback()) << near;
  }
  for (const char* far : {"0.0.0.0:1", "[::]:1", "192.0.2.7:1", "[2001:db8::7]:1"}) {
    EXPECT_FALSE(read_endpoint(far).is_loopback()) << far;
  }
  EXPECT_EQ(read_endpoint("0.0.0.0:8080").from_here().text(), "127.0.0.1:8080");
  EXPECT_EQ(read_endpoint("[::]:8080").from_here().text(), "[::1]:8080");
  EXPECT_EQ(read_endpoint("192.0.2.7:8080").from_here().text(), "192.0.2.7:8080");
}

TEST(Endpoints, HaveTheNamesThatLeadToTheirAddress) {
  EXPECT_EQ(names_of({"192.0.2.7", 80}), (std::vector<std::string>{"192.0.2.7"}));
  const std::vector<std::string> all = names_of({"0.0.0.0", 80});
  std::array<char, 256> name{};
  ASSERT_EQ(::gethostname(name.data(), name.size() - 1), 0);
  std::string own = name.data();
  std::ranges::transform(own, own.begin(), ::tolower);
  EXPECT_NE(std::ranges::find(all, own), all.end());
  EXPECT_NE(std::ranges::find(all, "127.0.0.1"), all.end()) << "the loopback is an interface, too";
  EXPECT_EQ(std::ranges::find(all, "0.0.0.0"), all.end());
}

TEST(HostNames, AreReadAsBrowsersWriteThem) {
  const auto is = [](const char* text, const std::string& name, int port) {
    const HostName host = read_host(text);
    EXPECT_EQ(host.name, name) << text;
    EXPECT_EQ(name.empty() ? 0 : host.port, name.empty() ? 0 : port) << text;
  };
  is("localhost:8080", "localhost", 8080);
  is("LOCALHOST:1", "localhost", 1);
  is("localhost", "localhost", 80);
  is("[::1]:8080", "::1", 8080);
  is("[::1]", "::1", 80);
  for (const char* none : {"", ":80", "localhost:", "localhost:0", "localhost:65536", "localhost:80a", "localhost:-1",
                           "::1", "[::1", "[::1]8080", "[localhost]:80", "a:b:80", "[::1]:80:80"}) {
    is(none, "", 0);
  }
}

}  // namespace
}  // namespace skein::view
