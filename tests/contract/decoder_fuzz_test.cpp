// Messages from the network are untrusted: randomly damaged messages of every type that Skein reads are decoded or
// refused, without a crash, and with an amount of memory that is bounded by their size. Run it also with sanitizers.
// SKEIN_LONG=1 draws many more.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "bus/typed.hpp"
#include "core/math/random_stream.hpp"
#include "idl/cdr.hpp"
#include "idl/conversions.hpp"
#include "idl/filled_message.hpp"
#include "tests/support/counted_memory.hpp"

namespace skein::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Limits of the memory for decoding: more than any type needs, for its largest elements and for vectors that grow.
constexpr std::size_t kMemoryPerByte = 512, kMemoryBase = 4096;

int rounds(int count) { return std::getenv("SKEIN_LONG") ? 50 * count : count; }

class Damage {
 public:
  explicit Damage(const std::string& type) : random_(1, "fuzz " + type, 0) {}

  /// Damages a payload in one to four places. Most payloads keep a valid encapsulation header, because a decoder reads
  /// nothing after an invalid one.
  Bytes apply(Bytes payload) {
    for (std::uint64_t n = random_.bits() % 4 + 1; n > 0; --n) injure(payload);
    if (payload.size() >= 4 && random_.bits() % 8 != 0) {
      payload[0] = 0;
      payload[1] = random_.bits() % 8 == 0 ? 0 : 1;  // sometimes big-endian
    }
    return payload;
  }

 private:
  std::size_t below(std::size_t limit) { return limit == 0 ? 0 : random_.bits() % limit; }

  void injure(Bytes& payload) {
    const std::size_t at = below(payload.size());
    const auto here = payload.begin() + static_cast<std::ptrdiff_t>(at);
    if (payload.empty()) return payload.push_back(0);
    switch (random_.bits() % 7) {
      case 0:
        *here ^= static_cast<std::uint8_t>(1U << below(8));
        return;
      case 1:
        *here = static_cast<std::uint8_t>(random_.bits());
        return;
      case 2:
        return set_word(payload, at);
      case 3:
        return payload.resize(at);
      case 4:
        payload.insert(here, below(64), static_cast<std::uint8_t>(random_.bits()));
        return;
      case 5:
        payload.erase(here, here + static_cast<std::ptrdiff_t>(below(std::min<std::size_t>(64, payload.size() - at))));
        return;
      default: {  // repeats a piece of it at the end
        const Bytes piece(here, payload.end());
        payload.insert(payload.end(), piece.begin(), piece.end());
        return;
      }
    }
  }

  /// Overwrites a word with a critical length; lengths are at multiples of four after the header.
  void set_word(Bytes& payload, std::size_t at) {
    const std::uint32_t lengths[] = {0,          1,          0xffffffff, 0x7fffffff,
                                     0x80000000, 0x10000000, 65536,      static_cast<std::uint32_t>(payload.size())};
    const std::uint32_t word = lengths[below(std::size(lengths))];
    at -= at % 4;
    if (at + 4 <= payload.size()) std::memcpy(payload.data() + at, &word, sizeof word);
  }

  RandomStream random_;
};

/// Decodes, and checks the memory that this needs. @returns whether it was a message.
template <class T>
bool decode_measured(const Bytes& payload, T& message) {
  const CountedMemory memory;
  const bool good = decode(payload, message);
  EXPECT_LE(memory.allocated(), kMemoryBase + kMemoryPerByte * payload.size()) << type_name<T>();
  return good;
}

/// Damages a payload `count` times. A payload that is still a message goes to `use`, and is damaged further.
template <class T, class Use>
void fuzz(const T& message, int count, Use use) {
  const Bytes whole = encode(message);
  Bytes payload = whole;
  Damage damage(type_name<T>());
  int good = 0;
  for (int round = 0; round < count; ++round) {
    const Bytes damaged = damage.apply(payload);
    T again;
    if (!decode_measured(damaged, again)) {
      payload = whole;
      continue;
    }
    ++good;
    use(again);
    const Bytes encoded = encode(again);
    T third;
    ASSERT_TRUE(decode(encoded, third)) << "a decoded message must survive encoding";
    payload = encoded.size() < 4 * whole.size() ? encoded : whole;
  }
  EXPECT_GT(good, 0) << type_name<T>() << ": no damaged payload could be decoded, so this tests nothing";
}

template <class T>
void truncate_everywhere(const T& message) {
  const Bytes payload = encode(message);
  for (std::size_t size = 0; size < payload.size(); ++size) {
    const Bytes truncated(payload.begin(), payload.begin() + static_cast<std::ptrdiff_t>(size));
    T again;
    if (decode_measured(truncated, again)) {
      EXPECT_GE(size + 3, payload.size()) << "only padding may be missing";
    }
  }
}

// ---- every type ------------------------------------------------------------------------------------------------

template <class T>
class EveryDecoder : public testing::Test {};
TYPED_TEST_SUITE(EveryDecoder, AllMessageTypes);

TYPED_TEST(EveryDecoder, SurvivesDamage) {
  truncate_everywhere(filled_message<TypeParam>());
  fuzz(filled_message<TypeParam>(), rounds(5000), [](const TypeParam&) {});
}

// ---- what programs do with decoded messages ----------------------------------------------------------------------

