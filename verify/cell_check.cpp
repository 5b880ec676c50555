#include "verify/cell_check.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <numeric>

#include "verify/borders.h"
#include "verify/directions.h"
#include "verify/eyes.h"
#include "verify/missing.h"
#include "verify/tightest_index.h"

namespace veduta {
namespace {

constexpr size_t run = 16;  // rays from one eye before the next one's turn: a packet
// Rays between two looks at what was found: few at first, while much is new.
constexpr uint64_t least_round = 2048, most_round = 65536;

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

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Adds the time of its life to a sum.
class Timed {
 public:
  explicit Timed(double& sum_s) : sum_s_(sum_s) {}
  ~Timed() { sum_s_ += seconds_since(begin_); }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  double& sum_s_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

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

  void shoot_until(uint64_t rays) {
    while (check_.rays < rays)
      round(std::min(rays - check_.rays, std::clamp(check_.rays / 4, least_round, most_round)));
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
  // A quarter of the rays go all over the sphere, a quarter at what the row does not draw, an eighth at what
  // it draws and no ray has met, the rest past the borders of what was met. Where there is nothing to aim at,
  // all over the sphere instead.
  void round(uint64_t count) {
    if (check_.rays >= next_unmet_) {
      const Timed timed(check_.times.directions_s);
      unmet_ = Targets(city_.file.city.scene, met_or_undrawn(), order_);
      next_unmet_ = 2 * check_.rays;
    }
    const uint64_t end = check_.rays + count;
    if (!hidden_.empty()) aim(hidden_, count / 4);
    if (!unmet_.empty()) aim(unmet_, count / 8);
    if (!borders_.empty()) past_borders(3 * count / 8);
    if (check_.rays < end) all_around(end - check_.rays);
  }

  void all_around(uint64_t count) {
    const size_t first_eye = next_eye_;
    {
      const Timed timed(check_.times.directions_s);
      from_eyes(sphere_directions(count, random_));
    }
    for (size_t i = 0; i < rays_.size(); i += run)
      missing_.looked((first_eye + i / run) % eyes_.size(), std::min(run, rays_.size() - i));
    shoot([&](size_t ray, MissingFinder::Verdict verdict) {
      missing_.count((first_eye + ray / run) % eyes_.size(), verdict);
    });
  }

  void aim(const Targets& targets, uint64_t count) {
    {
      const Timed timed(check_.times.directions_s);
      const auto points = targets.points(count / 2, random_);
      rays_.resize(points.size());
      for (size_t i = 0; i < points.size(); ++i) {
        const glm::vec3& eye = eyes_[(next_eye_ + i / run) % eyes_.size()];
        rays_[i] = {eye, direction_to(points[i], eye)};
      }
      next_eye_ = (next_eye_ + (points.size() + run - 1) / run) % eyes_.size();
    }
    shoot([](size_t, MissingFinder::Verdict) {});
  }

  void past_borders(uint64_t count) {
    {
      const Timed timed(check_.times.directions_s);
      borders_.aim(count, eyes_, random_, rays_);
    }
    shoot([](size_t, MissingFinder::Verdict) {});
    const Timed timed(check_.times.directions_s);
    borders_.learn(rays_, hits_, random_);
  }

  void from_eyes(const std::vector<glm::vec3>& directions) {
    rays_.resize(directions.size());
    for (size_t i = 0; i < directions.size(); ++i)
      rays_[i] = {eyes_[(next_eye_ + i / run) % eyes_.size()], directions[i]};
    next_eye_ = (next_eye_ + (directions.size() + run - 1) / run) % eyes_.size();
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
  uint64_t next_unmet_ = 0;
  size_t next_eye_ = 0;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  CellCheck::Seen now_;
  CellCheck check_;
};

}  // namespace

CellCheck check_cell(const CheckedCity& city, uint32_t cell, const VerifyOptions& options,
                     const RaySink& sink) {
  const auto begin = std::chrono::steady_clock::now();
  Random random(options.seed, cell);
  const auto eyes = eye_points(city.file.city.cells[cell], std::max(1u, options.eyes_per_cell),
                               city.file.city.navigation.free, city.rays, Random(random.bits()));
  if (eyes.empty()) return {};
  const double eyes_s = seconds_since(begin);
  Shooter shooter(city, cell, eyes, random.bits(), sink);
  for (const uint64_t part : {8, 4, 2, 1}) shooter.shoot_until(options.rays_per_cell / part);
  CellCheck check = shooter.result();
  check.times.eyes_s = eyes_s;
  check.times.total_s = seconds_since(begin);
  return check;
}

}  // namespace veduta
