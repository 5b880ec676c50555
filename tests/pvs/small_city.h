// A city small enough to print, and directories that clean up after themselves.
#pragma once

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "pvs/pvs_file.h"
#include "scene/error.h"

namespace veduta::test {

class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "veduta-test-XXXXXX").string();
    if (!::mkdtemp(name.data())) std::abort();
    path_ = name;
  }
  ~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// `objects` triangles in a row along x, one an object, each cut into 4 x 1 x 2 slices; one object without
/// triangles at the end; a row of `cells` cells of 10 m.
inline City small_city(uint32_t objects = 5, uint32_t cells = 7) {
  City city;
  Scene& scene = city.scene;
  scene.origin = {78000.125, 458000.5, -2.25};
  scene.crs = "EPSG:7415";
  for (uint32_t i = 0; i < objects; ++i) {
    const float x = 20.0f * static_cast<float>(i);
    const uint32_t v = 3 * i;
    scene.vertices.insert(scene.vertices.end(), {{x, 0, 0}, {x + 8, 0, 0}, {x, 6, 12}});
    scene.triangles.push_back({v, v + 1, v + 2});
    scene.material.push_back(i % 2 ? Material::roof : Material::wall);
    scene.objects.push_back({"gebouw-\xc3\xa9-" + std::to_string(i), Kind::building, i, i + 1});
    city.slices.push_back({4, 1, 2});
    city.triangle_slices.push_back({1, 4, 1, 1, 1, 2});
  }
  scene.objects.push_back({"leeg", Kind::other, objects, objects});
  city.slices.push_back({1, 1, 1});
  if (objects > 0) scene.parts.push_back({"aanbouw", 0, 0, 1});
  for (uint32_t c = 0; c < cells; ++c) {
    const float x = 10.0f * static_cast<float>(c);
    city.cells.push_back({{x, -10, 1}, {x + 10, 0, 2}});
  }
  city.navigation.free.lower = {-1, -2, -3};
  city.navigation.free.leaf_size_m = 0.5f;
  city.navigation.free.depth = 3;
  city.navigation.free.roots = {{0, 0, 0}};
  city.navigation.free.states = {
      0x9, 0x5};  // root: child 0 navigable, child 1 mixed; there, children 0 and 1 navigable
  city.navigation.free.first_child = {1, 0};
  city.navigation.surfaces = {{-1, -2, -3},        0.5f,     2, {{7, 0, -2}, {-1, 3, 0}},
                              {0x1, 0x81, 0x5550}, {0, 2, 0}};
  city.navigation.ground = {-1.5f, 2.5f, 2.0f, 3, 2, {0, 1, 2, 3, 4, NAN}};
  return city;
}

/// A row that depends on c modulo 3: cells c and c + 3 share theirs. Over-estimates are 0, 1 1/8, 1 2/8, ...
inline BakedCell small_row(uint32_t c) {
  BakedCell cell{CellStatus::baked, 1000 + c, {}, c == 0 ? 0 : 1 + static_cast<float>(c) / 8};
  if (c % 3 >= 1) cell.row.push_back({0, completely_visible});
  if (c % 3 >= 2) cell.row.push_back({2, {-3, 0, 2}});
  return cell;
}

/// The same, baked by two in turn; nobody baked cell 4.
inline BakedCell small_row_of_worker(uint32_t c) {
  BakedCell cell = small_row(c);
  cell.worker = c == 4 ? no_worker : c % 2;
  return cell;
}
inline const std::vector<std::string> small_workers = {"0001-r0-w0", "werker-\xc3\xa9"};

inline PvsHeader small_header() {
  return {"00112233445566778899aabbccddeeff", "[scene]\nmodel = [\"a.json\"]\n", "llvmpipe", false, true};
}

/// The status of the Error that an action throws, done when it throws none.
inline ExitStatus status_of(const std::function<void()>& action, std::string* message = nullptr) {
  try {
    action();
  } catch (const Error& error) {
    if (message) *message = error.what();
    return error.status();
  }
  return ExitStatus::done;
}

}  // namespace veduta::test
