#include "verify/missing.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <set>

#include "verify/settle.h"

namespace veduta {
namespace {

// Examples come in the order of triangles, so one object's examples follow each other.
void add_example(std::vector<FalseInvisible>& examples, const FalseInvisible& example) {
  if (examples.empty() || examples.back().object != example.object)
    examples.push_back(example);
  else if (glm::distance(example.eye, example.hit) < glm::distance(examples.back().eye, examples.back().hit))
    examples.back() = example;
}

}  // namespace

MissingFinder::MissingFinder(const CheckedCity& city, uint32_t cell, const std::vector<uint8_t>& drawn,
                             size_t eyes)
    : city_(city), cell_(cell), drawn_(drawn), uniform_by_eye_(eyes, 0) {
  wrong_.uniform_by_eye = narrow_.uniform_by_eye = uniform_by_eye_;
}

MissingFinder::Settled MissingFinder::settle(const Ray& ray, const Hit& hit) {
  if (wrong_.triangles.contains(hit.triangle)) return {Verdict::wrong, hit.triangle};
  const Scene& scene = city_.file.city.scene;
  const auto candidates = city_.rays.triangles_near(ray.eye, ray.direction, hit.distance_m);
  const auto triangle = undrawn_met_first(scene, ray.eye, ray.direction, candidates, drawn_);
  if (!triangle) return {Verdict::cleared};
  FalseInvisible example{cell_,
                         city_.object_of[*triangle],
                         *triangle,
                         ray.eye,
                         ray.direction,
                         ray.eye + ray.direction * hit.distance_m,
                         {}};
  const auto gap =
      narrow_gap(scene, city_.rays, ray.eye, ray.direction, hit.distance_m, city_.narrow_gap_limit_m);
  if (gap && !wrong_.triangles.contains(*triangle)) {
    example.gap = *gap;
    narrow_.triangles.try_emplace(*triangle, example);
    return {Verdict::narrow};
  }
  wrong_.triangles.try_emplace(*triangle, example);
  narrow_.triangles.erase(*triangle);
  return {Verdict::wrong, *triangle};
}

void MissingFinder::count(size_t eye, Verdict verdict) {
  if (verdict == Verdict::wrong) ++wrong_.uniform_by_eye[eye];
  if (verdict == Verdict::narrow) ++narrow_.uniform_by_eye[eye];
}

CellCheck::Missing MissingFinder::wrong() const {
  return sum(wrong_, nullptr);
}

CellCheck::Missing MissingFinder::narrow() const {
  return sum(narrow_, &wrong_);
}

CellCheck::Missing MissingFinder::sum(const Tally& tally, const Tally* others) const {
  CellCheck::Missing result;
  const auto total = [](const std::vector<uint64_t>& counts) {
    return static_cast<double>(std::accumulate(counts.begin(), counts.end(), uint64_t{0}));
  };
  const double looked = total(uniform_by_eye_);
  result.share = looked > 0 ? total(tally.uniform_by_eye) / looked : 0;
  for (size_t eye = 0; eye < uniform_by_eye_.size(); ++eye)
    if (tally.uniform_by_eye[eye] > 0)
      result.worst_share = std::max(result.worst_share, static_cast<double>(tally.uniform_by_eye[eye]) /
                                                            static_cast<double>(uniform_by_eye_[eye]));
  result.triangles = tally.triangles.size();
  std::set<uint32_t> left_out;
  if (others)
    for (const auto& [triangle, example] : others->triangles) left_out.insert(example.object);
  for (const auto& [triangle, example] : tally.triangles)
    if (!left_out.contains(example.object)) add_example(result.examples, example);
  result.objects = result.examples.size();
  return result;
}

}  // namespace veduta
