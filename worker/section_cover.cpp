#include "worker/section_cover.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "worker/prism_heights.h"

namespace veduta {
namespace {

using Cells = std::vector<uint32_t>;
constexpr double infinity = std::numeric_limits<double>::infinity();

class SectionCover {
 public:
  SectionCover(SectionHeights& heights, const SectionPieces& pieces, const SealedColumns& columns,
               const CoverOptions& options)
      : h_(heights),
        pieces_(pieces),
        columns_(columns),
        options_(options),
        mark_(heights.samples.size(), 0),
        depth_(heights.samples.size(), 0) {}

  std::vector<Section> run() {
    Cells all;
    for (uint32_t c = 0; c < h_.samples.size(); ++c) {
      if (open(c)) all.push_back(c);
    }
    for (Part& part : connected_parts(all)) cover(std::move(part));
    return std::move(sections_);
  }

 private:
  struct Part {
    double gain = 0;  // sum of heights
    Cells cells;
    bool operator<(const Part& other) const {
      return gain < other.gain || (gain == other.gain && cells.front() > other.cells.front());
    }
  };

  double gain(uint32_t c) const { return static_cast<double>(h_.upper[c]) - h_.covered[c]; }
  bool open(uint32_t c) const { return h_.wanted[c] != 0 && gain(c) > options_.rise_m; }
  double square() const { return h_.samples.spacing_m * h_.samples.spacing_m; }

  std::vector<Part> connected_parts(const Cells& cells) {
    for (const uint32_t c : cells) mark_[c] = 1;
    const auto nx = static_cast<uint32_t>(h_.samples.nx), n = static_cast<uint32_t>(h_.samples.size());
    std::vector<Part> parts;
    for (const uint32_t first : cells) {
      if (mark_[first] == 0) continue;
      Part part;
      mark_[first] = 0;
      part.cells.push_back(first);
      for (size_t next = 0; next < part.cells.size(); ++next) {
        const uint32_t c = part.cells[next];
        part.gain += gain(c);
        const auto go = [&](bool inside, uint32_t to) {
          if (inside && mark_[to] != 0) mark_[to] = 0, part.cells.push_back(to);
        };
        go(c % nx > 0, c - 1), go(c % nx + 1 < nx, c + 1), go(c >= nx, c - nx), go(c + nx < n, c + nx);
      }
      parts.push_back(std::move(part));
    }
    return parts;
  }

  void cover(Part whole) {
    const double total = whole.gain * square();
    if (total < options_.least_m3) return;
    double kept = 0;
    std::priority_queue<Part> parts;
    parts.push(std::move(whole));
    while (!parts.empty() && kept < options_.keep * total) {
      const Part part = parts.top();
      parts.pop();
      if (part.gain * square() < options_.least_m3) return;
      // A section for another part may have covered some of this one.
      if (std::all_of(part.cells.begin(), part.cells.end(), [&](uint32_t c) { return open(c); }))
        kept += cover_best(part) * square();
      Cells left;
      std::copy_if(part.cells.begin(), part.cells.end(), std::back_inserter(left),
                   [&](uint32_t c) { return open(c); });
      for (Part& p : connected_parts(left)) parts.push(std::move(p));
    }
  }

  /// \return what it gained, or 0 when it gave up on cells of the part.
  double cover_best(const Part& part) {
    const PrismHeights heights = best_heights(h_, part.cells);
    Cells cells;
    std::copy_if(part.cells.begin(), part.cells.end(), std::back_inserter(cells), [&](uint32_t c) {
      return h_.upper[c] >= heights.upper && h_.lower[c] <= heights.lower && h_.covered[c] < heights.upper;
    });
    cells = around_deepest(cells);
    if (heights.gain * square() >= options_.least_m3) {
      Section section = section_of(cells, heights);
      const double gained = section.polygon.size() < 3 ? 0 : gain_of(section, heights);
      if (gained * square() >= options_.least_m3) {
        mark_covered(section, heights);
        sections_.push_back(std::move(section));
        return gained;
      }
    }
    for (const uint32_t c : cells) h_.covered[c] = h_.upper[c];  // given up
    return 0;
  }

