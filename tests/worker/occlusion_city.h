// Cities of boxes and prisms, prepared for methods of occlusion, with questions to ask of their answers.
#pragma once

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <stdexcept>

#include "scene/error.h"
#include "tests/pvs/small_city.h"
#include "tests/worker/mesh.h"
#include "verify/eyes.h"
#include "worker/occlusion_method.h"
#include "worker/preparation.h"
#include "worker/three_bytes.h"

namespace veduta::test {

/// A city that is added up object by object and then prepared.
class OcclusionCity {
 public:
  OcclusionCity() {
    settings.cells.size_m = 4;
    settings.occlusion.resolution = 256, settings.occlusion.subdivide = 2;
    settings.occlusion.max_overestimate = 1;  // as tight as the smallest parts allow
  }

  void add(const std::string& name, glm::dvec3 lower, glm::dvec3 upper) {
    begin(name);
    add_box(lower, upper);
  }
  /// An object that boxes are added to.
  void begin(const std::string& name) { text_ += "o " + name + "\n"; }
  void add_box(glm::dvec3 lower, glm::dvec3 upper) {
    add_prism({{lower.x, lower.y}, {upper.x, lower.y}, {upper.x, upper.y}, {lower.x, upper.y}}, lower.z,
              upper.z);
  }
  /// A prism over a convex outline, counter-clockwise.
  void add_prism(const std::vector<glm::dvec2>& outline, double bottom, double top) {
    for (const double z : {bottom, top}) {
      for (const glm::dvec2& p : outline) add_vertex({p, z});
    }
    const int n = static_cast<int>(outline.size());
    const auto corner = [&](int i) { return " " + std::to_string(i - 2 * n); };
    std::string lid = "f", floor = "f";
    for (int i = 0; i < n; ++i) {
      const int next = (i + 1) % n;
      text_ += "f" + corner(i) + corner(next) + corner(n + next) + corner(n + i) + "\n";
      lid += corner(n + i), floor += corner(n - 1 - i);
    }
    text_ += lid + "\n" + floor + "\n";
  }
  /// The objects of a scene that was made in memory.
  void add_scene(const Scene& scene) {
    for (size_t o = 0; o < scene.objects.size(); ++o) {
      begin(scene.objects[o].name);
      visit_triangles(scene, o, [&](uint64_t, const std::array<glm::vec3, 3>& corners) {
        for (const glm::vec3& c : corners) add_vertex(c);
        text_ += "f -3 -2 -1\n";
      });
    }
  }
  void add_ground(double half_m) { add("ground", {-half_m, -half_m, -1}, {half_m, half_m, 0}); }
  void cells_within(double x0, double y0, double x1, double y1) {
    for (const auto& [x, y] : {std::pair{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}})
      settings.cells.region.push_back({place({x, y}).x, place({x, y}).y});
  }

  void prepare() {
    if (settings.scene.model.empty()) {
      write_bytes(directory_ / "city.obj", text_);
      settings.scene.model = {(directory_ / "city.obj").string()};
    }
    const RunPaths run{directory_.path()};
    prepare_all(run, settings);
    file_.city = read_city(run.city());
    file_.index_cells();
    windows_ = ClusteredOccluders::map(run.occluders()).meshes();
    finish();
  }

  /// After prepare: small boxes behind the corners of the model as seen from the cells, some hidden and some
  /// not by a little: what is wrong by a little shows in them. They are to be seen, and hide nothing.
  void add_probes(size_t count, const std::vector<uint32_t>& cells, uint32_t seed) {
    test::Random random(seed);
    City& city = file_.city;
    const size_t corners = city.scene.vertices.size();
    Mesh probes;
    for (size_t n = 0; n < count; ++n) {
      const Box& cell = city.cells[cells[n % cells.size()]];
      const glm::vec3 eye = random.point(cell);
      const glm::vec3& corner =
          city.scene.vertices[static_cast<size_t>(random.integer(0, static_cast<int>(corners) - 1))];
      const auto beyond = static_cast<float>(random.real(1.02, 2));
      const glm::vec3 off = random.point({glm::vec3(-1), glm::vec3(1)}),
                      half = random.point({glm::vec3(0.002f), glm::vec3(0.3f)});
      const glm::vec3 middle = eye + beyond * (corner - eye) + off * off * off;
      if (glm::distance(middle, cell.center()) < 4 * settings.cells.size_m || middle.z < 0) continue;
      probes.object();
      probes.box({middle - half, middle + half});
    }
    const auto first = static_cast<uint32_t>(corners);
    const uint64_t triangles = city.scene.triangles.size();
    city.scene.vertices.insert(city.scene.vertices.end(), probes.scene.vertices.begin(),
                               probes.scene.vertices.end());
    for (const glm::uvec3& triangle : probes.scene.triangles)
      city.scene.triangles.push_back(triangle + first);
    city.scene.material.resize(city.scene.triangles.size());
    city.triangle_slices.resize(city.scene.triangles.size());
    for (const Object& o : probes.scene.objects) {
      city.scene.objects.push_back(
          {"probe_" + o.name, o.kind, o.triangle_begin + triangles, o.triangle_end + triangles});
      city.slices.push_back({1, 1, 1});
    }
    finish();
  }

