#include "verify/cell_check.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <map>

#include "verify/directions.h"
#include "verify/eyes.h"
#include "verify/settle.h"
#include "verify/tightest_index.h"

namespace veduta {
namespace {

// The triangles that a row draws, [T].
std::vector<uint8_t> drawn_by(const PvsFile& file, uint32_t cell) {
  std::vector<uint8_t> drawn(file.city.scene.triangles.size(), 0);
  for (const PvsEntry& entry : file.row(cell)) {
    const Object& object = file.city.scene.objects[entry.object];
    for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t)
      drawn[t] = draws(entry.index, file.city.triangle_slices[t]);
  }
  return drawn;
}

// Shoots rays from one cell and keeps what they meet.
class Shooter {
 public:
  Shooter(const PvsFile& file, uint32_t cell, const RayScene& rays)
      : file_(file),
        cell_(cell),
        rays_(rays),
        drawn_(drawn_by(file, cell)),
        hidden_(file.city.scene, drawn_),
        unmet_(hidden_),
        seen_(drawn_.size(), 0) {}

  // A quarter all over the sphere, half at what the row does not draw, a quarter at what it draws and no ray
  // has met: the fewer of those, the tighter the over-estimate. Where there is nothing to aim at, all over
  // the sphere instead.
  void look(const glm::vec3& eye, uint64_t count, Random& random) {
    if (std::has_single_bit(++looks_)) unmet_ = Targets(file_.city.scene, met_or_undrawn());
    const uint64_t at_hidden = hidden_.empty() ? 0 : count / 2, at_unmet = unmet_.empty() ? 0 : count / 4;
    const uint64_t uniform = count - at_hidden - at_unmet;
    const uint64_t wrong = shoot(eye, sphere_directions(uniform, random));
    if (uniform > 0)
      worst_share_ = std::max(worst_share_, static_cast<double>(wrong) / static_cast<double>(uniform));
    uniform_ += uniform, uniform_wrong_ += wrong;
    shoot(eye, hidden_.directions(eye, at_hidden, random));
    shoot(eye, unmet_.directions(eye, at_unmet, random));
  }

  CellCheck result() const {
    CellCheck check;
    check.has_eye = true;
    check.rays = shot_, check.hits = met_, check.cleared = cleared_;
    check.false_share =
        uniform_ == 0 ? 0 : static_cast<double>(uniform_wrong_) / static_cast<double>(uniform_);
    check.worst_false_share = worst_share_;
    check.false_triangles = nearest_.size();
    for (const auto& [triangle, example] : nearest_) add_example(check.examples, example);
    check.false_objects = check.examples.size();
    count_objects(check);
    return check;
  }

 private:
  std::vector<uint8_t> met_or_undrawn() const {
    std::vector<uint8_t> result(drawn_.size());
    for (size_t t = 0; t < result.size(); ++t) result[t] = seen_[t] || !drawn_[t];
    return result;
  }

  // Returns how many of the rays meet what the row does not draw.
  uint64_t shoot(const glm::vec3& eye, const std::vector<glm::vec3>& directions) {
    hits_.resize(directions.size());
    rays_.first_hits(eye, directions, hits_);
    uint64_t wrong = 0;
    for (size_t i = 0; i < directions.size(); ++i) {
      if (hits_[i].triangle == Hit::none) continue;
      ++met_;
      if (drawn_[hits_[i].triangle])
        seen_[hits_[i].triangle] = 1;
      else
        wrong += settle(eye, directions[i], hits_[i]);
    }
    shot_ += directions.size();
    return wrong;
  }

  // Is a hit on an undrawn triangle what a viewer would see? A triangle that was settled once from this cell
  // stays so; settling each of a million hits on a forgotten house would take hours.
  bool settle(const glm::vec3& eye, const glm::vec3& direction, const Hit& hit) {
    if (nearest_.contains(hit.triangle)) return true;
    const auto candidates = rays_.triangles_near(eye, direction, hit.distance_m);
    const auto triangle = undrawn_met_first(file_.city.scene, eye, direction, candidates, drawn_);
    if (!triangle) {
      ++cleared_;
      return false;
    }
    seen_[*triangle] = 1;
    nearest_.try_emplace(*triangle, FalseInvisible{cell_, object_of(*triangle), *triangle, eye, direction,
                                                   eye + direction * hit.distance_m});
    return true;
  }

  uint32_t object_of(uint32_t triangle) const {
    const auto& objects = file_.city.scene.objects;
    const auto after =
        std::upper_bound(objects.begin(), objects.end(), triangle,
                         [](uint64_t t, const Object& object) { return t < object.triangle_end; });
    return static_cast<uint32_t>(after - objects.begin());
  }

  // `nearest_` is in order of triangles, so one object's examples follow each other.
  static void add_example(std::vector<FalseInvisible>& examples, const FalseInvisible& example) {
    if (examples.empty() || examples.back().object != example.object)
      examples.push_back(example);
    else if (glm::distance(example.eye, example.hit) <
             glm::distance(examples.back().eye, examples.back().hit))
      examples.back() = example;
  }

  void count_objects(CellCheck& check) const {
    for (const PvsEntry& entry : file_.row(cell_)) {
      const Object& object = file_.city.scene.objects[entry.object];
      ++check.pvs_objects;
      check.pvs_buildings += object.kind == Kind::building;
      check.whole_triangles += object.triangle_end - object.triangle_begin;
    }
    for (const Object& object : file_.city.scene.objects) {
      uint64_t seen = 0;
      for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t) {
        seen += seen_[t];
        check.pvs_triangles += drawn_[t];
      }
      check.seen_triangles += seen;
      check.seen_objects += seen > 0;
      check.seen_buildings += seen > 0 && object.kind == Kind::building;
      if (seen == 0) continue;
      const uint64_t count = object.triangle_end - object.triangle_begin;
      check.seen_whole_triangles += count;
      check.tightest_triangles += tightest_index({&file_.city.triangle_slices[object.triangle_begin], count},
                                                 {&seen_[object.triangle_begin], count})
                                      .drawn;
    }
  }

  const PvsFile& file_;
  uint32_t cell_;
  const RayScene& rays_;
  std::vector<uint8_t> drawn_;
  Targets hidden_, unmet_;
  uint32_t looks_ = 0;
  std::vector<uint8_t> seen_;
  std::vector<Hit> hits_;
  std::map<uint32_t, FalseInvisible>
      nearest_;  // of each triangle falsely invisible, the hit that was settled
  uint64_t shot_ = 0, met_ = 0, cleared_ = 0, uniform_ = 0, uniform_wrong_ = 0;
  double worst_share_ = 0;
};

}  // namespace

CellCheck check_cell(const PvsFile& file, uint32_t cell, const VerifyOptions& options, const RayScene& rays) {
  Random random(options.seed, cell);
  const auto eyes = eye_points(file.city.cells[cell], std::max(1u, options.eyes_per_cell),
                               file.city.navigation.free, rays, Random(random.bits()));
  if (eyes.empty()) return {};
  Shooter shooter(file, cell, rays);
  for (size_t i = 0; i < eyes.size(); ++i) {
    const uint64_t begin = options.rays_per_cell * i / eyes.size(),
                   end = options.rays_per_cell * (i + 1) / eyes.size();
    shooter.look(eyes[i], end - begin, random);
  }
  return shooter.result();
}

}  // namespace veduta
