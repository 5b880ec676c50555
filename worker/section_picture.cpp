#include "worker/section_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/vec2.hpp>
#include <utility>

#include "scene/atomic_file.h"
#include "scene/error.h"
#include "worker/section_outline.h"

namespace veduta {
namespace {

constexpr double width_px = 860, margin_px = 20, title_px = 34, legend_px = 92;

/// How things are drawn, in the order in which they lie upon each other.
constexpr const char* style = R"(<style>
text { font: 13px sans-serif; fill: #222 }
.title { font: bold 13px sans-serif }
.sealed { fill: #c9c5bd }
.surface { fill: #4a4640 }
.solid { fill: none; stroke: #8d877c; stroke-width: 0.5px }
.free { fill: none; stroke: #6fae74; stroke-width: 0.6px }
.cell { fill: #2f6fd0; fill-opacity: 0.10; stroke: #2f6fd0; stroke-width: 1.4px }
.near { fill: #e2711d; fill-opacity: 0.55; stroke: #a84c08; stroke-width: 1px }
.far { fill: none; stroke: #7a1fa2; stroke-width: 1.4px; stroke-dasharray: 5 3 }
.cut { fill: none; stroke: #222; stroke-width: 1px; stroke-dasharray: 12 4 2 4 }
.frame { fill: none; stroke: #222; stroke-width: 1px }
</style>
)";

/// One of the two drawings: a plane across axis `across`, seen with axis `right` to the right and `up`
/// upwards.
class Drawing {
 public:
  Drawing(const SectionContent& content, int right, int up, int across, glm::dvec2 corner_px, double px_per_m)
      : content_(content),
        right_(right),
        up_(up),
        across_(across),
        at_(content.cut[across]),
        corner_px_(corner_px),
        px_per_m_(px_per_m) {}

  double height_px() const {
    return px_per_m_ * (content_.square.upper[up_] - static_cast<double>(content_.square.lower[up_]));
  }

  std::string draw(const std::string& name) {
    const double width = px_per_m_ * (content_.square.upper[right_] - content_.square.lower[right_]);
    svg_ = fmt::format("<clipPath id=\"{0}\"><rect width=\"{1:.1f}\" height=\"{2:.1f}\"/></clipPath>\n", name,
                       width, height_px());
    svg_ += fmt::format("<g transform=\"translate({:.1f} {:.1f})\"><g clip-path=\"url(#{})\">\n",
                        corner_px_.x, corner_px_.y, name);
    draw_grids();
    draw_boxes("solid", content_.solid_leaves);
    draw_boxes("free", content_.free_leaves);
    draw_boxes("cell", content_.cells, across_ == 2);
    if (!content_.occluders.rings.empty()) {
      draw_occluders("near", content_.occluders.rings.front().occluders);
      draw_occluders("far", content_.occluders.rings.back().occluders);
    }
    const double line = y_px(content_.cut[up_]);
    svg_ += fmt::format("<path class=\"cut\" d=\"M0 {0:.1f}H{1:.1f}\"/></g>\n", line, width);
    svg_ +=
        fmt::format("<rect class=\"frame\" width=\"{:.1f}\" height=\"{:.1f}\"/></g>\n", width, height_px());
    return std::move(svg_);
  }

 private:
  double x_px(double right_m) const { return px_per_m_ * (right_m - content_.square.lower[right_]); }
  double y_px(double up_m) const { return px_per_m_ * (content_.square.upper[up_] - up_m); }

  /// The layer of the voxels that the plane cuts; runs of set ones become rectangles.
  template <typename Set>
  void draw_cubes(const char* name, const GridFrame& frame, const Set& set) {
    const auto plane = [&](int axis, int n) {
      return axis == 0 ? frame.x(n) : axis == 1 ? frame.y(n) : frame.z(n);
    };
    const auto index = [&](int axis, double m) {
      return axis == 0 ? frame.column_x(m) : axis == 1 ? frame.column_y(m) : frame.layer(m);
    };
    const Box& square = content_.square;
    int at[3];
    at[across_] = index(across_, at_);
    std::string path;
    const int end = index(right_, square.upper[right_]) + 1;
    for (at[up_] = index(up_, square.lower[up_]); at[up_] <= index(up_, square.upper[up_]); ++at[up_]) {
      int begin = end;
      for (at[right_] = index(right_, square.lower[right_]); at[right_] <= end; ++at[right_]) {
        const bool here = at[right_] < end && set(at[0], at[1], at[2]);
        if (here) begin = std::min(begin, at[right_]);
        if (here || begin == end) continue;
        const double x0 = x_px(plane(right_, begin)), x1 = x_px(plane(right_, at[right_])),
                     y0 = y_px(plane(up_, at[up_] + 1)), y1 = y_px(plane(up_, at[up_]));
        path += fmt::format("M{:.2f} {:.2f}H{:.2f}V{:.2f}H{:.2f}z", x0, y0, x1, y1, x0);
        begin = end;
      }
    }
    svg_ += fmt::format("<path class=\"{}\" shape-rendering=\"crispEdges\" d=\"{}\"/>\n", name, path);
  }

  void draw_grids() {
    const SeedRegion& region = content_.region;
    const BitGrid sealed = sealed_voxels(region);
    draw_cubes("sealed", region.frame(), [&](int i, int j, int k) { return sealed.get(i, j, k); });
    draw_cubes("surface", region.seed_frame(), [&](int x, int y, int z) {
      constexpr int n = seeds_per_voxel;
      const int i = x / n, j = y / n, k = z / n;
      return region.occupied->get(i, j, k) &&
             (region.touched.at(i, j, k) >> (x % n + n * (y % n) + n * n * (z % n)) & 1) != 0;
    });
  }

  /// Those that the plane cuts, or `all` of them.
  void draw_boxes(const char* name, const std::vector<Box>& boxes, bool all = false) {
    std::string path;
    for (const Box& box : boxes) {
      if (!all && (box.lower[across_] > at_ || box.upper[across_] < at_)) continue;
      path +=
          fmt::format("M{:.2f} {:.2f}H{:.2f}V{:.2f}H{:.2f}z", x_px(box.lower[right_]), y_px(box.lower[up_]),
                      x_px(box.upper[right_]), y_px(box.upper[up_]), x_px(box.lower[right_]));
    }
    svg_ += fmt::format("<path class=\"{}\" d=\"{}\"/>\n", name, path);
  }

  void draw_occluders(const char* name, const OccluderMesh& mesh) {
    std::string path;
    for (size_t body = 0; body < mesh.bodies(); ++body) {
      for (const std::vector<glm::vec3>& outline : cut_body(mesh, body, across_, at_)) {
        for (size_t n = 0; n < outline.size(); ++n)
          path += fmt::format("{}{:.2f} {:.2f}", n == 0 ? 'M' : 'L', x_px(outline[n][right_]),
                              y_px(outline[n][up_]));
        path += 'z';
      }
    }
    svg_ += fmt::format("<path class=\"{}\" d=\"{}\"/>\n", name, path);
  }

  const SectionContent& content_;
  int right_, up_, across_;
  float at_;
  glm::dvec2 corner_px_;
  double px_per_m_;
  std::string svg_;
};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

std::string draw_legend(const SectionContent& content, double top_px) {
  const auto& rings = content.occluders.rings;
  const auto ring_name = [](const char* which, const OccluderRing& ring) {
    return fmt::format("occluders, {} ring: h = {:.2f} m", which, ring.h_m);
  };
  std::vector<std::pair<const char*, std::string>> entries{{"surface", "seeds that a surface touches"},
                                                           {"sealed", "sealed space, in voxels"},
                                                           {"solid", "octree of surfaces"},
                                                           {"free", "octree of navigable space"},
                                                           {"cell", "view-cells"},
                                                           {"cut", "where the other drawing is cut"}};
  if (!rings.empty())
    entries.insert(entries.end(),
                   {{"near", ring_name("first", rings.front())}, {"far", ring_name("last", rings.back())}});
  std::string svg;
  for (size_t n = 0; n < entries.size(); ++n) {
    const double x = margin_px + static_cast<double>(n / 3) * 265,
                 y = top_px + static_cast<double>(n % 3) * 22;
    svg += fmt::format("<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"26\" height=\"13\"/>",
                       entries[n].first, x, y);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x + 34, y + 11,
                       escaped(entries[n].second));
  }
  return svg;
}

/// A round length of about a sixth of the width.
std::string draw_scale_bar(double px_per_m, double top_px) {
  const double about_m = width_px / 6 / px_per_m, power = std::pow(10, std::floor(std::log10(about_m)));
  const double length_m = about_m >= 5 * power ? 5 * power : about_m >= 2 * power ? 2 * power : power;
  const double right = margin_px + width_px, left = right - length_m * px_per_m;
  return fmt::format(
      "<path d=\"M{0:.1f} {1:.1f}v7H{2:.1f}v-7\" fill=\"none\" stroke=\"#222\" stroke-width=\"1.5\"/>"
      "<text x=\"{3:.1f}\" y=\"{1:.1f}\" text-anchor=\"end\">{4:g} m</text>\n",
      left, top_px, right, left - 8, length_m);
}

}  // namespace

std::string draw_section(const SectionContent& content) {
  const glm::vec3 size = content.square.upper - content.square.lower;
  const double px_per_m = width_px / size.x;
  const double plan_top = title_px + margin_px, section_top = plan_top + px_per_m * size.y + margin_px,
               legend_top = section_top + px_per_m * size.z + margin_px;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
      "{1:.0f}\">\n",
      width_px + 2 * margin_px, legend_top + legend_px);
  svg += style;
  svg += "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  svg += fmt::format("<text class=\"title\" x=\"{}\" y=\"{}\">{}</text>\n", margin_px, title_px,
                     escaped(content.title));
  svg += draw_scale_bar(px_per_m, legend_top + 50);
  svg += Drawing(content, 0, 1, 2, {margin_px, plan_top}, px_per_m).draw("plan");
  svg += Drawing(content, 0, 2, 1, {margin_px, section_top}, px_per_m).draw("section");
  return svg + draw_legend(content, legend_top) + "</svg>\n";
}

void write_section(const std::filesystem::path& file, const SectionContent& content) {
  write_atomically(file, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary);
    out << draw_section(content);
    out.close();
    if (!out)
      throw Error(ExitStatus::input_output,
                  file.string() + ": cannot be written; is there room, and the folder?");
  });
}

}  // namespace veduta
