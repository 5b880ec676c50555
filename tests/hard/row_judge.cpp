// Holding rows against sightings.
#include <algorithm>
#include <map>
#include <sstream>

#include "tests/hard/hard_case.h"
#include "tests/hard/segment_distance.h"

namespace veduta::hard {
namespace {

/// "ground" is cut into "ground/0_0", ...; a second "house" is "house#2".
bool is_of(const std::string& name, const std::string& object) {
  return name.starts_with(object) &&
         (name.size() == object.size() || name[object.size()] == '/' || name[object.size()] == '#');
}

std::string words(const Point& p) {
  std::ostringstream out;
  out.precision(12);
  out << "(" << p[0] << ", " << p[1] << ", " << p[2] << ")";
  return out.str();
}

/// The triangles of a file by the reference's, and where its points lie in the file.
class Places {
 public:
  Places(const PvsFile& file, const ExactModel& model) : scene_(file.city.scene), model_(model) {
    const Box bounds = scene_.bounds();
    for (int axis = 0; axis < 3; ++axis)
      reach_ = std::max({reach_, std::abs(double{bounds.lower[axis]}), std::abs(double{bounds.upper[axis]})});
    // Half a unit in the last place of a float for each coordinate of a corner, and some for the point
    // itself.
    tolerance_ = reach_ * 4.0 / (1 << 24);
  }

  /// Objects and triangles of the file that hold a point of the reference's triangle.
  std::vector<std::pair<uint32_t, uint64_t>> holding(uint32_t triangle, const Point& at) {
    const Point p = inward(at);
    std::vector<std::pair<uint32_t, uint64_t>> found;
    for (const Candidate& c : candidates(triangle))
      if (point_distance(p, c.corner) <= tolerance_) found.emplace_back(c.object, c.triangle);
    return found;
  }

 private:
  struct Candidate {
    uint32_t object;
    uint64_t triangle;
    std::array<Point, 3> corner;
  };
  /// The triangles of an object in the file, by where they begin along its longest axis.
  struct Run {
    size_t axis = 0;
    double longest = 0;  // of a triangle along it
    std::vector<Candidate> sorted;
  };

  static std::pair<double, double> range(const std::array<Point, 3>& t, size_t axis) {
    return std::minmax({t[0][axis], t[1][axis], t[2][axis]});
  }

  Point inward(const Point& p) const {
    return {p[0] - scene_.origin[0], p[1] - scene_.origin[1], p[2] - scene_.origin[2]};
  }

  const std::vector<Run>& runs_of(uint32_t object) {
    const auto [known, fresh] = runs_.try_emplace(object);
    for (uint32_t o = 0; fresh && o < scene_.objects.size(); ++o)
      if (is_of(scene_.objects[o].name, model_.objects[object])) known->second.push_back(run_of(o));
    return known->second;
  }

  Run run_of(uint32_t object) const {
    Run run;
    const Box bounds = scene_.bounds(object);
    const glm::vec3 size = bounds.upper - bounds.lower;
    run.axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    visit_triangles(scene_, object, [&](uint64_t number, const std::array<glm::vec3, 3>& corners) {
      std::array<Point, 3> c;
      for (size_t n = 0; n < 3; ++n) c[n] = {corners[n].x, corners[n].y, corners[n].z};
      const auto [first, last] = range(c, run.axis);
      run.longest = std::max(run.longest, last - first);
      run.sorted.push_back({object, number, c});
    });
    std::ranges::sort(run.sorted, {}, [&](const Candidate& c) { return range(c.corner, run.axis).first; });
    return run;
  }

  const std::vector<Candidate>& candidates(uint32_t triangle) {
    const auto [known, fresh] = candidates_.try_emplace(triangle);
    if (!fresh) return known->second;
    const ExactTriangle& exact = model_.triangles[triangle];
    const std::array<Point, 3> t = {inward(exact.corner[0]), inward(exact.corner[1]),
                                    inward(exact.corner[2])};
    for (const Run& run : runs_of(exact.object)) {
      const auto [first, last] = range(t, run.axis);
      const auto begins = [&](const Candidate& c) { return range(c.corner, run.axis).first; };
      auto c = std::ranges::lower_bound(run.sorted, first - run.longest - 2 * tolerance_, {}, begins);
      for (; c != run.sorted.end() && begins(*c) <= last + tolerance_; ++c)
        if (overlap(t, c->corner)) known->second.push_back(*c);
    }
    return known->second;
  }

  bool overlap(const std::array<Point, 3>& a, const std::array<Point, 3>& b) const {
    for (size_t axis = 0; axis < 3; ++axis) {
      if (range(a, axis).first > range(b, axis).second + tolerance_ ||
          range(b, axis).first > range(a, axis).second + tolerance_)
        return false;
    }
    return true;
  }

  const Scene& scene_;
  const ExactModel& model_;
  double reach_ = 0, tolerance_ = 0;
  std::map<uint32_t, std::vector<Run>> runs_;
  std::map<uint32_t, std::vector<Candidate>> candidates_;
};

}  // namespace

bool lists(const PvsFile& file, uint32_t cell, const std::string& name) {
  const auto row = file.row(cell);
  return std::any_of(row.begin(), row.end(),
                     [&](const PvsEntry& e) { return is_of(file.city.scene.objects[e.object].name, name); });
}

Verdict judge(const PvsFile& file, const ExactReference& reference, const std::vector<CellSightings>& cells) {
  Places places(file, reference.model());
  Verdict verdict;
  for (const CellSightings& from : cells) {
    std::map<uint32_t, VisibilityIndex> row;
    for (const PvsEntry& entry : file.row(from.cell)) row[entry.object] = entry.index;
    for (const Sighting& seen : from.sightings) {
      bool here = false, drawn = false;
      for (const uint32_t t : seen.sight.triangles) {
        for (const auto& [object, triangle] : places.holding(t, seen.sight.point)) {
          here = true;
          const auto entry = row.find(object);
          drawn |= entry != row.end() && draws(entry->second, file.city.triangle_slices[triangle]);
        }
      }
      if (drawn) continue;
      const ExactTriangle& t = reference.model().triangles[seen.sight.triangles.front()];
      const std::string& name = reference.model().objects[t.object];
      std::string text = name +
                         (!here                          ? " is not in the scene where it"
                          : lists(file, from.cell, name) ? ": a triangle that is not drawn"
                                                         : " is not in the row and") +
                         " is seen at " + words(seen.sight.point) + " from " + words(seen.eye) + " in cell " +
                         std::to_string(from.cell);
      (seen.through_gap ? verdict.through_gaps : verdict.wrong).push_back(std::move(text));
    }
  }
  return verdict;
}

}  // namespace veduta::hard
