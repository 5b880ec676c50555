#include "tests/hard/sightings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace veduta::hard {
namespace {

double halton(size_t index, size_t base) {
  double value = 0, digit = 1;
  for (; index > 0; index /= base)
    digit /= static_cast<double>(base), value += digit * static_cast<double>(index % base);
  return value;
}

Point in_box(const PointBox& box, const Point& share) {
  Point p{};
  for (size_t axis = 0; axis < 3; ++axis)
    p[axis] = box.lower[axis] + share[axis] * (box.upper[axis] - box.lower[axis]);
  return p;
}

/// The n-th place in a unit cube: first the 27 of corners, middles of edges, faces and the cube.
Point share_of(size_t n) {
  if (n >= 27) return {halton(n, 2), halton(n, 3), halton(n, 5)};
  // Corners are tried first: they have no coordinate in the middle.
  static const std::vector<Point> places = [] {
    std::vector<Point> all;
    for (int i = 0; i < 27; ++i) all.push_back({0.5 * (i % 3), 0.5 * (i / 3 % 3), 0.5 * (i / 9)});
    const auto middles = [](const Point& p) { return std::count(p.begin(), p.end(), 0.5); };
    std::stable_sort(all.begin(), all.end(),
                     [&](const Point& a, const Point& b) { return middles(a) < middles(b); });
    return all;
  }();
  return places[n];
}

/// Does the segment pass the box? (Closed.)
bool passes(const Point& from, const Point& to, const PointBox& box) {
  double first = 0, last = 1;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double d = to[axis] - from[axis];
    if (d == 0 && (from[axis] < box.lower[axis] || from[axis] > box.upper[axis])) return false;
    if (d == 0) continue;
    const double p = (box.lower[axis] - from[axis]) / d, q = (box.upper[axis] - from[axis]) / d;
    first = std::max(first, std::min(p, q)), last = std::min(last, std::max(p, q));
  }
  return first <= last;
}

/// Sightings by what they meet.
class Found {
 public:
  Found(const ExactReference& reference, const LookAbout& about)
      : reference_(reference), about_(about), seen_(reference.model().triangles.size()) {}

  void look(const Point& eye, const Point& at) {
    ++looks_;
    auto sight = reference_.look(eye, at);
    if (!sight) return;
    const auto in_gap = [&](const PointBox& gap) { return passes(eye, sight->point, gap); };
    const bool gap = std::any_of(about_.gaps.begin(), about_.gaps.end(), in_gap);
    for (const uint32_t t : sight->triangles) seen_[t] = seen_[t] || !gap;
    const auto [known, fresh] = sightings_.try_emplace(sight->triangles);
    if (fresh || (known->second.through_gap && !gap)) known->second = {eye, std::move(*sight), gap};
  }
  bool seen(size_t triangle) const { return seen_[triangle]; }
  bool tired() const { return looks_ >= about_.looks; }
  std::vector<Sighting> take() {
    std::vector<Sighting> all;
    for (auto& [triangles, sighting] : sightings_) all.push_back(std::move(sighting));
    return all;
  }

 private:
  const ExactReference& reference_;
  const LookAbout& about_;
  std::vector<bool> seen_;
  std::map<std::vector<uint32_t>, Sighting> sightings_;
  size_t looks_ = 0;
};

/// Chance, the same every time.
class AnyTriangle {
 public:
  explicit AnyTriangle(const ExactModel& model) : of_object_(model.objects.size()) {
    for (size_t t = 0; t < model.triangles.size(); ++t) of_object_[model.triangles[t].object].push_back(t);
    std::erase_if(of_object_, [](const auto& triangles) { return triangles.empty(); });
    all_ = model.triangles.size();
  }
  size_t of(size_t count) { return static_cast<size_t>(random_()) % count; }
  double share() { return static_cast<double>(random_()) / 4294967296.0; }
  /// Half of them by the object: one of a million triangles is no more than one of twelve.
  size_t triangle() {
    if (of(2) == 0) return of(all_);
    const std::vector<size_t>& triangles = of_object_[of(of_object_.size())];
    return triangles[of(triangles.size())];
  }

