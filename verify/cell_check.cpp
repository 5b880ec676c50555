#include "verify/cell_check.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <map>
#include <set>

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
  Shooter(const PvsFile& file, uint32_t cell, const RayScene& rays, double narrow_gap_limit_m)
      : file_(file),
        cell_(cell),
        rays_(rays),
        narrow_gap_limit_m_(narrow_gap_limit_m),
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
    const Missed missed = shoot(eye, sphere_directions(uniform, random));
    uniform_ += uniform;
    wrong_.add(missed.wrong, uniform), narrow_.add(missed.narrow, uniform);
    shoot(eye, hidden_.directions(eye, at_hidden, random));
    shoot(eye, unmet_.directions(eye, at_unmet, random));
  }

  CellCheck result() const {
    CellCheck check;
    check.has_eye = true;
    check.rays = shot_, check.hits = met_, check.cleared = cleared_;
    check.wrong = wrong_.sum(uniform_, {}), check.narrow = narrow_.sum(uniform_, wrong_.triangles);
    count_objects(check);
    return check;
  }

 private:
  // Rays that met what the row does not draw.
  struct Missed {
    uint64_t wrong = 0, narrow = 0;
  };

  // What was seen and is not drawn, in either way.
  struct Tally {
    std::map<uint32_t, FalseInvisible> triangles;  // the hit that was settled
    uint64_t uniform = 0;                          // rays of those all over the sphere
    double worst_share = 0;

    void add(uint64_t rays, uint64_t of) {
      uniform += rays;
      if (of > 0) worst_share = std::max(worst_share, static_cast<double>(rays) / static_cast<double>(of));
    }

    // Leaves out the objects of `others`.
    CellCheck::Missing sum(uint64_t of, const std::map<uint32_t, FalseInvisible>& others) const {
      CellCheck::Missing result;
      result.share = of == 0 ? 0 : static_cast<double>(uniform) / static_cast<double>(of);
      result.worst_share = worst_share;
      result.triangles = triangles.size();
      std::set<uint32_t> left_out;
      for (const auto& [triangle, example] : others) left_out.insert(example.object);
      for (const auto& [triangle, example] : triangles)
        if (!left_out.contains(example.object)) add_example(result.examples, example);
      result.objects = result.examples.size();
      return result;
    }
  };

  std::vector<uint8_t> met_or_undrawn() const {
    std::vector<uint8_t> result(drawn_.size());
    for (size_t t = 0; t < result.size(); ++t) result[t] = seen_[t] || !drawn_[t];
    return result;
  }

  Missed shoot(const glm::vec3& eye, const std::vector<glm::vec3>& directions) {
    hits_.resize(directions.size());
    rays_.first_hits(eye, directions, hits_);
    Missed missed;
    for (size_t i = 0; i < directions.size(); ++i) {
      if (hits_[i].triangle == Hit::none) continue;
      ++met_;
      if (drawn_[hits_[i].triangle])
        seen_[hits_[i].triangle] = 1;
      else
        settle(eye, directions[i], hits_[i], missed);
    }
    shot_ += directions.size();
    return missed;
  }

  // Is a hit on an undrawn triangle what a viewer would see, and is that a fault? A triangle that is a fault
  // from this cell stays one: settling each of a million hits on a forgotten house would take hours. One that
  // was seen through a narrow gap is looked at again at every hit.
  void settle(const glm::vec3& eye, const glm::vec3& direction, const Hit& hit, Missed& missed) {
    if (wrong_.triangles.contains(hit.triangle)) {
      ++missed.wrong;
      return;
    }
    const Scene& scene = file_.city.scene;
    const auto candidates = rays_.triangles_near(eye, direction, hit.distance_m);
    const auto triangle = undrawn_met_first(scene, eye, direction, candidates, drawn_);
    if (!triangle) {
      ++cleared_;
      return;
    }
    FalseInvisible example{
        cell_, object_of(*triangle), *triangle, eye, direction, eye + direction * hit.distance_m, {}};
    const auto gap = narrow_gap(scene, rays_, eye, direction, hit.distance_m, narrow_gap_limit_m_);
    if (gap && !wrong_.triangles.contains(*triangle)) {
      example.gap = *gap;
      ++missed.narrow;
      narrow_.triangles.try_emplace(*triangle, example);
      return;
    }
    ++missed.wrong;
    seen_[*triangle] = 1;
    wrong_.triangles.try_emplace(*triangle, example);
    narrow_.triangles.erase(*triangle);
  }

  uint32_t object_of(uint32_t triangle) const {
    const auto& objects = file_.city.scene.objects;
    const auto after =
        std::upper_bound(objects.begin(), objects.end(), triangle,
                         [](uint64_t t, const Object& object) { return t < object.triangle_end; });
    return static_cast<uint32_t>(after - objects.begin());
  }

  // Examples come in the order of triangles, so one object's examples follow each other.
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
  double narrow_gap_limit_m_;
  std::vector<uint8_t> drawn_;
  Targets hidden_, unmet_;
  uint32_t looks_ = 0;
  std::vector<uint8_t> seen_;
  std::vector<Hit> hits_;
  Tally wrong_, narrow_;  // no triangle is in both
  uint64_t shot_ = 0, met_ = 0, cleared_ = 0, uniform_ = 0;
};

}  // namespace

CellCheck check_cell(const PvsFile& file, uint32_t cell, const VerifyOptions& options, const RayScene& rays,
                     double narrow_gap_limit_m) {
  Random random(options.seed, cell);
  const auto eyes = eye_points(file.city.cells[cell], std::max(1u, options.eyes_per_cell),
                               file.city.navigation.free, rays, Random(random.bits()));
  if (eyes.empty()) return {};
  Shooter shooter(file, cell, rays, narrow_gap_limit_m);
  for (size_t i = 0; i < eyes.size(); ++i) {
    const uint64_t begin = options.rays_per_cell * i / eyes.size(),
                   end = options.rays_per_cell * (i + 1) / eyes.size();
    shooter.look(eyes[i], end - begin, random);
  }
  return shooter.result();
}

}  // namespace veduta
