#include "verify/borders.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "verify/directions.h"

namespace veduta {
namespace {

constexpr size_t run = 4;             // samples of an edge from one eye
constexpr size_t runs_an_eye = 4;     // before the next eye's turn
constexpr float least_angle = 1e-5f;  // past the edge
constexpr float angle_range = 3000;   // the largest over the least
constexpr uint32_t deepest_gap = 6;   // halvings

// Where the line from + t * step is in the box: [first, last], first > last when nowhere.
std::pair<float, float> inside(const Box& box, const glm::vec3& from, const glm::vec3& step) {
  float first = -std::numeric_limits<float>::infinity(), last = -first;
  for (int axis = 0; axis < 3; ++axis) {
    if (step[axis] == 0) {
      if (from[axis] < box.lower[axis] || from[axis] > box.upper[axis]) return {1.0f, 0.0f};
      continue;
    }
    const float a = (box.lower[axis] - from[axis]) / step[axis],
                b = (box.upper[axis] - from[axis]) / step[axis];
    first = std::max(first, std::min(a, b)), last = std::min(last, std::max(a, b));
  }
  return {first, last};
}

}  // namespace

Borders::Borders(const Scene& scene, const std::vector<uint32_t>& object_of, const Box& cell,
                 EyeTest eye_test)
    : scene_(scene), object_of_(object_of), cell_(cell), eye_test_(std::move(eye_test)) {}

uint32_t Borders::object_at(const Hit& hit) const {
  return hit.triangle == Hit::none ? Hit::none : object_of_[hit.triangle];
}

void Borders::add(uint32_t triangle, const glm::vec3& eye) {
  fresh_.push_back({static_cast<uint32_t>(edges_.size()), eye});
  for (uint32_t corner = 0; corner < 3; ++corner) {
    const glm::uvec3& c = scene_.triangles[triangle];
    const glm::vec3 middle = 0.5f * (scene_.vertices[c[static_cast<int>(corner)]] +
                                     scene_.vertices[c[static_cast<int>((corner + 1) % 3)]]);
    edges_.push_back({triangle, corner, curve_key(direction_to(middle, cell_.center())), false});
  }
}

void Borders::sample_edge(uint32_t edge, const glm::vec3& eye, Random& random, std::vector<Ray>& rays) {
  const glm::uvec3& c = scene_.triangles[edges_[edge].triangle];
  const int corner = static_cast<int>(edges_[edge].corner);
  const glm::vec3 &a = scene_.vertices[c[corner]], &b = scene_.vertices[c[(corner + 1) % 3]],
                  &opposite = scene_.vertices[c[(corner + 2) % 3]];
  for (size_t i = 0; i < run; ++i) {
    const glm::vec3 place = glm::mix(a, b, (static_cast<float>(i) + random.unit()) / static_cast<float>(run));
    const glm::vec3 along = direction_to(place, eye);
    glm::vec3 out = glm::cross(b - a, along);
    const float length2 = glm::dot(out, out);
    if (length2 > 0) out *= (glm::dot(out, opposite - place) > 0 ? -1.0f : 1.0f) / std::sqrt(length2);
    const float angle = least_angle * std::pow(angle_range, random.unit());
    rays.push_back({eye, glm::normalize(along + out * angle)});
    sampled_.push_back({edge, place});
  }
}

void Borders::aim(size_t count, std::span<const glm::vec3> eyes, Random& random, std::vector<Ray>& rays) {
  rays.clear(), sampled_.clear(), looked_into_.clear();
  limit_ = count;
  const auto take = [](auto& queue, size_t most, const auto& use) {
    most = std::min(most, queue.size());
    for (size_t i = queue.size() - most; i < queue.size(); ++i) use(queue[i]);
    queue.resize(queue.size() - most);
  };
  take(fresh_, count / 2 / (3 * run), [&](const Fresh& fresh) {
    for (uint32_t k = 0; k < 3; ++k) sample_edge(fresh.first_edge + k, fresh.eye, random, rays);
  });
  const size_t into_gaps = std::min(gaps_.size(), count / 4), past = std::min(reverse_.size(), count / 8);
  // Edges already known, from eyes that may see past them where others do not.
  const size_t used = rays.size() + into_gaps + past;
  const size_t runs = used < count ? (count - used) / run : 0;
  std::vector<std::pair<uint32_t, uint32_t>> picked;  // key, edge
  for (size_t i = 0; i < runs && !edges_.empty(); ++i) {
    const bool known = random.below(4) > 0 && !silhouettes_.empty();
    const uint32_t edge =
        known ? silhouettes_[random.below(silhouettes_.size())] : random.below(edges_.size());
    picked.emplace_back(edges_[edge].key, edge);
  }
  std::sort(picked.begin(), picked.end());
  const glm::vec3* eye = nullptr;
  for (size_t i = 0; i < picked.size(); ++i) {
    if (i % runs_an_eye == 0) eye = &eyes[random.below(eyes.size())];
    sample_edge(picked[i].second, *eye, random, rays);
  }
  take(gaps_, into_gaps, [&](const Gap& gap) {
    rays.push_back({gap.eye, glm::normalize(gap.one + gap.other)});
    looked_into_.push_back(gap);
  });
  take(reverse_, past, [&](const Ray& ray) { rays.push_back(ray); });
}

void Borders::learn(std::span<const Ray> rays, std::span<const Hit> hits, Random& random) {
  for (size_t i = 0; i < sampled_.size(); ++i) learn_sample(i, rays, hits, random);
  for (size_t i = 0; i < looked_into_.size(); ++i)
    learn_gap(looked_into_[i], rays[sampled_.size() + i], hits[sampled_.size() + i]);
}

void Borders::learn_sample(size_t i, std::span<const Ray> rays, std::span<const Hit> hits, Random& random) {
  const Sample& sample = sampled_[i];
  const float distance = glm::distance(sample.place, rays[i].eye);
  // A surface going on past its edge comes nearer or goes away by little.
  const bool farther = hits[i].triangle == Hit::none || hits[i].distance_m > 1.1f * distance,
             nearer = !farther && hits[i].distance_m < 0.9f * distance;
  if (farther && !edges_[sample.edge].silhouette) {
    edges_[sample.edge].silhouette = true;
    silhouettes_.push_back(sample.edge);
  }
  if (nearer && reverse_.size() < limit_)
    reverse(sample.place, hits[i].triangle, rays[i].eye + rays[i].direction * hits[i].distance_m, random);
  if (i % run == 0) return;
  const uint32_t here = object_at(hits[i]), before = object_at(hits[i - 1]);
  if (here != before && gaps_.size() < limit_)
    gaps_.push_back({rays[i].eye, rays[i - 1].direction, rays[i].direction, before, here, 1});
}

void Borders::learn_gap(const Gap& gap, const Ray& ray, const Hit& hit) {
  if (gap.level == deepest_gap || gaps_.size() >= limit_) return;
  const uint32_t between = object_at(hit);
  if (between != gap.one_object)
    gaps_.push_back({gap.eye, gap.one, ray.direction, gap.one_object, between, gap.level + 1});
  if (between != gap.other_object)
    gaps_.push_back({gap.eye, ray.direction, gap.other, between, gap.other_object, gap.level + 1});
}

// From the place past the edge of the hiding triangle that is nearest to the hit, and on into the cell.
void Borders::reverse(const glm::vec3& place, uint32_t hiding, const glm::vec3& hit, Random& random) {
  const glm::uvec3& c = scene_.triangles[hiding];
  const glm::vec3 middle = (scene_.vertices[c.x] + scene_.vertices[c.y] + scene_.vertices[c.z]) / 3.0f;
  glm::vec3 nearest{0};
  float least2 = std::numeric_limits<float>::infinity();
  for (int corner = 0; corner < 3; ++corner) {
    const glm::vec3 &a = scene_.vertices[c[corner]], &b = scene_.vertices[c[(corner + 1) % 3]];
    const glm::vec3 side = b - a;
    const float length2 = glm::dot(side, side);
    const glm::vec3 on =
        a + side * (length2 > 0 ? std::clamp(glm::dot(hit - a, side) / length2, 0.0f, 1.0f) : 0);
    const float distance2 = glm::dot(on - hit, on - hit);
    if (distance2 < least2) least2 = distance2, nearest = on;
  }
  const glm::vec3 step = nearest + 0.01f * (nearest - middle) - place;
  const auto [first, last] = inside(cell_, place, step);
  if (!(std::max(first, 1.0f) < last)) return;
  const glm::vec3 eye = place + step * glm::mix(std::max(first, 1.0f), last, random.unit());
  if (cell_.contains(eye) && eye_test_(eye)) reverse_.push_back({eye, direction_to(place, eye)});
}

}  // namespace veduta