const std::vector<std::string> kFleet = {"jurong", "raffles"};

template <class Point>
msg::PointCloud2 cloud_of(std::size_t size) {
  return to_cloud(7, std::vector<Point>(size));
}

TEST(DamagedMessages, AreConvertedOrRefused) {
  fuzz(to_odometry(7, "jurong", {}), rounds(5000), [](const auto& m) { from_odometry(m); });
  fuzz(to_gimbal(7, "jurong", {}), rounds(5000), [](const auto& m) { from_gimbal(m); });
  fuzz(to_lidar_servo({}), rounds(5000), [](const auto& m) { from_lidar_servo(m); });
  fuzz(to_gimbal_command({}), rounds(5000), [](const auto& m) { from_gimbal_command(m); });
  fuzz(to_duration(600.0), rounds(5000), [](const auto& m) { from_duration(m); });
  fuzz(to_trajectory(7, {}), rounds(5000), [](const auto& m) { from_trajectory(m); });
  OrientedBox box;
  box.size = {1.0, 2.0, 3.0};
  fuzz(to_box_vertices(7, std::vector{box, box}), rounds(5000), [](const auto& m) { from_box_vertices(m); });
}

TEST(DamagedMessages, CloudsGiveWholePointsOrNone) {
  const auto read = [](const msg::PointCloud2& cloud) {
    const auto scan = from_cloud<ScanPoint>(cloud);
    const auto neighbours = from_cloud<NeighbourPoint>(cloud);
    const auto detections = from_cloud<DetectionPoint>(cloud);
    const std::size_t bytes = scan.size() * sizeof(ScanPoint) + neighbours.size() * sizeof(NeighbourPoint) +
                              detections.size() * sizeof(DetectionPoint);
    EXPECT_LE(bytes, cloud.data().size()) << "the cloud was read by more than one layout";
    for (const NeighbourPoint& point : neighbours) whole_number(point.node);
    for (const DetectionPoint& point : detections) whole_number(point.order);
  };
  fuzz(cloud_of<ScanPoint>(20), rounds(5000), read);
  fuzz(cloud_of<NeighbourPoint>(5), rounds(5000), read);
  fuzz(cloud_of<DetectionPoint>(9), rounds(5000), read);
}

TEST(DamagedMessages, CloudsWithOtherLayoutsAreRefused) {
  const auto refused = [](auto change) {
    msg::PointCloud2 cloud = cloud_of<ScanPoint>(3);
    change(cloud);
    return from_cloud<ScanPoint>(cloud).empty();
  };
  EXPECT_FALSE(refused([](auto&) {}));
  EXPECT_TRUE(refused([](auto& c) { c.point_step(12); }));
  EXPECT_TRUE(refused([](auto& c) { c.is_bigendian(true); }));
  EXPECT_TRUE(refused([](auto& c) { c.fields().pop_back(); }));
  EXPECT_TRUE(refused([](auto& c) { c.fields()[2].offset(0xfffffff0); }));
  EXPECT_TRUE(refused([](auto& c) { c.fields()[1].datatype(8); }));
  EXPECT_TRUE(refused([](auto& c) { c.data().resize(15); })) << "the data are shorter than a point";
}

TEST(DamagedMessages, FloatsThatAreNoWholeNumbersAreRefused) {
  EXPECT_EQ(whole_number(3.0F), 3U);
  EXPECT_EQ(whole_number(0.0F), 0U);
  for (const float wrong : {-1.0F, 0.5F, 1e30F, std::nanf(""), HUGE_VALF, -HUGE_VALF, 4294967296.0F}) {
    EXPECT_FALSE(whole_number(wrong).has_value()) << wrong;
  }
}

TEST(DamagedMessages, CapturesAndLedgersAreConvertedOrRefused) {
  CaptureReport report;
  report.points = {{1, 0.5F, 0.5F, 0.25F}, {7, 1.0F, 1.0F, 1.0F}};
  LedgerEntry entry;
  entry.capture = report;
  fuzz(to_message(report, kFleet), rounds(5000), [](const auto& m) { from_message(m, kFleet); });
  fuzz(to_message(entry, kFleet), rounds(5000), [](const auto& m) { from_message(m, kFleet); });
  msg::CaptureReports reports;
  reports.reports().resize(3, to_message(report, kFleet));
  fuzz(reports, rounds(5000), [](const auto& m) {
    for (const auto& r : m.reports()) from_message(r, kFleet);
  });
}

// ---- refused messages are counted and reported ---------------------------------------------------------------------

TEST(DamagedMessages, AreCountedAndReachNoHandler) {
  bus::Inbox inbox(0);
  std::size_t heard = 0, refused = 0;
  auto handler = bus::decoding<msg::CaptureReports>(inbox, "rt/captures", [&](const msg::CaptureReports&) { ++heard; });
  Damage damage("counted");
  const Bytes whole = encode(msg::CaptureReports());
  for (int round = 0; round < 1000; ++round) {
    const Bytes damaged = damage.apply(whole);
    msg::CaptureReports probe;
    refused += !decode(damaged, probe);
    handler({damaged, 1});
  }
  EXPECT_EQ(inbox.malformed(), refused);
  EXPECT_EQ(heard + refused, 1000U);
  EXPECT_GT(refused, 100U);
}

}  // namespace
}  // namespace skein::test
