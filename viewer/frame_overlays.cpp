#include "viewer/frame_overlays.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "viewer/cell_colours.h"

namespace veduta {
namespace {

constexpr glm::vec4 cell_green{0.05f, 0.8f, 0.1f, 1};
constexpr glm::vec4 chosen_yellow{1, 0.8f, 0.05f, 1};
constexpr glm::vec4 frustum_white{1, 1, 1, 0.9f};
constexpr size_t most_boxes = 1500;   // more are a wall of colour
constexpr float boxes_reach_m = 120;  // beside the eye

/// The window of the screen and the edges of the view through it, `reach_m` far.
std::vector<ColouredLine> frustum_lines(const Pose& pose, const Optics& optics, float reach_m) {
  const Axes a = axes(pose);
  const float scale = reach_m / optics.screen_distance_m;
  std::array<glm::vec3, 4> corner;
  for (size_t i = 0; i < 4; ++i) {
    const float x = (i == 1 || i == 2 ? 1.0f : -1.0f) * optics.half_width_m() * scale;
    const float y = (i >= 2 ? 1.0f : -1.0f) * optics.half_height_m() * scale;
    corner[i] = pose.position_m + reach_m * a.forward + x * a.right + y * a.up;
  }
  std::vector<ColouredLine> lines;
  for (size_t i = 0; i < 4; ++i) {
    lines.push_back({pose.position_m, corner[i], frustum_white});
    lines.push_back({corner[i], corner[(i + 1) % 4], frustum_white});
  }
  return lines;
}

std::vector<ColouredBox> cell_boxes(const PvsIndex& index, const ViewState& state, const glm::vec3& eye) {
  std::vector<ColouredBox> boxes;
  const CellScale scale = cell_scale(index, state.cells);
  if (scale.by == CellColour::off) return boxes;
  for (const uint32_t cell : cells_near(index, eye, boxes_reach_m, most_boxes)) {
    const glm::vec3 colour = cell_colour(index, scale, cell);
    // A face before the eye would tint all that it sees.
    const bool around = index.cells[cell].contains(eye);
    boxes.push_back({index.cells[cell], glm::vec4(colour, 1), glm::vec4(colour, around ? 0 : 0.25f)});
  }
  return boxes;
}

/// By the row of the cell, whatever of the PVS is used in the picture.
std::vector<MapColour> map_colours(const PvsIndex& index, const VisibleObjects& visible) {
  const auto standing = [&](size_t object) {
    const Kind kind = index.objects[object].kind;
    return kind == Kind::building || kind == Kind::bridge || kind == Kind::other;
  };
  std::vector<MapColour> colours(index.objects.size());
  for (size_t object = 0; object < colours.size(); ++object)
    colours[object] = !standing(object)    ? MapColour::ground
                      : visible.everything ? MapColour::complete
                                           : MapColour::invisible;
  for (const PvsEntry& entry : visible.entries) {
    MapColour& colour = colours[entry.object];
    if (colour == MapColour::ground) continue;
    if (entry.index.z == 1)
      colour = MapColour::complete;
    else if (colour == MapColour::invisible)
      colour = MapColour::partial;
  }
  return colours;
}

/// Lower right corner, or nearly all of the picture: x, y, width, height.
glm::ivec4 map_rectangle(MapShown shown, const glm::uvec2& picture) {
  const auto width = static_cast<int>(picture.x), height = static_cast<int>(picture.y);
  if (shown == MapShown::full) return {0, 0, width, height};
  const int edge = std::min(width, height) * 2 / 5, margin = height / 40;
  return {width - edge - margin, margin, edge, edge};
}

void draw_map(Painter& painter, const CommandLister& lister, const PvsIndex& index, const ViewState& state,
              const VisibleObjects& visible, const glm::uvec2& picture, std::vector<ColouredBox> boxes) {
  const Pose& from = state.frozen ? *state.frozen : state.pose;
  VisibleObjects all;
  all.everything = true;
  if (visible.cell >= 0)
    boxes.push_back({index.cells[static_cast<size_t>(visible.cell)], cell_green, cell_green});
  const MapView view{state.pose.position_m, state.map_width_m, 90};
  painter.draw_map(view, lister.list(all, {}), map_colours(index, visible), boxes,
                   frustum_lines(from, state.optics, 0.2f * state.map_width_m),
                   map_rectangle(state.map, picture));
}

}  // namespace

void draw_overlays(Painter& painter, const CommandLister& lister, const PvsIndex& index,
                   const ViewState& state, const VisibleObjects& visible, const glm::uvec2& picture) {
  const std::vector<ColouredBox> cells = cell_boxes(index, state, state.pose.position_m);
  std::vector<ColouredBox> boxes = cells;
  if (state.chosen) {
    Box box = index.bounds[*state.chosen];
    if (!box.empty()) boxes.push_back({box, chosen_yellow, {}});
  }
  if (state.frozen) {
    if (visible.cell >= 0)
      boxes.push_back({index.cells[static_cast<size_t>(visible.cell)], cell_green,
                       glm::vec4(glm::vec3(cell_green), 0.3f)});
    painter.draw_lines(frustum_lines(*state.frozen, state.optics, 60));
  }
  if (!boxes.empty()) painter.draw_boxes(boxes);
  if (state.map != MapShown::off) draw_map(painter, lister, index, state, visible, picture, cells);
}

}  // namespace veduta
