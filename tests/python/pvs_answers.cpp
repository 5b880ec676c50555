// What the reader in C++ says of a file, as JSON for readers in other languages to be compared with.
// use: pvs_answers toy FILE     writes a city with slices, all kinds, shared rows, workers and a verification
//      pvs_answers ask FILE     prints every row, what it draws, and the cells of points
#include <fmt/format.h>

#include <glm/common.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "pvs/pvs_file.h"
#include "scene/error.h"
#include "scene/random.h"

namespace veduta {
namespace {

constexpr uint32_t toy_objects = 60, toy_cells = 50;

/// Slices that [lower, upper] touches, of `count` in [box_lower, box_upper].
std::pair<uint8_t, uint8_t> slices_of(float lower, float upper, float box_lower, float box_upper, int count) {
  const auto slice = [&](float at) {
    const float share = (at - box_lower) / (box_upper - box_lower);
    return static_cast<uint8_t>(
        1 + std::clamp(static_cast<int>(share * static_cast<float>(count)), 0, count - 1));
  };
  return {slice(lower), slice(upper)};
}

/// A box whose top and walls are cut along x into as many strips as it has x-slices.
void add_building(City& city, uint32_t number, const glm::vec3& lower, const glm::vec3& size, SliceCounts n) {
  Scene& scene = city.scene;
  const uint64_t begin = scene.triangles.size();
  const auto quad = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
    const auto v = static_cast<uint32_t>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), {a, b, c, d});
    for (const glm::uvec3 t : {glm::uvec3(v, v + 1, v + 2), glm::uvec3(v, v + 2, v + 3)}) {
      scene.triangles.push_back(t);
      scene.material.push_back(Material::wall);
      const glm::vec3 p = scene.vertices[t.x], q = scene.vertices[t.y], r = scene.vertices[t.z];
      const glm::vec3 least = glm::min(p, glm::min(q, r)), most = glm::max(p, glm::max(q, r)),
                      upper = lower + size;
      const auto [x0, x1] = slices_of(least.x, most.x, lower.x, upper.x, n.x);
      const auto [y0, y1] = slices_of(least.y, most.y, lower.y, upper.y, n.y);
      const auto [z0, z1] = slices_of(least.z, most.z, lower.z, upper.z, n.z);
      city.triangle_slices.push_back({x0, x1, y0, y1, z0, z1});
    }
  };
  const glm::vec3 y{0, size.y, 0}, z{0, 0, size.z}, step{size.x / static_cast<float>(n.x), 0, 0};
  for (int s = 0; s < n.x; ++s) {
    const glm::vec3 a = lower + static_cast<float>(s) * step, b = a + step;
    quad(a, b, b + z, a + z);
    quad(b + y, a + y, a + y + z, b + y + z);
    quad(a + z, b + z, b + y + z, a + y + z);
  }
  const glm::vec3 end{size.x, 0, 0};
  quad(lower + y, lower, lower + z, lower + y + z);
  quad(lower + end, lower + end + y, lower + end + y + z, lower + end + z);
  scene.objects.push_back({fmt::format("h\xc3\xa4user {}", number), static_cast<Kind>(number % 7), begin,
                           scene.triangles.size()});
  city.slices.push_back(n);
}

City toy_city() {
  City city;
  city.scene.origin = {78000.125, 458000.5, -2.25};
  city.scene.crs = "EPSG:7415";
  Random random(3);
  for (uint32_t i = 0; i + 1 < toy_objects; ++i) {
    const glm::vec3 lower{20.0f * static_cast<float>(i % 10), 15.0f + 20.0f * static_cast<float>(i / 10), 0};
    const glm::vec3 size{8 + 8 * random.unit(), 6 + 6 * random.unit(), 3 + 20 * random.unit()};
    const auto count = [&] { return static_cast<uint8_t>(1 + random.below(6)); };
    add_building(city, i, lower, size, {count(), count(), count()});
  }
  const uint64_t end = city.scene.triangles.size();
  city.scene.objects.push_back({"empty", Kind::other, end, end});
  city.slices.push_back({1, 1, 1});
  city.scene.parts.push_back({"annex", 0, 0, 2});
  for (uint32_t c = 0; c < toy_cells; ++c) {
    const glm::vec3 lower{10.0f * static_cast<float>(c % 10), -50.0f + 10.0f * static_cast<float>(c / 10), 1};
    city.cells.push_back({lower, lower + glm::vec3(10, 10, 2)});
  }
  city.navigation.free = {{-1, -2, -3}, 0.5f, 3, {{0, 0, 0}}, {0x9, 0x5}, {1, 0}};
  city.navigation.surfaces = {{-1, -2, -3},        0.5f,     2, {{7, 0, -2}, {-1, 3, 0}},
                              {0x1, 0x81, 0x5550}, {0, 2, 0}};
  city.navigation.ground = {-1.5f, 2.5f, 2.0f, 3, 2, {0, 1, 2, 3, 4, NAN}};
  return city;
}

