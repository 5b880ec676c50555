// A city of boxes, baked whole, with questions to ask.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "scene/error.h"
#include "tests/pvs/small_city.h"
#include "verify/verify.h"
#include "worker/baker.h"
#include "worker/preparation.h"

namespace veduta::test {

/// A city of boxes on a plane, written as OBJ, baked whole, with questions to ask.
class ToyCity {
 public:
  ToyCity() {
    settings_.scene.model = {(directory_ / "city.obj").string()};
    settings_.cells.size_m = 4;
    settings_.occlusion.resolution = 256, settings_.occlusion.subdivide = 2;
  }
  void add(const std::string& name, glm::dvec3 lower, glm::dvec3 upper) {
    text_ += "o " + name + "\n";
    for (int corner = 0; corner < 8; ++corner) {
      for (int axis = 0; axis < 3; ++axis) {
        text_ +=
            (axis == 0 ? "v " : " ") + std::to_string((corner >> axis & 1) == 0 ? lower[axis] : upper[axis]);
      }
      text_ += "\n";
    }
    for (const auto& side :
         {std::array{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 2, 6, 5}, {3, 7, 8, 4}, {1, 5, 7, 3}, {2, 4, 8, 6}}) {
      text_ += "f";
      for (const int corner : side) text_ += " " + std::to_string(vertices_ + corner);
      text_ += "\n";
    }
    vertices_ += 8;
  }

  void add_ground(double half_m) { add("ground", {-half_m, -half_m, -1}, {half_m, half_m, 0}); }

  Settings& settings() { return settings_; }
  void cells_within(double x0, double y0, double x1, double y1) {
    settings_.cells.region = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  }

  /// Bakes every cell. \return false when there is no EGL to bake with.
  bool bake() {
    write_bytes(directory_ / "city.obj", text_);
    const RunPaths run{directory_.path()};
    prepare_all(run, settings_);
    file_pvs_.city = read_city(run.city());
    file_pvs_.row_begin.push_back(0);
    try {
      Baker baker(file_pvs_.city, ClusteredOccluders::map(run.occluders()), settings_, "software");
      for (uint32_t cell = 0; cell < baker.cell_count(); ++cell) {
        CellRecord record;
        baker.bake(std::array{cell}, [&](const CellRecord& baked) { record = baked; });
        file_pvs_.cell_row.push_back(cell);
        file_pvs_.cell_status.push_back(record.status);
        file_pvs_.bake_us.push_back(record.bake_us);
        file_pvs_.overestimate.push_back(record.overestimate);
        file_pvs_.entries.insert(file_pvs_.entries.end(), record.row.begin(), record.row.end());
        file_pvs_.row_begin.push_back(file_pvs_.entries.size());
      }
    } catch (const Error& error) {
      if (error.status() == ExitStatus::usage) return false;
      throw;
    }
    file_pvs_.index_cells();
    return true;
  }

  const PvsFile& file() const { return file_pvs_; }

  /// What the row of the cell at a point (in the model's coordinates) says of an object; nothing() when it is
  /// not listed.
  VisibilityIndex seen_from(glm::dvec3 eye, const std::string& name) const {
    const auto& origin = file_pvs_.city.scene.origin;
    const int64_t cell = file_pvs_.find_cell(eye - glm::dvec3(origin[0], origin[1], origin[2]));
    if (cell < 0) throw std::out_of_range("no cell at the eye");
    for (const PvsEntry& entry : file_pvs_.row(static_cast<uint32_t>(cell))) {
      if (file_pvs_.city.scene.objects[entry.object].name == name) return entry.index;
    }
    return {};
  }
  bool sees(glm::dvec3 eye, const std::string& name) const { return !seen_from(eye, name).nothing(); }

  /// No ray of a thorough check meets a triangle that its row does not draw.
  void expect_verified() const {
    VerifyOptions options;
    options.rays_per_cell = 100'000;
    const VerifyReport report = verify(file_pvs_, options);
    EXPECT_TRUE(report.passed()) << describe(report, file_pvs_);
    EXPECT_GT(report.hits, 0u);
    // zoom does not look for a lower bound.
    for (const float bound : file_pvs_.overestimate)
      EXPECT_EQ(bound >= 1, settings_.occlusion.method == "panorama") << "certified: " << bound;
  }

 private:
  TemporaryDirectory directory_;
  std::string text_;
  int vertices_ = 0;
  Settings settings_;
  PvsFile file_pvs_;
};

}  // namespace veduta::test

#define BAKE_OR_SKIP(city) \
  if (!(city).bake()) GTEST_SKIP() << "no EGL device with OpenGL 4.3 here"
