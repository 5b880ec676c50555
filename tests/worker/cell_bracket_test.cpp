// Bracket and refine against an oracle that answers by tables instead of pictures: what each smallest part
// sees, and how much less a larger part can tell.
#include "worker/cell_bracket.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/verify/toy_city.h"
#include "tests/worker/mesh.h"
#include "worker/cell_windows.h"

namespace veduta {
namespace {

constexpr int finest = 8;

/// A cell in a closed room, so that rays see the room and no more, among other buildings.
struct Room {
  City city;
  SliceBoxes slices;
  Settings settings;
  std::vector<WindowOccluders> windows;
  std::vector<Box> bounds;

  explicit Room(double max_overestimate) {
    Scene scene;
    const float far = 11, near = 10, top = 9;
    toy::add_box(scene, "floor", {{-20, -20, -0.2f}, {30, 30, 0}}, Kind::terrain);
    for (const Box& wall : {Box{{-3, -3, 0}, {-2, far, top}}, Box{{near, -3, 0}, {far, far, top}},
                            Box{{-3, -3, 0}, {far, -2, top}}, Box{{-3, near, 0}, {far, far, top}},
                            Box{{-3, -3, top}, {far, far, top + 1}}})
      toy::add_box(scene, "room", wall);
    for (int n = 0; n < 20; ++n) {
      const auto x = static_cast<float>(15 + n % 5 * 8), y = static_cast<float>(n / 5 * 8 - 10);
      toy::add_box(scene, "house", {{x, y, 0}, {x + 5, y + 5, 8}});
    }
    PvsFile file = toy::make_file(std::move(scene), {{{0, 0, 1}, {8, 8, 2}}}, {{}});
    city = std::move(file.city);
    city.slices.assign(city.scene.objects.size(), {2, 3, 4});
    city.triangle_slices = slice_triangles(city.scene, city.slices);
    slices = slice_boxes(city.scene, city.slices, city.triangle_slices);
    settings.cells.size_m = 8, settings.cells.height_m = 1;
    settings.occlusion.subdivide = finest, settings.occlusion.max_overestimate = max_overestimate;
    for (const glm::dvec3& e : window_half_extents(settings)) windows.push_back({e, {}});
    bounds = object_boxes(input());
  }
  OcclusionInput input() const { return {city, slices, windows, settings}; }
  size_t objects() const { return city.scene.objects.size(); }
};

constexpr uint32_t houses_begin = 6;

/// What the smallest parts see.
struct Oracle {
  const Room& room;
  double looseness;  ///< how often a larger part cannot tell what its smallest parts can
  test::Random random;
  std::vector<std::array<bool, finest * finest>> sees;         // [N]
  std::vector<std::array<uint32_t, finest * finest>> heights;  // [vertical slices]
  std::map<std::pair<int, int>, std::set<uint32_t>> hidden;    // by parts and number of the part: answered so

  Oracle(const Room& asked, uint32_t seed, double loose) : room(asked), looseness(loose), random(seed) {
    sees.resize(room.objects()), heights.resize(room.slices.slices.size());
    for (uint32_t o = 0; o < room.objects(); ++o) {
      const double share = o < houses_begin ? 1.0 : random.chance(0.5) ? 0.0 : random.real(0, 0.3);
      for (bool& part : sees[o]) part = random.chance(share);
    }
    for (uint32_t s = 0; s < heights.size(); ++s) {
      const bool house = room.slices.slices[s].object >= houses_begin;
      for (uint32_t& height : heights[s]) height = house ? static_cast<uint32_t>(random.real(0, 3.999)) : 0;
    }
  }

  template <typename Visit>
  static void each_smallest(int parts, int i, int j, const Visit& visit) {
    const int k = finest / parts;
    for (int b = j * k; b < (j + 1) * k; ++b)
      for (int a = i * k; a < (i + 1) * k; ++a) visit(b * finest + a);
  }
  bool visible(uint32_t o, int parts, int i, int j) {
    bool any = parts < finest && random.chance(looseness);
    each_smallest(parts, i, j, [&](int part) { any = any || sees[o][part]; });
    return any;
  }
  uint32_t height(uint32_t s, int parts, int i, int j) {
    uint32_t least = 4;
    each_smallest(parts, i, j, [&](int part) {
      if (sees[room.slices.slices[s].object][part]) least = std::min(least, heights[s][part]);
    });
    return parts < finest && least > 0 && random.chance(looseness) ? least - 1 : least;
  }