 private:
  std::mt19937 random_{1};
  std::vector<std::vector<size_t>> of_object_;
  size_t all_ = 0;
};

Point on_triangle(const ExactTriangle& t, double a, double b, double c) {
  Point p{};
  for (size_t axis = 0; axis < 3; ++axis)
    p[axis] = a * t.corner[0][axis] + b * t.corner[1][axis] + c * t.corner[2][axis];
  return p;
}

/// The n-th place on a triangle: next to corners, next to edges, then spread over it.
Point target(const ExactTriangle& t, size_t n) {
  constexpr double near = 1e-3;
  std::array<double, 3> share{};
  if (n < 3) {
    share.fill(near), share[n] = 1 - 2 * near;
  } else if (n < 6) {
    share.fill((1 - near) / 2), share[n - 3] = near;
  } else {
    const double u = halton(n - 5, 2), v = halton(n - 5, 3), root = std::sqrt(u);
    share = {1 - root, root * (1 - v), root * v};
  }
  return on_triangle(t, share[0], share[1], share[2]);
}

}  // namespace

std::vector<Point> certain_eyes(const ExactReference& reference, const PointBox& cell,
                                const LookAbout& about) {
  std::vector<Point> eyes;
  const Point lower = reference.lower(), upper = reference.upper();
  const auto beside = [&](const Point& eye) {
    const double rim = 2 * about.clearance_m;
    return eye[0] < lower[0] - rim || eye[0] > upper[0] + rim || eye[1] < lower[1] - rim ||
           eye[1] > upper[1] + rim;
  };
  for (size_t n = 0; n < 8 * about.eyes && eyes.size() < about.eyes; ++n) {
    const Point eye = in_box(cell, share_of(n));
    if (beside(eye)) continue;
    const auto joined = [&](const Point& stand) { return reference.clear(stand, eye, about.clearance_m); };
    if (std::any_of(about.stands.begin(), about.stands.end(), joined)) eyes.push_back(eye);
  }
  return eyes;
}

std::vector<Sighting> look_about(const ExactReference& reference, const std::vector<Point>& eyes,
                                 const LookAbout& about) {
  if (eyes.empty()) return {};
  const auto& triangles = reference.model().triangles;
  Found found(reference, about);
  // A third of the looks are kept for edges. Places are taken in turn over all triangles.
  const size_t aimed = about.looks * 2 / 3;
  const size_t places = std::max<size_t>(1, aimed / triangles.size());
  AnyTriangle any(reference.model());
  for (size_t n = 0, looks = 0; n < places && looks < aimed; ++n) {
    for (size_t t = 0; t < triangles.size() && looks < aimed; ++t) {
      const size_t which = triangles.size() > aimed ? any.triangle() : t;
      if (found.seen(which)) continue;
      // Another place each time, and another eye: in the end each place from many eyes.
      found.look(eyes[(n + which) % eyes.size()], target(triangles[which], n / eyes.size() + n % 24));
      ++looks;
    }
  }
  while (!found.tired()) {
    const Point& eye = eyes[any.of(eyes.size())];
    const ExactTriangle& t = triangles[any.triangle()];
    const double along = any.share();
    std::array<double, 3> share{along, 1 - along, 0};
    std::rotate(share.begin(), share.begin() + static_cast<long>(any.of(3)), share.end());
    Point at = on_triangle(t, share[0], share[1], share[2]);
    double distance = 0;
    for (size_t axis = 0; axis < 3; ++axis) distance += std::abs(at[axis] - eye[axis]);
    const double beside = distance * std::pow(10, -1 - 4 * any.share());
    for (double& coordinate : at) coordinate += beside * (2 * any.share() - 1);
    found.look(eye, at);
  }
  return found.take();
}

}  // namespace veduta::hard