  /// Fills depth_ with the cells' distance from what is not among them (chessboard, in cells), and keeps of
  /// them what is connected with the deepest, which comes first.
  Cells around_deepest(const Cells& cells) {
    const auto nx = static_cast<uint32_t>(h_.samples.nx), n = static_cast<uint32_t>(h_.samples.size());
    Cells sorted = cells;
    std::sort(sorted.begin(), sorted.end());
    for (const uint32_t c : sorted) depth_[c] = std::numeric_limits<int>::max() - 1;
    const auto depth = [&](uint32_t c, int di, int dj) {
      const auto i = static_cast<int64_t>(c % nx) + di;
      const int64_t to = static_cast<int64_t>(c) + di + int64_t{dj} * nx;
      return i < 0 || i >= nx || to < 0 || to >= n ? 0 : depth_[static_cast<size_t>(to)];
    };
    for (const uint32_t c : sorted)
      depth_[c] = 1 + std::min({depth(c, -1, -1), depth(c, 0, -1), depth(c, 1, -1), depth(c, -1, 0)});
    int deepest = 0;
    for (auto c = sorted.rbegin(); c != sorted.rend(); ++c) {
      depth_[*c] = std::min(
          depth_[*c], 1 + std::min({depth(*c, 1, 1), depth(*c, 0, 1), depth(*c, -1, 1), depth(*c, 1, 0)}));
      deepest = std::max(deepest, depth_[*c]);
    }
    // Of the deepest, the one in the middle.
    glm::dvec2 sum(0);
    double count = 0;
    for (const uint32_t c : sorted) {
      if (depth_[c] == deepest) sum += glm::dvec2(c % nx, c / nx), ++count;
    }
    uint32_t seed = sorted.front();
    double nearest = std::numeric_limits<double>::infinity();
    for (const uint32_t c : sorted) {
      if (depth_[c] != deepest) continue;
      const glm::dvec2 off = glm::dvec2(c % nx, c / nx) - sum / count;
      const double distance2 = off.x * off.x + off.y * off.y;
      if (distance2 < nearest) nearest = distance2, seed = c;
    }
    for (const uint32_t c : sorted) depth_[c] = 0;
    for (Part& part : connected_parts(sorted)) {
      const auto at = std::find(part.cells.begin(), part.cells.end(), seed);
      if (at == part.cells.end()) continue;
      std::iter_swap(at, part.cells.begin());
      return std::move(part.cells);
    }
    return {seed};
  }

  glm::dvec2 point(uint32_t c) const {
    const auto nx = static_cast<uint32_t>(h_.samples.nx);
    return h_.samples.point(static_cast<int>(c % nx), static_cast<int>(c / nx));
  }

  Section section_of(const Cells& cells, const PrismHeights& heights) const {
    Section section;
    section.seed = point(cells.front());
    section.lower_m = heights.lower + options_.margin_m;
    section.upper_m = heights.upper - options_.margin_m;
    if (!columns_.sealed_at(section.seed, section.lower_m, section.upper_m)) return section;
    PlanBounds bounds{section.seed, section.seed};
    for (const uint32_t c : cells) {
      const glm::dvec2 p = point(c);
      bounds.lower = glm::min(bounds.lower, p), bounds.upper = glm::max(bounds.upper, p);
    }
    bounds.lower -= h_.samples.spacing_m, bounds.upper += h_.samples.spacing_m;
    std::vector<glm::dvec2> wanted;
    const size_t step = cells.size() / 400 + 1;
    for (size_t n = 0; n < cells.size(); n += step) wanted.push_back(point(cells[n]));
    const double foot = std::min<double>(h_.foot[cells.front()], section.upper_m);
    section.polygon = outline(section, bounds, foot, wanted);
    if (!stands(section, foot)) section.polygon = outline(section, bounds, -infinity, wanted);
    return section;
  }

  PlanPolygon outline(const Section& section, const PlanBounds& bounds, double foot,
                      const std::vector<glm::dvec2>& wanted) const {
    PlanPolygons obstacles;
    const size_t walls = pieces_.obstacles(bounds, section.lower_m, foot, section.upper_m, obstacles);
    const PlanPolygon start{
        bounds.lower, {bounds.upper.x, bounds.lower.y}, bounds.upper, {bounds.lower.x, bounds.upper.y}};
    PlanPolygon polygon = free_polygon(section.seed, start, obstacles, walls, wanted);
    simplify(polygon, 0.01);
    return polygon;
  }

  /// Pieces of ground reach in below the walls of a house, by up to two seeds, from where they are exposed
  /// outside. Where walls stand around the section above its foot and no seed below it was reached, what is
  /// below is as sealed as what is above: free space could come in through a gap narrower than two seeds
  /// only.
  bool stands(const Section& section, double foot) const {
    if (section.polygon.size() < 3 || !(foot > section.lower_m)) return true;
    PlanPolygons grown;
    add_grown(grown, section.polygon, options_.reach_m);
    return columns_.none_reached(grown.at(0), foot);
  }

  double gain_of(const Section& section, const PrismHeights& heights) const {
    double gained = 0;
    visit_cells(section, [&](uint32_t c) {
      gained += std::max(0.0, static_cast<double>(heights.upper) - h_.covered[c]);
    });
    return gained;
  }

  void mark_covered(const Section& section, const PrismHeights& heights) {
    visit_cells(section, [&](uint32_t c) { h_.covered[c] = std::max(h_.covered[c], heights.upper); });
  }

  template <typename Visit>
  void visit_cells(const Section& section, const Visit& visit) const {
    visit_samples(h_.samples, section.polygon, [&](int i0, int i1, int j) {
      for (int i = i0; i < i1; ++i) {
        const size_t c = static_cast<size_t>(j) * static_cast<size_t>(h_.samples.nx) + static_cast<size_t>(i);
        if (h_.wanted[c] != 0) visit(static_cast<uint32_t>(c));
      }
    });
  }

  SectionHeights& h_;
  const SectionPieces& pieces_;
  const SealedColumns& columns_;
  const CoverOptions& options_;
  std::vector<uint8_t> mark_;
  std::vector<int> depth_;
  std::vector<Section> sections_;
};

}  // namespace

std::vector<Section> cover_with_sections(SectionHeights& heights, const SectionPieces& pieces,
                                         const SealedColumns& columns, const CoverOptions& options) {
  return SectionCover(heights, pieces, columns, options).run();
}

}  // namespace veduta