/// One that the slices allow: of z alone, or of x or y with or without z.
VisibilityIndex random_index(Random& random, SliceCounts n) {
  VisibilityIndex index;
  const auto side = [&](int count) {  // -(count - 1) to count, not 0
    const int value = static_cast<int>(random.below(2 * static_cast<uint64_t>(count) - 1)) - (count - 1);
    return static_cast<int8_t>(value >= 0 ? value + 1 : value);
  };
  const uint32_t which = random.below(3);
  if (which == 1) index.x = side(n.x);
  if (which == 2) index.y = side(n.y);
  if (which == 0 || random.below(2) == 0) index.z = static_cast<int8_t>(1 + random.below(n.z));
  return index;
}

void write_toy(const std::filesystem::path& path) {
  const City city = toy_city();
  const auto cells = [&](uint32_t c) {
    BakedCell cell{CellStatus::baked, 1000 + c, {}, 1.25f, c % 3 == 0 ? no_worker : c % 2};
    if (c == 7) cell.status = CellStatus::all_visible;
    if (c == 8) cell.status = CellStatus::coarse;
    Random random(c % 40);  // cells 40 to 49 share the rows of 0 to 9
    for (uint32_t o = 0; o < toy_objects; ++o)
      if (random.below(3) == 0) cell.row.push_back({o, random_index(random, city.slices[o])});
    return cell;
  };
  write_pvs(path, city, {"00112233", "[cells]\nsize = 10.0\n", "", false, true}, cells,
            {"one", "tw\xc3\xb6"});
  Verification v;
  v.when = "2026-01-31T12:00:00Z", v.program = "0.1.0";
  v.rays_per_cell = 2500, v.overestimate_objects = 1.25;
  v.cells = {{1, 2400, 1, 2, 3, 4, 1, 2, 0, 0.125f}, {3}};
  v.witnesses = {{1, 3, 60, {11, -5, 1.5f}, {0.6f, 0.8f, 0}, {62, 2, 3}, 0, 0}};
  v.witnesses[0].triangle = city.scene.objects[3].triangle_begin;
  store_verification(path, read_pvs(path), v);
}

nlohmann::json answers(const PvsFile& file) {
  const Scene& scene = file.city.scene;
  nlohmann::json out = {{"crs", scene.crs}, {"origin", scene.origin}, {"digest", file.content_digest}};
  for (const Object& object : scene.objects) out["names"].push_back(object.name);
  for (uint32_t c = 0; c < file.city.cells.size(); ++c) {
    nlohmann::json row = nlohmann::json::array();
    for (const PvsEntry& e : file.row(c)) {
      const Object& object = scene.objects[e.object];
      uint64_t drawn = 0;
      for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t)
        drawn += draws(e.index, file.city.triangle_slices[t]) ? 1 : 0;
      row.push_back(
          {e.object, e.index.x, e.index.y, e.index.z, drawn, object.triangle_end - object.triangle_begin});
    }
    out["rows"].push_back(row);
    out["statuses"].push_back(static_cast<int>(file.cell_status[c]));
    const Box& box = file.city.cells[c];
    for (const glm::vec3& at :
         {box.lower, box.upper, box.center(), glm::vec3(box.upper.x, box.center().y, box.lower.z),
          box.upper + glm::vec3(0.01f, 0, 0), box.lower - glm::vec3(0, 0, 100)})
      out["points"].push_back({at.x, at.y, at.z, file.find_cell(at)});
  }
  return out;
}

}  // namespace
}  // namespace veduta

int main(int count, char** words) {
  using namespace veduta;
  const std::string verb = count == 3 ? words[1] : "";
  try {
    if (verb == "toy") return write_toy(words[2]), 0;
    if (verb == "ask") return std::cout << answers(read_pvs(words[2])) << "\n", 0;
  } catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return static_cast<int>(error.status());
  }
  std::cerr << "use: pvs_answers toy|ask FILE\n";
  return 2;
}