  /// After prepare: from now on a cell has half as many parts along an edge, and half the pixels. \return the
  /// occluders for the parts that are no more.
  WindowOccluders drop_smallest_parts() {
    settings.occlusion.subdivide /= 2, settings.occlusion.resolution /= 2;
    WindowOccluders smallest = windows_.front();
    windows_.erase(windows_.begin());
    return smallest;
  }

  const City& city() const { return file_.city; }
  const PvsFile& file() const { return file_; }  ///< without rows
  const SliceBoxes& slices() const { return slices_; }
  const std::vector<WindowOccluders>& windows() const { return windows_; }
  OcclusionInput input() const { return {city(), slices_, windows_, settings}; }
  std::vector<uint32_t> all_cells() const {
    std::vector<uint32_t> cells(city().cells.size());
    for (uint32_t c = 0; c < cells.size(); ++c) cells[c] = c;
    return cells;
  }

  std::vector<glm::vec3> eyes(uint32_t cell, size_t count) const {
    return eye_points(city().cells[cell], count, city().navigation.free, *rays_, veduta::Random(cell));
  }

  /// The answer for the cell at a point, before that was placed.
  const CellOcclusion& at(const std::vector<CellOcclusion>& answers, const glm::dvec3& eye) const {
    const auto& o = city().scene.origin;
    const int64_t cell =
        file_.find_cell(glm::vec3(glm::dvec3(place(eye), eye.z) - glm::dvec3(o[0], o[1], o[2])));
    for (const CellOcclusion& answer : answers) {
      if (answer.cell == cell) return answer;
    }
    throw std::out_of_range("no answer for a cell at the eye");
  }
  uint32_t object(const std::string& name) const {
    for (uint32_t o = 0; o < city().scene.objects.size(); ++o) {
      if (city().scene.objects[o].name == name) return o;
    }
    throw std::out_of_range("no object " + name);
  }
  /// What a row says of an object.
  VisibilityIndex row_entry(const CellOcclusion& answer, uint32_t object) const {
    if (answer.occlusion.visible[object] == 0) return {};
    return counts_->choose(object, &answer.occlusion.occluded[slices_.object_slice_begin[object]]);
  }
  bool hides(const CellOcclusion& answer, const std::string& name) const {
    return row_entry(answer, object(name)).nothing();
  }

  Settings settings;
  /// Where a point comes to lie, of all that is added after this was set.
  std::function<glm::dvec2(const glm::dvec2&)> place = [](const glm::dvec2& p) { return p; };

 private:
  void add_vertex(const glm::dvec3& p) {
    const glm::dvec2 placed = place(p);
    text_ +=
        "v " + std::to_string(placed.x) + " " + std::to_string(placed.y) + " " + std::to_string(p.z) + "\n";
  }
  void finish() {
    slices_ = slice_boxes(city().scene, city().slices, city().triangle_slices);
    counts_.emplace(city().scene, city().slices, city().triangle_slices);
    rays_.emplace(city().scene);
  }

  TemporaryDirectory directory_;
  std::string text_;
  PvsFile file_;
  std::vector<WindowOccluders> windows_;
  SliceBoxes slices_;
  std::optional<TriangleCounts> counts_;
  std::optional<RayScene> rays_;
};

}  // namespace veduta::test
