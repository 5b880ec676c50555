#include "verify/cell_check.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "verify/borders.h"
#include "verify/directions.h"
#include "verify/eyes.h"
#include "verify/missing.h"
#include "verify/stopwatch.h"
#include "verify/tightest_index.h"

namespace veduta {
namespace {

constexpr size_t run = 16;              // rays from one eye before the next one's turn: a packet
constexpr uint64_t round_rays = 65536;  // at a time: they and their hits stay in the cache
constexpr uint64_t first_rays = 4096;   // about so many before the first look at what was met

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
  Shooter(const CheckedCity& city, uint32_t cell, const std::vector<glm::vec3>& eyes, uint64_t seed,
          const RaySink& sink)
      : city_(city),
        cell_(cell),
        sink_(sink),
        random_(seed),
        eyes_(eyes),
        order_(order_around(city.file.city.cells[cell].center(), city.centers)),
        drawn_(drawn_by(city.file, cell)),
        seen_(drawn_.size(), 0),
        seen_of_object_(city.centers.size(), 0),
        hidden_(city.file.city.scene, drawn_, order_),
        unmet_(hidden_),
        borders_(city.file.city.scene, city.object_of, city.file.city.cells[cell],
                 [this](const glm::vec3& eye) {
                   return viewer_can_be(eye, city_.file.city.navigation.free, city_.rays);
                 }),
        missing_(city, cell, drawn_, eyes.size()) {
    for (size_t i = eyes_.size(); i > 1; --i) std::swap(eyes_[i - 1], eyes_[random_.below(i)]);
  }

  // A quarter of the rays go all over the sphere, a quarter at what the row does not draw, an eighth at what
  // it draws and no ray has met, the rest past the borders of what was met. Where there is nothing to aim at,
  // all over the sphere instead.
  void shoot_until(uint64_t rays) {
    const uint64_t count = rays - std::min(rays, check_.rays);
    {
      const Timed timed(check_.times.directions_s);
      unmet_ = Targets(city_.file.city.scene, met_or_undrawn(), order_);
      borders_.take_up();
    }
    const uint64_t at_hidden = hidden_.empty() ? 0 : count / 8 * 2,
                   at_unmet = unmet_.empty() ? 0 : count / 16 * 2,
                   at_borders = borders_.empty() ? 0 : count * 3 / 8;
    const uint64_t rounds = (count + round_rays - 1) / round_rays;
    for (uint64_t i = 0; i < rounds; ++i) {
      const auto part = [&](uint64_t of) { return Strata{of * i / rounds, of * (i + 1) / rounds, of}; };
      aim(hidden_, part(at_hidden / 2));
      aim(unmet_, part(at_unmet / 2));
      past_borders(part(at_borders));
      all_around(part(count - at_hidden - at_unmet - at_borders));
    }
    // Borders do not always have as many rays as they may.
    if (check_.rays < rays) all_around({0, rays - check_.rays, rays - check_.rays});
  }

  /// Remembers what was seen so far.
  void note() {
    check_.seen.push_back(now_);
    check_.seen.back().rays = check_.rays;
  }

  CellCheck result() {
    check_.has_eye = true;
    check_.wrong = missing_.wrong(), check_.narrow = missing_.narrow();
    count_objects();
    return check_;
  }

 private:
  void all_around(const Strata& part) {
    const size_t first_eye = next_eye_;
    {
      const Timed timed(check_.times.directions_s);
      const auto directions = sphere_directions(part, random_);
      rays_.resize(directions.size());
      for (size_t i = 0; i < directions.size(); ++i) rays_[i] = {eye_of(i), directions[i]};
    }
    next_turn();
    for (size_t i = 0; i < rays_.size(); i += run)
      missing_.looked((first_eye + i / run) % eyes_.size(), std::min(run, rays_.size() - i));
    shoot([&](size_t ray, MissingFinder::Verdict verdict) {
      missing_.count((first_eye + ray / run) % eyes_.size(), verdict);
    });
  }

  void aim(const Targets& targets, const Strata& part) {
    if (part.size() == 0) return;
    {
      const Timed timed(check_.times.directions_s);
      const auto points = targets.points(part, random_);
      rays_.resize(points.size());
      for (size_t i = 0; i < points.size(); ++i) rays_[i] = {eye_of(i), direction_to(points[i], eye_of(i))};
    }
    next_turn();
    shoot([](size_t, MissingFinder::Verdict) {});
  }

  // Each eye in turn looks along `run` rays.
  const glm::vec3& eye_of(size_t ray) const { return eyes_[(next_eye_ + ray / run) % eyes_.size()]; }
  void next_turn() { next_eye_ = (next_eye_ + (rays_.size() + run - 1) / run) % eyes_.size(); }

