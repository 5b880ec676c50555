#include "export/plan_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/markup.h"

namespace veduta {
namespace {

constexpr double margin_px = 24, head_px = 64, foot_px = 92, least_width_px = 760;

constexpr const char* style = R"(<style>
text { font-family: sans-serif; font-size: 13px; fill: #222 }
.title { font-size: 17px; font-weight: bold }
.faint { fill: #666 }
.g0 { fill: #f6f6f4 } .g1 { fill: #e3ead6 }
.o0 { fill: #d4d4d4 } .o1 { fill: #fddcae } .o2 { fill: #fdbe85 } .o3 { fill: #f79646 } .o4 { fill: #e0661a } .o5 { fill: #a63603 }
.map path { stroke: #00000055; stroke-width: 1.2; stroke-linejoin: round; fill-rule: evenodd } .map .g0, .map .g1 { stroke: #0000000d }
.cell { fill: #1d6fe855; stroke: #0b49b3; stroke-width: 2 } .ring { fill: none; stroke: #0b49b3; stroke-width: 2.5 }
.line { stroke: #222; stroke-width: 1.5; fill: none }
</style>
)";

/// 1, 2 or 5 times a power of ten, at most `most`.
double round_length(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  return most >= 5 * power ? 5 * power : most >= 2 * power ? 2 * power : power;
}

std::string text_at(double x, double y, std::string_view text, std::string_view attributes = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}{}>{}</text>\n", x, y, attributes.empty() ? "" : " ",
                     attributes, escaped(text, 1000));
}

std::string swatch(double x, double y, std::string_view kind, std::string_view says) {
  return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"18\" height=\"14\" class=\"{}\"/>\n", x, y,
                     kind) +
         text_at(x + 24, y + 11.5, says);
}

std::string scale_bar(double right, double y, double px_per_m, double map_width_px) {
  const double length_m = round_length(0.2 * std::max(map_width_px, 400.0) / px_per_m);
  const double left = right - length_m * px_per_m;
  const std::string says =
      length_m >= 1000 ? fmt::format("{} km", length_m / 1000) : fmt::format("{} m", length_m);
  return fmt::format("<path class=\"line\" d=\"M{0:.1f} {2:.1f}v5H{1:.1f}v-5\"/>\n", left, right, y) +
         text_at(0.5 * (left + right), y - 3, says, "text-anchor=\"middle\"");
}

std::string north_arrow(double x, double y, std::string_view says) {
  return fmt::format("<path class=\"line\" d=\"M{0:.1f} {1:.1f}v-26m-5 8l5 -8l5 8\"/>\n", x, y) +
         text_at(x, y + 14, says, "text-anchor=\"middle\"");
}

}  // namespace

double visible_share(VisibilityIndex index, SliceCounts slices) {
  const auto along = [](int byte, int count) {
    return byte > 0 ? double(std::min(byte, count)) / count : double(std::max(count + byte, 0)) / count;
  };
  const double high = index.z > 0 ? double(std::max(slices.z - index.z + 1, 0)) / slices.z : 0;
  const double x = index.x != 0 ? along(index.x, slices.x) : 0,
               y = index.y != 0 ? along(index.y, slices.y) : 0;
  return 1 - (1 - high) * (1 - x) * (1 - y);
}

int share_class(double share) {
  if (share <= 0) return 0;
  return share >= 1 ? share_classes - 1 : 1 + static_cast<int>(std::min(std::ceil(4 * share) - 1, 3.0));
}

std::string PlanPage::begin() const {
  const double width = std::max(map_width_px, least_width_px) + 2 * margin_px;
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
             "height=\"{1:.0f}\">\n",
             width, map_height_px + head_px + foot_px) +
         style + "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" +
         text_at(margin_px, 28, title, "class=\"title\"") +
         text_at(margin_px, 50, subtitle, "class=\"faint\"") +
         fmt::format(
             "<clipPath id=\"map\"><rect width=\"{0:.1f}\" height=\"{1:.1f}\"/></clipPath>\n"
             "<g transform=\"translate({2} {3})\" clip-path=\"url(#map)\">\n"
             "<rect width=\"{0:.1f}\" height=\"{1:.1f}\" fill=\"#fcfcfb\"/>\n",
             map_width_px, map_height_px, margin_px, head_px);
}

std::string PlanPage::end() const {
  const double width = std::max(map_width_px, least_width_px) + margin_px;  // up to the right margin
  const double first_row = head_px + map_height_px + 18, second_row = first_row + 30;
  std::string out = fmt::format(
      "</g>\n<rect x=\"{}\" y=\"{}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#bbb\"/>\n",
      margin_px, head_px, map_width_px, map_height_px);
  const std::array<std::pair<const char*, const char*>, 6> objects{{{"o1", "up to 1/4 of its blocks visible"},
                                                                    {"o2", "up to 1/2"},
                                                                    {"o3", "up to 3/4"},
                                                                    {"o4", "more"},
                                                                    {"o5", "all"},
                                                                    {"o0", "hidden"}}};
  double x = margin_px;
  for (const auto& [kind, says] : objects) {
    out += swatch(x, first_row, kind, says);
    x += 24 + 18 + 6.6 * static_cast<double>(std::string_view(says).size());
  }
  out += swatch(margin_px, second_row, "g1", "ground, road, water: visible") +
         swatch(margin_px + 240, second_row, "g0", "hidden") +
         swatch(margin_px + 330, second_row, "cell", "the view-cell");
  out += scale_bar(width, second_row + 4, px_per_m, map_width_px);
  out += north_arrow(margin_px + map_width_px - 22, head_px + 46, upwards);
  return out + "</svg>\n";
}

}  // namespace veduta