  std::vector<uint32_t> answer(const QuestionBatch& batch) {
    std::vector<uint32_t> objects(batch.objects.size()), slices(batch.slices.size());
    for (const QuestionBatch::Part& part : batch.parts) {
      const int parts = finest >> part.window;
      const double edge = 8.0 / parts;
      const int i = static_cast<int>(part.center.x / edge), j = static_cast<int>(part.center.y / edge);
      EXPECT_NEAR(part.center.x, (i + 0.5) * edge, 1e-4);
      for (uint32_t q = part.first_object; q < part.first_object + part.objects; ++q) {
        const uint32_t o = batch.objects[q];
        for (int coarse = 1; coarse < parts; coarse *= 2) {
          const int number = j * coarse / parts * coarse + i * coarse / parts;
          EXPECT_EQ((hidden[{coarse, number}].count(o)), 0u) << "the whole has hidden it";
        }
        objects[q] = visible(o, parts, i, j);
        if (objects[q] == 0) hidden[{parts, j * parts + i}].insert(o);
      }
      for (uint32_t q = part.first_slice; q < part.first_slice + part.slices; ++q) {
        const SliceQuestion& asked = batch.slices[q];
        const uint32_t s = slice_of(asked.first_box), found = height(s, parts, i, j);
        const bool seen = asked.object == SliceQuestion::always || objects[asked.object] != 0;
        slices[q] = seen ? std::max(asked.low, std::min(found, asked.high)) : asked.high;
      }
    }
    objects.insert(objects.end(), slices.begin(), slices.end());
    return objects;
  }
  uint32_t slice_of(uint32_t first_box) const {
    for (uint32_t s = 0; s < room.slices.slices.size(); ++s)
      if (room.slices.slices[s].first_box == first_box) return s;
    ADD_FAILURE() << "no slice begins with box " << first_box;
    return 0;
  }
};

struct Outcome {
  CellOcclusion found;
  int batches = 0, smallest_parts = 0;
  size_t questions = 0;
};

Outcome run(const Room& room, CellBracket& bracket, Oracle& oracle) {
  Outcome outcome;
  bracket.begin(0);
  QuestionBatch batch;
  while (bracket.next(batch)) {
    ++outcome.batches;
    outcome.questions += batch.objects.size();
    for (const QuestionBatch::Part& part : batch.parts) outcome.smallest_parts += part.window == 0;
    bracket.take(oracle.answer(batch));
    EXPECT_LT(outcome.batches, 100);
    if (outcome.batches == 100) break;
  }
  outcome.found = bracket.result();
  EXPECT_EQ(outcome.found.occlusion.visible.size(), room.objects());
  return outcome;
}

void expect_conservative(const Room& room, const Oracle& oracle, const CellOcclusion& found) {
  for (uint32_t o = 0; o < room.objects(); ++o) {
    const bool seen = std::count(oracle.sees[o].begin(), oracle.sees[o].end(), true) > 0;
    if (seen) {
      EXPECT_EQ(found.occlusion.visible[o], 1u) << o;
    }
    for (uint32_t s = room.slices.object_slice_begin[o]; s < room.slices.object_slice_begin[o + 1]; ++s) {
      for (int part = 0; part < finest * finest; ++part) {
        if (oracle.sees[o][part]) {
          EXPECT_LE(found.occlusion.occluded[s], oracle.heights[s][part]) << o;
        }
      }
    }
  }
}

TEST(CellBracket, FindsWhatTheSmallestPartsSeeAndNoMore) {
  const Room room(1);
  const SeenSampler sampler(room.city, room.slices);
  CellBracket bracket(room.input(), sampler, room.bounds);
  int hidden = 0;
  for (uint32_t seed = 0; seed < 20; ++seed) {
    Oracle oracle(room, seed, 0.3 * (seed % 3));
    const Outcome outcome = run(room, bracket, oracle);
    expect_conservative(room, oracle, outcome.found);
    for (uint32_t o = houses_begin; o < room.objects(); ++o) {
      const bool seen = std::count(oracle.sees[o].begin(), oracle.sees[o].end(), true) > 0;
      EXPECT_EQ(outcome.found.occlusion.visible[o] != 0, seen) << "seed " << seed << ", object " << o;
      hidden += !seen;
    }
    EXPECT_GE(outcome.found.seen_objects, 2u) << "of floor and room";
    EXPECT_LE(outcome.found.seen_objects, houses_begin) << "the room is closed";
  }
  EXPECT_GT(hidden, 100);
}

TEST(CellBracket, StopsWhereTheBoundsAreAsCloseAsAsked) {
  const Room exact(1), loose(100);
  const SeenSampler sampler(exact.city, exact.slices);
  CellBracket fine(exact.input(), sampler, exact.bounds);
  CellBracket coarse(loose.input(), sampler, loose.bounds);
  for (uint32_t seed = 0; seed < 5; ++seed) {
    Oracle one(exact, seed, 0.5), other(loose, seed, 0.5);
    const Outcome all = run(exact, fine, one), some = run(loose, coarse, other);
    expect_conservative(loose, other, some.found);
    EXPECT_EQ(some.smallest_parts, 0);
    EXPECT_GT(all.smallest_parts, 0);
    EXPECT_LT(some.questions, all.questions / 2);
  }
}

TEST(CellBracket, AsksNothingOfACellWithoutAPlaceForAnEye) {
  Room room(1);
  room.city.cells[0] = {{-200, -200, 1}, {-192, -192, 2}};
  const SeenSampler sampler(room.city, room.slices);
  CellBracket bracket(room.input(), sampler, room.bounds);
  bracket.begin(0);
  QuestionBatch batch;
  EXPECT_FALSE(bracket.next(batch));
  for (const uint32_t visible : bracket.result().occlusion.visible) EXPECT_EQ(visible, 0u);
}

TEST(CellBracket, OccludersForOtherPartsAreADefect) {
  Room room(1);
  for (WindowOccluders& window : room.windows) window.half_extent_m *= 0.1;
  const SeenSampler sampler(room.city, room.slices);
  CellBracket bracket(room.input(), sampler, room.bounds);
  EXPECT_ANY_THROW(bracket.begin(0));
}

}  // namespace
}  // namespace veduta
