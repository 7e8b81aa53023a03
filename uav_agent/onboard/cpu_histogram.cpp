#include "uav_agent/onboard/cpu_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace skein::agent {

double CpuHistogram::end_s(std::size_t bucket) {
  return kFirstEndS * std::exp2(static_cast<double>(bucket) / kBucketsAnOctave);
}

void CpuHistogram::add(double cpu_s) {
  const double octaves = cpu_s > kFirstEndS ? std::log2(cpu_s / kFirstEndS) : 0.0;
  const auto bucket = static_cast<std::size_t>(std::ceil(octaves * kBucketsAnOctave));
  ++buckets_[std::min(bucket, kBuckets - 1)];
  ++count_;
  over_ += cpu_s > kFieldExchangeS;
  total_s_ += std::max(0.0, cpu_s);
  max_s_ = std::max(max_s_, cpu_s);
}

double CpuHistogram::quantile_s(double share) const {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
  std::uint64_t seen = 0;
  for (std::size_t bucket = 0; bucket + 1 < kBuckets; ++bucket) {
    seen += buckets_[bucket];
    if (seen >= wanted) return std::min(end_s(bucket), max_s_);
  }
  return max_s_;
}

}  // namespace skein::agent
