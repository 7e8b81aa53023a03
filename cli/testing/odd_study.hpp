// For tests: studies drawn at random, with flights that failed and tables that are missing.
#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "cli/study/figures.hpp"

namespace skein::cli {

/// Names that break HTML, TeX, CSV or SVG into which they are written unescaped.
inline const std::vector<std::string> kOddPlanners = {"kios",
                                                      "exec:./a <b> && 'c' \"d\"",
                                                      "50%_{$x$}\\end{tabular}",
                                                      "patrol:a=1,b=2",
                                                      "~^#&|--[*]`",
                                                      "\xff\xfe",
                                                      "漢字",
                                                      "a\nb",
                                                      "]]>",
                                                      "</style>"};

inline Study odd_study(std::mt19937& random, bool contest) {
  const auto below = [&](std::size_t limit) { return static_cast<std::size_t>(random() % limit); };
  Study study{contest, Rank::median,       {},           {}, {}, {}, "./skein contest --planner 'a & b'",
              "9.8.7", "0123456789abcdef", "cyclonedds", 2};
  for (std::size_t i = 0, n = 1 + below(4); i < n; ++i) study.planners.push_back(kOddPlanners[(i * 3 + below(3)) % 10]);
  for (std::size_t i = 0, n = 1 + below(3); i < n; ++i) {
    study.scenarios.push_back(std::vector<std::string>{"towers", "a/x<y>.yaml", "b/x<y>.yaml"}[i]);
  }
  for (std::size_t i = 0, n = 1 + below(9); i < n; ++i) study.seeds.push_back(1 + i);
  for (const std::uint64_t seed : study.seeds) {
    for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
      for (std::size_t p = 0; p < study.planners.size(); ++p) {
        FlightEntry flight{p, s, seed, {}, FlightFigures{}, ""};
        FlightFigures& figures = *flight.figures;
        figures.score = static_cast<double>(below(20'000)) / 10.0;
        figures.points_detected = static_cast<int>(below(3000));
        figures.points_total = 3000;
        figures.collisions = static_cast<int>(below(3));
        figures.distance_m = static_cast<double>(below(9000));
        if (below(4) > 0) {
          figures.attainable = 2500.0;
          figures.attainable_percent = figures.score / 25.0;
        }
        flight.tables = FlightTables{};
        FlightTables& tables = *flight.tables;
        tables.end_s = 100.0 + static_cast<double>(below(50));
        double score = 0.0, time_s = 0.0;
        for (std::size_t i = below(30); i > 0; --i) {
          tables.scores.push_back({time_s, score, 0.0});
          time_s += static_cast<double>(below(50)) / 10.0;
          score += (figures.score - score) * 0.3;
        }
        for (std::size_t uav = 0, uavs = below(4); uav < uavs; ++uav) {
          figures.uavs.push_back({"uav<" + std::to_string(uav) + ">", uav == 0 ? "explorer" : "photographer",
                                  static_cast<double>(below(500)), static_cast<double>(below(500)), std::nullopt,
                                  static_cast<double>(below(99))});
          report::Latency latency;
          for (std::size_t i = below(9); i > 0; --i)
            latency.delays_s.push_back(static_cast<double>(below(900)) / 100.0);
          std::sort(latency.delays_s.begin(), latency.delays_s.end());
          latency.never = below(4);
          tables.latencies.push_back(std::move(latency));
        }
        if (below(3) > 0) flight.page = "flights/s" + std::to_string(s) + "/p&" + std::to_string(p) + "/report.html";
        if (below(6) == 0) flight.tables.reset();
        if (below(8) == 0) flight.problem = "skein run ended with <signal> 9";
        if (below(9) == 0) flight.figures.reset();
        study.flights.push_back(std::move(flight));
      }
    }
  }
  return study;
}

}  // namespace skein::cli
