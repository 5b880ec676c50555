#include "tests/hard/exact_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <stdexcept>

#include "tests/hard/exact_geometry.h"
#include "tests/hard/segment_distance.h"

namespace veduta::hard {
namespace {

constexpr double most =
    1LL << 36;  // of a coordinate; of those of the model half, so that points beside it fit in
constexpr double box_margin = 8;       // of the hierarchy's boxes, for the doubles that they are met in
constexpr double clear_margin = 1e-9;  // of the extent
constexpr uint32_t most_in_leaf = 4;

struct Node {
  std::array<double, 3> lower, upper;
  uint32_t begin = 0, end = 0;  // of the order; inner: children are the next node and `right`
  uint32_t right = 0;
};

/// The part [first, last] of a ray (1 at what it is aimed at) that may lie in a box; nothing where it passes.
bool meets(const Node& node, const Whole& eye, const Whole& d, double last) {
  double first = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto from = static_cast<double>(eye[axis]), along = static_cast<double>(d[axis]);
    const double lower = node.lower[axis] - box_margin - from, upper = node.upper[axis] + box_margin - from;
    if (along == 0) {
      if (lower > 0 || upper < 0) return false;
      continue;
    }
    const double p = lower / along, q = upper / along;
    first = std::max(first, std::min(p, q)), last = std::min(last, std::max(p, q));
  }
  return first <= last;
}

/// What a ray meets first, triangle after triangle in any order.
class FirstMeeting {
 public:
  void add(uint32_t triangle, const Crossing& crossing) {
    if (crossing.meeting == Meeting::none) return;
    if (crossing.in_plane) {
      in_plane_ = true;  // before or behind what is met: too many are doubted, never too few
      return;
    }
    if (crossing.along.numerator <= 0) {
      doubtful_ |= crossing.along.numerator == 0;  // the eye is on a triangle
      return;
    }
    if (met_ && first_ < crossing.along) return;
    if (!met_ || crossing.along < first_) {
      met_ = true, first_ = crossing.along;
      edge_ = false;
      triangles_.clear();
    }
    edge_ |= crossing.meeting == Meeting::edge;
    if (crossing.meeting == Meeting::inside) triangles_.push_back(triangle);
  }
  /// Nothing beyond it matters.
  double limit() const {
    return met_ ? first_.rounded() * (1 + 1e-9) : std::numeric_limits<double>::infinity();
  }
  std::optional<Sight> sight(const Point& eye, const Point& at) {
    if (!met_ || doubtful_ || edge_ || in_plane_) return {};
    Sight sight;
    std::sort(triangles_.begin(), triangles_.end());
    sight.triangles = triangles_;
    const double t = first_.rounded();
    for (size_t axis = 0; axis < 3; ++axis) sight.point[axis] = eye[axis] + t * (at[axis] - eye[axis]);
    return sight;
  }

 private:
  bool met_ = false, edge_ = false, doubtful_ = false, in_plane_ = false;
  Along first_;
  std::vector<uint32_t> triangles_;
};

}  // namespace

struct ExactReference::Exact {
  double scale = 1, extent = 0;
  Point origin{}, lower{}, upper{};
  std::vector<std::array<Whole, 3>> triangles;
  std::vector<uint32_t> order;
  std::vector<Node> nodes;

  Whole whole(const Point& p) const {
    Whole w{};
    for (size_t axis = 0; axis < 3; ++axis) {
      const double at = (p[axis] - origin[axis]) * scale;
      if (!(std::abs(at) < most)) throw std::out_of_range("exact reference: a point far outside of its box");
      w[axis] = std::llround(at);
    }
    return w;
  }

  Node bounds(std::span<const uint32_t> of) const {
    Node node;
    node.lower.fill(std::numeric_limits<double>::max());
    node.upper.fill(std::numeric_limits<double>::lowest());
    for (const uint32_t t : of) {
      for (const Whole& corner : triangles[t]) {
        for (size_t axis = 0; axis < 3; ++axis) {
          node.lower[axis] = std::min(node.lower[axis], static_cast<double>(corner[axis]));
          node.upper[axis] = std::max(node.upper[axis], static_cast<double>(corner[axis]));
        }
      }
    }
    return node;
  }

  void build(uint32_t begin, uint32_t end) {
    const size_t at = nodes.size();
    nodes.emplace_back();
    Node node = bounds({order.begin() + begin, order.begin() + end});
    node.begin = begin, node.end = end;
    if (end - begin > most_in_leaf) {
      size_t axis = 0;
      for (size_t other : {1, 2})
        if (node.upper[other] - node.lower[other] > node.upper[axis] - node.lower[axis]) axis = other;
      const auto middle = [&](uint32_t t) {
        return triangles[t][0][axis] + triangles[t][1][axis] + triangles[t][2][axis];
      };
      const uint32_t half = begin + (end - begin) / 2;
      std::nth_element(order.begin() + begin, order.begin() + half, order.begin() + end,
                       [&](uint32_t a, uint32_t b) { return middle(a) < middle(b); });
      build(begin, half);
      node.right = static_cast<uint32_t>(nodes.size());
      build(half, end);
    }
    nodes[at] = node;
  }

