// The sections with drawings of the scene.
#include <spdlog/fmt/fmt.h>

#include "report/html.hpp"
#include "report/page_parts.hpp"

namespace skein::report {
namespace {

constexpr double kViewWidth = 480.0, kPlaceWidth = 360.0;

std::string entry(const std::string& colour, const std::string& text) {
  return "<li><span class=\"swatch\" style=\"background:var(--" + colour + ")\"></span>" + text + "</li>\n";
}

}  // namespace

std::string views_section(const RunPage& page) {
  std::string html = "<section id=\"views\"><h2>The flight</h2>\n";
  if (page.picture.points.empty() && page.picture.boxes.empty() && page.picture.tracks.empty()) {
    return html + absent("Nothing is known about the scene, and nothing flew.") + "</section>\n";
  }
  html += picture_legend(page.picture) + "<div class=\"panels views\">\n";
  struct View {
    Look look;
    const char *name, *live;
  };
  for (const View& view :
       {View{Look::aside, "From the south-south-east", "3d"}, View{Look::above, "Plan", ""},
        View{Look::from_south, "Elevation from the south", ""}, View{Look::from_east, "Elevation from the east", ""}}) {
    const PictureView window({&page.picture}, view.look, kViewWidth);
    html += fmt::format("<figure{}><figcaption>{}</figcaption>\n{}</figure>\n",
                        *view.live != '\0' ? fmt::format(" data-live=\"{}\"", view.live) : "", view.name,
                        picture_svg(page.picture, window, view.name));
  }
  return html + "</div></section>\n";
}

std::string places_section(const RunPage& page) {
  if (!page.run.causes_known) return "";
  std::string html = "<section id=\"places\"><h2>Where it was lost</h2>\n<ul class=\"legend\">";
  const BoxFigures& all = page.boxes.back();
  std::string panels;
  FlightPicture picture = page.picture;
  picture.tracks.clear();  // these drawings are about the structure only
  const PictureView view({&picture}, Look::above, kPlaceWidth);
  PictureStyle style{true, {}, false};
  panels += figure("All causes", "plan", picture_svg(picture, view, "Losses by cause, in plan", style));
  for (std::size_t i = 0; i < results::kCauses.size(); ++i) {
    std::size_t points = 0;
    for (const results::RunPoint& point : page.run.points) points += point.cause == i ? 1 : 0;
    if (points == 0) continue;
    style.only_cause = i;
    const std::string title(results::kCauses[i].title);
    html += entry(fmt::format("k{}", i), title);
    panels += figure(title, fmt::format("{} points, {} score", points, fixed(all.losses[i], 1)),
                     picture_svg(picture, view, "Losses in plan: " + title, style));
  }
  return html + entry("q0", "nothing lost") + "</ul>\n<div class=\"panels places\">\n" + panels + "</div></section>\n";
}

}  // namespace skein::report
