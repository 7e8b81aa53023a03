#include "cli/study/drawings.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "cli/study/spec.hpp"

namespace skein::cli {
namespace {

using namespace report;

/// An axis with round ends that contains 0 and all values.
Axis axis_with_zero(const std::vector<double>& values) {
  double low = 0.0, high = 0.0;
  for (const double value : values) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return nice_axis(low, high, 5);
}

/// Draws the figures of a study: one function for each FigureKind.
class StudyDrawing {
 public:
  StudyDrawing(const Study& study, const std::vector<std::string>& titles)
      : study_(study),
        titles_(titles),
        scenes_(folder_names(titles)),
        planners_(folder_names(study.planners)),
        score_axis_(score_axis(study)) {}

  StudyFigure totals() const {
    DotPlot plot{"Totals of the tests", "sum of scores over all scenes", {}, {}};
    std::vector<double> all;
    for (std::size_t p = 0; p < study_.planners.size(); ++p)
      plot.rows.push_back({study_.planners[p], colour_class(p), {}});
    for (const Standing& standing : standings(study_)) {
      for (std::size_t t = 0; t < standing.totals.size(); ++t) {
        if (!standing.totals[t]) continue;
        all.push_back(*standing.totals[t]);
        plot.rows[standing.planner].values.push_back(
            {*standing.totals[t], fmt::format("test {}: {}", study_.seeds[t], fixed(*standing.totals[t], 1))});
      }
    }
    plot.axis = axis_with_zero(all);
    return {FigureKind::total, {}, "totals.svg", "Total", "all scenes of a test", dot_plot_svg(plot)};
  }

  StudyFigure scores(std::size_t scenario) const {
    DotPlot plot{"Scores in " + titles_[scenario], "score", score_axis_, {}};
    for (std::size_t p = 0; p < study_.planners.size(); ++p) {
      PlotRow row{study_.planners[p], colour_class(p), {}};
      for (const FlightEntry* flight : study_.cell(p, scenario)) {
        row.values.push_back(
            {flight->figures->score, fmt::format("seed {}: {}", flight->seed, fixed(flight->figures->score, 1))});
      }
      plot.rows.push_back(std::move(row));
    }
    return {FigureKind::score, scenario, "score-" + scenes_[scenario] + ".svg",
            titles_[scenario], "",       dot_plot_svg(plot)};
  }

  /// nullopt: no flight has a score over time.
  std::optional<StudyFigure> curves(std::size_t scenario, const std::vector<double>& times_s) const {
    const CurvePlot plot{"Scores over time in " + titles_[scenario], score_axis_, times_s,
                         score_curves(study_, scenario, times_s), study_.planners};
    if (plot.curves.empty()) return std::nullopt;
    return StudyFigure{FigureKind::curves, scenario, "score-over-time-" + scenes_[scenario] + ".svg",
                       titles_[scenario],  "",       curve_plot_svg(plot)};
  }

  /// nullopt: no pair has a difference. @param axis  of single scenes; totals have their own axis.
  std::optional<StudyFigure> differences(const std::vector<PlannerPair>& pairs, std::optional<std::size_t> scenario,
                                         const Axis& axis) const {
    DotPlot plot{scenario ? "Differences in " + titles_[*scenario] : "Differences of totals",
                 scenario ? "difference of scores" : "difference of the sums over all scenes",
                 axis,
                 {},
                 false};
    bool any = false;
    for (const PlannerPair& pair : pairs) {
      if (pair.scenario != scenario) continue;
      PlotRow row{study_.planners[pair.first] + " − " + study_.planners[pair.second], "neutral", {}, pair.interval};
      for (const auto& [seed, difference] : pair.differences) {
        row.values.push_back({difference, fmt::format("seed {}: {}", seed, fixed(difference, 1))});
      }
      any = any || !row.values.empty();
      plot.rows.push_back(std::move(row));
    }
    if (!any) return std::nullopt;
    return StudyFigure{FigureKind::difference,
                       scenario,
                       scenario ? "difference-" + scenes_[*scenario] + ".svg" : "differences-of-totals.svg",
                       scenario ? titles_[*scenario] : "All scenes",
                       "",
                       dot_plot_svg(plot)};
  }