  /// A line in the plane of a triangle (any line, where that is a point) leaves a doubt only if it comes
  /// near.
  Crossing meeting(const Whole& eye, const Whole& at, const Whole& d, uint32_t t) const {
    const Crossing crossing = cross(eye, at, triangles[t]);
    if (!crossing.in_plane || meets(bounds({&t, 1}), eye, d, std::numeric_limits<double>::infinity()))
      return crossing;
    return {};
  }

  /// Calls visit(triangle) for those in leaves that `enters`; until it says false.
  template <typename Enters, typename Visit>
  bool walk(const Enters& enters, const Visit& visit) const {
    std::vector<uint32_t> stack{0};
    while (!stack.empty()) {
      const uint32_t at = stack.back();
      const Node& node = nodes[at];
      stack.pop_back();
      if (!enters(node)) continue;
      if (node.right != 0) {
        stack.push_back(node.right), stack.push_back(at + 1);
        continue;
      }
      for (uint32_t n = node.begin; n < node.end; ++n)
        if (!visit(order[n])) return false;
    }
    return true;
  }
};

ExactReference::ExactReference(ExactModel model, const std::vector<Point>& eyes)
    : model_(std::move(model)), exact_(std::make_unique<Exact>()) {
  Exact& e = *exact_;
  e.lower.fill(std::numeric_limits<double>::max()), e.upper.fill(std::numeric_limits<double>::lowest());
  const auto hold = [](Point& lower, Point& upper, const Point& p) {
    for (size_t axis = 0; axis < 3; ++axis)
      lower[axis] = std::min(lower[axis], p[axis]), upper[axis] = std::max(upper[axis], p[axis]);
  };
  for (const ExactTriangle& t : model_.triangles)
    for (const Point& p : t.corner) hold(e.lower, e.upper, p);
  Point lower = e.lower, upper = e.upper;
  for (const Point& p : eyes) hold(lower, upper, p);
  for (size_t axis = 0; axis < 3; ++axis) {
    e.origin[axis] = lower[axis] + 0.5 * (upper[axis] - lower[axis]);
    e.extent = std::max(e.extent, upper[axis] - lower[axis]);
  }
  e.scale = std::exp2(std::floor(std::log2(most / e.extent)));
  for (const ExactTriangle& t : model_.triangles)
    e.triangles.push_back({e.whole(t.corner[0]), e.whole(t.corner[1]), e.whole(t.corner[2])});
  e.order.resize(e.triangles.size());
  std::iota(e.order.begin(), e.order.end(), 0u);
  e.build(0, static_cast<uint32_t>(e.order.size()));
}

ExactReference::~ExactReference() = default;

std::optional<Sight> ExactReference::look(const Point& eye, const Point& at) const {
  const Whole from = exact_->whole(eye), to = exact_->whole(at);
  const Whole d{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  if (d == Whole{}) return {};
  FirstMeeting first;
  exact_->walk([&](const Node& node) { return meets(node, from, d, first.limit()); },
               [&](uint32_t t) {
                 first.add(t, exact_->meeting(from, to, d, t));
                 return true;
               });
  return first.sight(eye, at);
}

std::optional<Sight> ExactReference::look_at_all(const Point& eye, const Point& at) const {
  const Whole from = exact_->whole(eye), to = exact_->whole(at);
  const Whole d{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  if (d == Whole{}) return {};
  FirstMeeting first;
  for (uint32_t t = 0; t < exact_->triangles.size(); ++t) first.add(t, exact_->meeting(from, to, d, t));
  return first.sight(eye, at);
}

bool ExactReference::clear(const Point& from, const Point& to, double distance_m) const {
  const Exact& e = *exact_;
  const double reach = distance_m + clear_margin * e.extent;
  const auto near = [&](const Node& node) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const double lower = e.origin[axis] + node.lower[axis] / e.scale - reach;
      const double upper = e.origin[axis] + node.upper[axis] / e.scale + reach;
      if (std::max(from[axis], to[axis]) < lower || std::min(from[axis], to[axis]) > upper) return false;
    }
    return true;
  };
  return e.walk(near,
                [&](uint32_t t) { return segment_distance(from, to, model_.triangles[t].corner) > reach; });
}

Point ExactReference::lower() const {
  return exact_->lower;
}

Point ExactReference::upper() const {
  return exact_->upper;
}

}  // namespace veduta::hard
