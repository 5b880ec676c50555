#include "worker/cell_windows.h"

#include <gtest/gtest.h>

namespace veduta {
namespace {

Settings settings_of(const char* mode, int largest, int subdivide) {
  Settings settings;
  settings.navigation.mode = mode;
  settings.cells.size_m = 10, settings.cells.height_m = 2, settings.cells.largest = largest;
  settings.occlusion.subdivide = subdivide;
  settings.stereo.eye_margin_m = 0.5;
  return settings;
}

TEST(CellWindows, PartsAndCellsOfEverySizeClass) {
  EXPECT_EQ(size_classes(settings_of("walk", 8, 2)), 1);
  EXPECT_EQ(size_classes(settings_of("fly", 1, 2)), 1);
  EXPECT_EQ(size_classes(settings_of("fly", 8, 2)), 4);
  EXPECT_EQ(window_half_extents(settings_of("walk", 8, 1)), (std::vector<glm::dvec3>{{5.501, 5.501, 1.501}}));
  EXPECT_EQ(window_half_extents(settings_of("walk", 8, 2)),
            (std::vector<glm::dvec3>{{3.001, 3.001, 1.501}, {5.501, 5.501, 1.501}}));
  EXPECT_EQ(window_half_extents(settings_of("walk", 8, 4)),
            (std::vector<glm::dvec3>{{1.751, 1.751, 1.501}, {3.001, 3.001, 1.501}, {5.501, 5.501, 1.501}}));
  EXPECT_EQ(
      window_half_extents(settings_of("fly", 2, 2)),
      (std::vector<glm::dvec3>{
          {3.001, 3.001, 1.501}, {5.501, 5.501, 1.501}, {5.501, 5.501, 2.501}, {10.501, 10.501, 2.501}}));
}

TEST(CellWindows, HoldTheCellsOfTheirClass) {
  const Settings settings = settings_of("fly", 4, 2);
  for (int size_class = 0; size_class < 3; ++size_class) {
    // Far from the origin, bounds are rounded.
    const glm::vec3 lower(12345.678f, -9876.543f, 12.3f);
    const auto edge = static_cast<float>(10 << size_class), height = static_cast<float>(2 << size_class);
    const Box cell{lower, lower + glm::vec3(edge, edge, height)};
    EXPECT_EQ(size_class_of(settings, cell), size_class);
    const glm::dvec3 half = 0.5 * (glm::dvec3(cell.upper) - glm::dvec3(cell.lower));
    const glm::dvec3 window = part_half_extent(settings, size_class, 1);
    for (int axis = 0; axis < 3; ++axis) EXPECT_LE(half[axis] + 0.5, window[axis]);
  }
}

}  // namespace
}  // namespace veduta