  void flights(std::size_t scenario, const StudyPictures& pictures, std::vector<StudyFigure>& figures) const {
    std::vector<const FlightPicture*> of_scene;
    for (const auto& [key, picture] : pictures) {
      if (key.first == scenario) of_scene.push_back(&picture);
    }
    if (of_scene.empty()) return;
    const PictureView view(of_scene);
    for (std::size_t p = 0; p < study_.planners.size(); ++p) {
      const auto found = pictures.find({scenario, p});
      const FlightEntry* best = study_.best(p, scenario);
      if (found == pictures.end() || best == nullptr) continue;
      const std::string words =
          fmt::format("{} points detected, {} score", best->figures->points_detected, fixed(best->figures->score, 0));
      figures.push_back(
          {FigureKind::flight, scenario, "flight-" + scenes_[scenario] + "-" + planners_[p] + ".svg",
           study_.planners[p] + ": " + words, fmt::format("{}, seed {}", titles_[scenario], best->seed),
           picture_svg(found->second, view, study_.planners[p] + " in " + titles_[scenario] + ": " + words), best->page,
           legend_of(found->second)});
    }
  }

 private:
  static std::vector<LegendEntry> legend_of(const FlightPicture& picture) {
    std::vector<LegendEntry> entries;
    for (std::size_t i = 0; i < picture.tracks.size(); ++i) {
      entries.push_back({fmt::format("track t{}{}{}", i % kTrackColours, i >= kTrackColours ? " again" : "",
                                     picture.tracks[i].explorer ? " explorer" : ""),
                         picture.tracks[i].uav});
    }
    const double step = (1.0 - kDetected) / kScoreColours;
    entries.push_back({"mark q0", "not detected", true});
    for (std::size_t i = 0; i < kScoreColours; ++i) {
      const double from = kDetected + step * static_cast<double>(i);
      entries.push_back(
          {fmt::format("mark q{}", i + 1), "score " + fixed(from, 1) + " to " + fixed(from + step, 1), true});
    }
    return entries;
  }

  const Study& study_;
  const std::vector<std::string>& titles_;
  std::vector<std::string> scenes_, planners_;  ///< as parts of file names
  Axis score_axis_;
};

/// Axes for the differences of scores: the first for the figures of single scenes, the second for that of totals.
std::pair<Axis, Axis> difference_axes(const std::vector<PlannerPair>& pairs) {
  std::vector<double> scenes, totals;
  for (const PlannerPair& pair : pairs) {
    std::vector<double>& all = pair.scenario ? scenes : totals;
    for (const double value : pair.values()) all.push_back(value);
  }
  return {axis_with_zero(scenes), axis_with_zero(totals)};
}

/// Appends numbers to names of files that would otherwise overwrite each other.
void make_files_unique(std::vector<StudyFigure>& figures) {
  std::vector<std::string> taken;
  for (StudyFigure& figure : figures) {
    const std::string stem = figure.file.substr(0, figure.file.size() - 4);
    for (int n = 2; std::ranges::find(taken, figure.file) != taken.end(); ++n) {
      figure.file = stem + "-" + std::to_string(n) + ".svg";
    }
    taken.push_back(figure.file);
  }
}

}  // namespace

Axis score_axis(const Study& study) {
  std::vector<double> scores;
  for (const FlightEntry& flight : study.flights) {
    if (flight.figures) scores.push_back(flight.figures->score);
  }
  return axis_with_zero(scores);
}

std::vector<StudyFigure> study_figures(const Study& study, const StudyPictures& pictures,
                                       const std::vector<PlannerPair>& pairs, const std::vector<std::string>& titles) {
  const StudyDrawing drawing(study, titles);
  std::vector<StudyFigure> figures;
  const auto add = [&](std::optional<StudyFigure> figure) {
    if (figure) figures.push_back(std::move(*figure));
  };
  if (study.contest) figures.push_back(drawing.totals());
  for (std::size_t s = 0; s < titles.size(); ++s) figures.push_back(drawing.scores(s));
  const std::vector<double> times_s = curve_times(study);
  for (std::size_t s = 0; s < titles.size(); ++s) add(drawing.curves(s, times_s));
  const auto [scene_axis, total_axis] = difference_axes(pairs);
  add(drawing.differences(pairs, std::nullopt, total_axis));
  for (std::size_t s = 0; s < titles.size(); ++s) add(drawing.differences(pairs, s, scene_axis));
  for (std::size_t s = 0; s < titles.size(); ++s) drawing.flights(s, pictures, figures);
  make_files_unique(figures);
  return figures;
}

}  // namespace skein::cli
