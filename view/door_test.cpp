#include "view/door.hpp"

#include <gtest/gtest.h>

namespace skein::view {
namespace {

class DoorTest : public testing::Test {
 protected:
  const Key key_ = Key::draw();
  const Door door_{{"192.0.2.7", "flier", "2001:db8::7"}, key_};
};

TEST_F(DoorTest, AcceptsTheLoopbackAndGivenNamesWithAnyPort) {
  for (const char* host : {"127.0.0.1:8080", "localhost:8080", "[::1]:8080", "localhost:9000", "127.0.0.1", "[::1]",
                           "192.0.2.7:8080", "FLIER:8080", "[2001:db8::7]:80"}) {
    EXPECT_TRUE(door_.knows_host(host)) << host;
  }
  for (const char* host :
       {"", ":8080", "[]:8080", "127.0.0.1:80800", "127.0.0.1:", "example.org:8080", "127.0.0.1:8080.example.org",
        "127.0.0.2:8080", "localhost:8080 ", "LOCALHOST:8080@x", "::1:8080", "::1", "[127.0.0.1]:8080",
        "localhost.:8080", "192.0.2.70", "flier.example.org", " localhost", "localhost\t:80", "2001:db8::7"}) {
    EXPECT_FALSE(door_.knows_host(host)) << host;
  }
}

TEST_F(DoorTest, OnlyPagesOfTheSameHostAreItsOwn) {
  EXPECT_TRUE(door_.is_own_origin("http://localhost:8080", "localhost:8080"));
  for (const char* origin : {"", "null", "http://localhost", "https://localhost:8080", "http://127.0.0.1:8080",
                             "http://localhost:8081", "http://localhost:8080.example.org"}) {
    EXPECT_FALSE(door_.is_own_origin(origin, "localhost:8080")) << origin;
  }
}

TEST_F(DoorTest, OpensOnlyForItsOwnCookie) {
  const std::string host = "localhost:8080", cookie = door_.cookie(host), pair = cookie.substr(0, cookie.find(';'));
  EXPECT_TRUE(door_.opens(pair, host));
  EXPECT_TRUE(door_.opens("a=b; " + pair + "; c=d", host));
  EXPECT_FALSE(door_.opens("", host));
  EXPECT_FALSE(door_.opens("skein_8080=", host));
  EXPECT_FALSE(door_.opens("skein_8081=" + key_.text(), host)) << "this cookie is that of a page at another port";
  EXPECT_FALSE(door_.opens(pair, "localhost:8081"));
  EXPECT_FALSE(door_.opens("x" + pair, host));
  EXPECT_NE(cookie.find("HttpOnly"), std::string::npos);
  EXPECT_NE(cookie.find("SameSite=Strict"), std::string::npos);
}

TEST(FormFields, AreFoundByTheirNames) {
  EXPECT_EQ(form_field("a=1&key=2&b=3", "key"), "2");
  EXPECT_EQ(form_field("key=", "key"), "");
  EXPECT_EQ(form_field("keys=1&xkey=2", "key"), "");
  EXPECT_EQ(form_field("", "key"), "");
}

}  // namespace
}  // namespace skein::view
