// What a cell sees, on a plan: objects as they lie from above, coloured by how much of each is visible.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "export/export.h"
#include "export/place.h"
#include "export/plan_page.h"
#include "export/top_mask.h"
#include "scene/markup.h"
#include "scene/text.h"
#include "scene/writers/ordered_output.h"

namespace veduta {
namespace {

using city::OrderedOutput;

constexpr double longest_px = 960, squares_per_px = 4;

bool is_ground(Kind kind) {
  return kind == Kind::terrain || kind == Kind::road || kind == Kind::water;
}

bool beside(const Box& a, const Box& b) {
  return a.empty() || a.lower.x > b.upper.x || a.upper.x < b.lower.x || a.lower.y > b.upper.y ||
         a.upper.y < b.lower.y;
}

/// The cell and all that is visible from it, with a rim, and no strip: at least half as wide as long.
Box window_of(const PvsIndex& index, uint32_t cell, const PvsRow& row) {
  Box window = index.cells[cell];
  for (const PvsEntry& entry : row) window.extend(index.bounds[entry.object]);
  const glm::vec3 extent = window.upper - window.lower, of_cell = 2.0f * index.cells[cell].half_extent();
  const float longest_m = std::max(extent.x, extent.y);
  const float rim_m = std::max({0.03f * longest_m, of_cell.x, of_cell.y, 1e-3f});
  for (int axis = 0; axis < 2; ++axis) {
    const float more_m = rim_m + std::max(0.0f, 0.25f * longest_m - 0.5f * extent[axis]);
    window.lower[axis] -= more_m, window.upper[axis] += more_m;
  }
  return window;
}

PlanGrid grid_of(const Box& window) {
  const double width_m = double(window.upper.x) - window.lower.x,
               height_m = double(window.upper.y) - window.lower.y;
  PlanGrid grid{window.lower.x, window.upper.y, std::max(width_m, height_m) / (longest_px * squares_per_px),
                1, 1};
  grid.columns = std::max(1, static_cast<int>(std::ceil(width_m / grid.step_m)));
  grid.rows = std::max(1, static_cast<int>(std::ceil(height_m / grid.step_m)));
  return grid;
}

class Plan {
 public:
  Plan(const PvsStream& stream, uint32_t cell)
      : stream_(stream),
        index_(stream.index()),
        cell_(cell),
        row_(stream.read_row(index_.cell_row[cell])),
        window_(window_of(index_, cell, row_)),
        grid_(grid_of(window_)) {}

  /// Objects are read one after the other; what is kept of each is its outline, to the picture's accuracy.
  void draw_objects() {
    auto entry = row_.begin();
    for (uint32_t object = 0; object < index_.objects.size(); ++object) {
      while (entry != row_.end() && entry->object < object) ++entry;
      if (!beside(index_.bounds[object], window_))
        draw(object, entry != row_.end() && entry->object == object ? &*entry : nullptr);
    }
  }

  Exported write(const std::filesystem::path& out) const {
    OrderedOutput output(out);
    output.write(page().begin());
    output.write(fmt::format("<g class=\"map\" transform=\"scale({})\">\n", 1 / squares_per_px));
    for (const std::string& layer : layers_) output.write(layer);
    output.write("</g>\n");
    output.write(cell_mark());
    output.write(page().end());
    output.close();
    return {1, row_.size(), 0, output.bytes()};
  }

 private:
  enum Layer : size_t { hidden_ground, visible_ground, hidden, visible };

  void draw(uint32_t object, const PvsEntry* entry) {
    TopMask mask(grid_, index_.bounds[object]);
    const Scene scene = stream_.read_objects(object, object + 1).scene;
    visit_triangles(scene, 0, [&](uint64_t, const std::array<glm::vec3, 3>& corners) { mask.add(corners); });
    std::string way;
    for (const PlanRing& ring : mask.outlines()) {
      way += fmt::format("M{} {}", ring[0].x, ring[0].y);
      for (size_t i = 1; i < ring.size(); ++i)
        way += fmt::format("l{} {}", ring[i].x - ring[i - 1].x, ring[i].y - ring[i - 1].y);
      way += "z";
    }
    if (way.empty()) return;
    const Object& named = index_.objects[object];
    const double share = entry ? visible_share(entry->index, index_.slices[object]) : 0;
    const bool ground = is_ground(named.kind);
    layers_[(ground ? hidden_ground : hidden) + (entry ? 1 : 0)] +=
        fmt::format("<path class=\"{}{}\" d=\"{}\"><title>{} ({}): {}</title></path>\n", ground ? 'g' : 'o',
                    ground ? int(entry != nullptr) : share_class(share), way, escaped(named.name),
                    kind_name(named.kind), entry ? says(*entry, share) : "hidden");
  }

  std::string says(const PvsEntry& entry, double share) const {
    const SliceCounts& slices = index_.slices[entry.object];
    return fmt::format("x {}, y {}, z {} of {} x {} x {} slices, {:.0f} % of its blocks visible",
                       entry.index.x, entry.index.y, entry.index.z, slices.x, slices.y, slices.z,
                       100 * share);
  }

  /// A ring around it as well where it is too small to be found.
  std::string cell_mark() const {
    const Box& box = index_.cells[cell_];
    const glm::dvec2 north_west = grid_.place({box.lower.x, box.upper.y, 0}) / squares_per_px,
                     south_east = grid_.place({box.upper.x, box.lower.y, 0}) / squares_per_px,
                     middle = 0.5 * (north_west + south_east), size = south_east - north_west;
    std::string out = fmt::format(
        "<rect class=\"cell\" x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"><title>cell "
        "{}</title></rect>\n",
        north_west.x, north_west.y, size.x, size.y, cell_);
    if (std::max(size.x, size.y) < 14)
      out +=
          fmt::format("<circle class=\"ring\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"15\"/>\n", middle.x, middle.y);
    return out;
  }

  PlanPage page() const {
    PlanPage page;
    page.map_width_px = grid_.columns / squares_per_px;
    page.map_height_px = grid_.rows / squares_per_px;
    page.px_per_m = 1 / (squares_per_px * grid_.step_m);
    page.title =
        fmt::format("Cell {} sees {} of {} objects", cell_, count(row_.size()), count(index_.objects.size()));
    const glm::vec3 size = index_.cells[cell_].upper - index_.cells[cell_].lower;
    page.subtitle =
        fmt::format("{:.4g} x {:.4g} x {:.4g} m, {}; middle of the cell at {:.1f}, {:.1f}{}", size.x, size.y,
                    size.z, status_in_words(), index_.origin[0] + index_.cells[cell_].center().x,
                    index_.origin[1] + index_.cells[cell_].center().y,
                    index_.crs.empty() ? "" : " in " + printable(index_.crs, 60));
    if (index_.crs.empty()) page.upwards = "y";
    return page;
  }

  std::string status_in_words() const {
    const std::string name = status_name(index_.cell_status[cell_]);
    return name == "all_visible" ? "recorded all visible" : name;
  }

  const PvsStream& stream_;
  const PvsIndex& index_;
  const uint32_t cell_;
  const PvsRow row_;
  const Box window_;
  const PlanGrid grid_;
  std::array<std::string, 4> layers_;
};

}  // namespace

Exported write_plan(const PvsStream& stream, uint32_t cell, const std::filesystem::path& out) {
  Plan plan(stream, cell);
  plan.draw_objects();
  return plan.write(out);
}

}  // namespace veduta