  void past_borders(const Strata& part) {
    {
      const Timed timed(check_.times.directions_s);
      borders_.aim(part, eyes_, random_, rays_);
    }
    shoot([](size_t, MissingFinder::Verdict) {});
    const Timed timed(check_.times.directions_s);
    borders_.learn(rays_, hits_, random_);
  }

  // missed(ray, verdict) is told of hits on what the row does not draw.
  template <typename Missed>
  void shoot(const Missed& missed) {
    hits_.resize(rays_.size());
    if (sink_) sink_(rays_);
    {
      const Timed timed(check_.times.tracing_s);
      city_.rays.first_hits(rays_, hits_);
    }
    check_.rays += rays_.size();
    for (size_t i = 0; i < rays_.size(); ++i) {
      const uint32_t triangle = hits_[i].triangle;
      if (triangle == Hit::none) continue;
      ++check_.hits;
      if (!drawn_[triangle]) {
        const Timed timed(check_.times.settling_s);
        const MissingFinder::Settled settled = missing_.settle(rays_[i], hits_[i]);
        check_.cleared += settled.verdict == MissingFinder::Verdict::cleared;
        if (settled.verdict == MissingFinder::Verdict::wrong) see(settled.triangle, rays_[i].eye);
        missed(i, settled.verdict);
      } else if (!seen_[triangle]) {
        see(triangle, rays_[i].eye);
      }
    }
  }

  void see(uint32_t triangle, const glm::vec3& eye) {
    if (seen_[triangle]) return;
    seen_[triangle] = 1;
    borders_.add(triangle, eye);
    ++now_.triangles;
    const uint32_t object = city_.object_of[triangle];
    if (seen_of_object_[object]++ > 0) return;
    ++now_.objects;
    now_.buildings += city_.file.city.scene.objects[object].kind == Kind::building;
  }

  std::vector<uint8_t> met_or_undrawn() const {
    std::vector<uint8_t> result(drawn_.size());
    for (size_t t = 0; t < result.size(); ++t) result[t] = seen_[t] || !drawn_[t];
    return result;
  }

  void count_objects() {
    const Scene& scene = city_.file.city.scene;
    for (const PvsEntry& entry : city_.file.row(cell_)) {
      const Object& object = scene.objects[entry.object];
      ++check_.pvs_objects;
      check_.pvs_buildings += object.kind == Kind::building;
      check_.whole_triangles += object.triangle_end - object.triangle_begin;
    }
    check_.pvs_triangles = static_cast<uint64_t>(std::count(drawn_.begin(), drawn_.end(), 1));
    for (size_t o = 0; o < scene.objects.size(); ++o) {
      if (seen_of_object_[o] == 0) continue;
      const uint64_t begin = scene.objects[o].triangle_begin, count = scene.objects[o].triangle_end - begin;
      check_.seen_whole_triangles += count;
      check_.tightest_triangles +=
          tightest_index({&city_.file.city.triangle_slices[begin], count}, {&seen_[begin], count}).drawn;
    }
  }

  const CheckedCity& city_;
  uint32_t cell_;
  const RaySink& sink_;
  Random random_;
  std::vector<glm::vec3> eyes_;
  std::vector<uint32_t> order_;  // of objects
  std::vector<uint8_t> drawn_, seen_;
  std::vector<uint32_t> seen_of_object_;  // [O] triangles
  Targets hidden_, unmet_;
  Borders borders_;
  MissingFinder missing_;
  size_t next_eye_ = 0;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  CellCheck::Seen now_;
  CellCheck check_;
};

}  // namespace

CellCheck check_cell(const CheckedCity& city, uint32_t cell, const VerifyOptions& options,
                     const RaySink& sink) {
  const Stopwatch watch;
  Random random(options.seed, cell);
  const auto eyes = eye_points(city.file.city.cells[cell], std::max(1u, options.eyes_per_cell),
                               city.file.city.navigation.free, city.rays, Random(random.bits()));
  if (eyes.empty()) return {};
  const double eyes_s = watch.seconds();
  Shooter shooter(city, cell, eyes, random.bits(), sink);
  // What was found says where to look: at first after few rays, then as they double.
  const int doublings = std::max(3, static_cast<int>(std::bit_width(options.rays_per_cell / first_rays)));
  for (int left = std::min(doublings, 63); left >= 0; --left) {
    shooter.shoot_until(options.rays_per_cell >> left);
    if (left <= 3) shooter.note();
  }
  CellCheck check = shooter.result();
  check.times.eyes_s = eyes_s;
  check.times.total_s = watch.seconds();
  return check;
}

}  // namespace veduta
