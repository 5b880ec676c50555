#include "verify/borders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace veduta {
namespace {

constexpr size_t run = 4;          // samples of an edge from one eye
constexpr size_t runs_an_eye = 4;  // before the next eye's turn
// Past the edge: from 1e-5 to 0.03, evenly in the logarithm.
const std::array<float, 256> angles = [] {
  std::array<float, 256> result{};
  for (size_t i = 0; i < result.size(); ++i)
    result[i] = 1e-5f * std::pow(3000.0f, static_cast<float>(i) / static_cast<float>(result.size() - 1));
  return result;
}();
constexpr uint32_t deepest_gap = 6;  // halvings

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
  const glm::vec3 way = a - eye, side = b - a;
  // Across the line of sight and the edge, all along it, and as long as the middle is far.
  glm::vec3 out = glm::cross(side, way);
  const float length2 = glm::dot(out, out);
  if (length2 > 0)
    out *= (glm::dot(out, opposite - a) > 0 ? -1.0f : 1.0f) * glm::length(way + 0.5f * side) /
           std::sqrt(length2);
  for (size_t i = 0; i < run; ++i) {
    const uint64_t bits = random.bits();
    const float along =
        (static_cast<float>(i) + static_cast<float>(bits >> 40) * 0x1p-24f) / static_cast<float>(run);
    const glm::vec3 place = way + side * along;
    const glm::vec3 past = place + out * angles[bits & 0xff];
    const float past2 = glm::dot(past, past);
    rays.push_back({eye, past2 > 0 ? past * (1 / std::sqrt(past2)) : glm::vec3(0, 0, 1)});
    sampled_.push_back({edge, eye + place});
  }
}

void Borders::take_up() {
  const auto before = [this](uint32_t a, uint32_t b) {
    return edges_[a].key != edges_[b].key ? edges_[a].key < edges_[b].key : a < b;
  };
  for (auto edge = static_cast<uint32_t>(known_.size()); edge < edges_.size(); ++edge) known_.push_back(edge);
  std::sort(known_.begin(), known_.end(), before);
  silhouettes_.clear();
  for (const uint32_t edge : known_)
    if (edges_[edge].silhouette) silhouettes_.push_back(edge);
}

void Borders::aim(const Strata& part, std::span<const glm::vec3> eyes, Random& random,
                  std::vector<Ray>& rays) {
  rays.clear(), sampled_.clear(), looked_into_.clear();
  const size_t count = part.size();
  limit_ = count;
  const auto take = [](auto& queue, size_t most, const auto& use) {
    most = std::min(most, queue.size());
    for (size_t i = queue.size() - most; i < queue.size(); ++i) use(queue[i]);
    queue.resize(queue.size() - most);
  };
  take(fresh_, count / 2 / (3 * run), [&](const Fresh& fresh) {
    for (uint32_t k = 0; k < 3; ++k) sample_edge(fresh.first_edge + k, fresh.eye, random, rays);
  });
  const size_t into_gaps = std::min(gaps_.size(), count / 8), past = std::min(reverse_.size(), count / 4);
  // Edges already known, from eyes that may see past them where others do not.
  const size_t used = rays.size() + into_gaps + past;
  const size_t runs = used < count ? (count - used) / run : 0;
  const auto sample = [&](const std::vector<uint32_t>& edges, size_t times) {
    if (edges.empty()) return;
    const double first = static_cast<double>(part.begin) / static_cast<double>(part.of),
                 last = static_cast<double>(part.end) / static_cast<double>(part.of);
    const glm::vec3* eye = nullptr;
    for (size_t i = 0; i < times; ++i) {
      if (i % runs_an_eye == 0) eye = &eyes[random.below(eyes.size())];
      const double at = (static_cast<double>(i) + random.unit()) / static_cast<double>(times);
      const auto edge =
          static_cast<size_t>((first + (last - first) * at) * static_cast<double>(edges.size()));
      sample_edge(edges[std::min(edge, edges.size() - 1)], *eye, random, rays);
    }
  };
  const size_t of_silhouettes = silhouettes_.empty() ? 0 : runs * 3 / 4;
  sample(silhouettes_, of_silhouettes);
  sample(known_, runs - of_silhouettes);
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
  if (farther) edges_[sample.edge].silhouette = true;
  if (nearer && reverse_.size() < limit_ / 4)
    reverse(sample.place, hits[i].triangle, rays[i].eye + rays[i].direction * hits[i].distance_m, random);
  if (i % run == 0) return;
  const uint32_t here = object_at(hits[i]), before = object_at(hits[i - 1]);
  if (here != before && gaps_.size() < limit_ / 8)
    gaps_.push_back({rays[i].eye, rays[i - 1].direction, rays[i].direction, before, here, 1});
}

void Borders::learn_gap(const Gap& gap, const Ray& ray, const Hit& hit) {
  if (gap.level == deepest_gap || gaps_.size() >= limit_ / 8) return;
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
