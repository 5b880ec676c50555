// Every method against the reference, cell by cell, on toy cities and a real one; and breaks that the check
// must notice.
#include "worker/occlusion_method.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <memory>

#include "scene/import.h"
#include "tests/worker/occlusion_checks.h"
#include "tests/worker/shrink_cities.h"

namespace veduta {
namespace {

using test::OcclusionCity;

constexpr size_t eyes = 12;  // of a cell: its corners, and more

/// Turned blocks with a street between any two, some of them tall, and small things in the streets.
void add_blocks(OcclusionCity& city) {
  test::Random random(5);
  city.add_ground(52);
  for (int j = -3; j <= 3; ++j) {
    for (int i = -3; i <= 3; ++i) {
      const std::string name = std::to_string(i + 3) + "_" + std::to_string(j + 3);
      city.add("bin_" + name, {14 * i + 0.2, 14 * j + 0.3, 0}, {14 * i + 0.9, 14 * j + 0.8, 1.2});
      const glm::dvec2 middle(14 * i + 7, 14 * j + 7);
      const double angle = random.real(0, 1.6), w = random.real(3, 4.5), d = random.real(3, 4.5);
      std::vector<glm::dvec2> outline;
      for (const auto& [x, y] : {std::pair{-w, -d}, {w, -d}, {w, d}, {-w, d}})
        outline.push_back(middle + glm::dvec2(x * std::cos(angle) - y * std::sin(angle),
                                              x * std::sin(angle) + y * std::cos(angle)));
      city.begin("block_" + name);
      city.add_prism(outline, 0, random.chance(0.15) ? random.real(15, 30) : random.real(5, 9));
    }
  }
  city.settings.cells.size_m = 3;
  city.cells_within(-4, -4, 5, 5);
}

/// One plot of each kind of tests/worker/shrink_cities.h.
void add_plots(OcclusionCity& city) {
  test::ShrinkCity plots(3);
  test::Random random(4);
  plots.earth(-36, 36, -1, 0, 0);
  // Gaps that may count as closed are seen through by rays.
  constexpr std::array closed{test::Plot::row_gap, test::Plot::hole_closed, test::Plot::hole_between};
  int n = 0;
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 5; ++i) {
      if (i == 2 && j == 2) continue;  // where the viewer is
      auto plot = static_cast<test::Plot>(n++ % static_cast<int>(test::Plot::count));
      if (std::ranges::count(closed, plot) > 0) plot = test::Plot::box;
      plots.plot(plot, {14 * (i - 2), 14 * (j - 2), 0}, random.real(0, 6.28));
    }
  }
  city.add_scene(plots.mesh.scene);
  city.settings.cells.size_m = 2;
  city.cells_within(-3, -3, 5, 3);
}

/// A square of Den Haag, its row houses and its earth.
void add_den_haag(OcclusionCity& city) {
  const std::filesystem::path file = VEDUTA_TEST_DATA "/denhaag/denhaag.city.json";
  if (!std::filesystem::exists(file)) return;
  const Scene scene = import_scene({file}, {.terrain_tile_m = 16}).scene;
  const glm::vec3 middle(glm::dvec3(78530, 457830, 0) -
                         glm::dvec3(scene.origin[0], scene.origin[1], scene.origin[2]));
  const Box square{{middle.x - 45, middle.y - 45, -1e9f}, {middle.x + 45, middle.y + 45, 1e9f}};
  Scene part = scene;
  std::erase_if(part.objects, [&](const Object& object) {
    Box box;
    for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t) {
      for (int c = 0; c < 3; ++c) box.extend(scene.vertices[scene.triangles[t][c]]);
    }
    return !square.contains(box.lower) || !square.contains(box.upper);
  });
  city.add_scene(part);
  city.settings.cells.size_m = 4;
  city.cells_within(middle.x - 8, middle.y - 8, middle.x + 8, middle.y + 8);
}

struct TestCity {
  const char* name;
  void (*add)(OcclusionCity&);
  size_t cells;         ///< how many are baked
  double most_visible;  ///< objects that a method calls visible, of those that it has to
};
constexpr std::array<TestCity, 3> test_cities{
    {{"Blocks", add_blocks, 4, 1.3}, {"Plots", add_plots, 4, 1.3}, {"DenHaag", add_den_haag, 3, 1.3}}};

/// A city that was prepared, its reference, and what each method says of some of its cells.
struct Prepared {
  explicit Prepared(const TestCity& wanted) {
    city.settings.occlusion.subdivide = 4, city.settings.occlusion.resolution = 512;
    wanted.add(city);
    city.prepare();
    smaller = city.drop_smallest_parts();
    const size_t all = city.city().cells.size(), count = std::min(all, wanted.cells);
    for (size_t n = 0; n < count; ++n) cells.push_back(static_cast<uint32_t>(n * all / count));
    city.add_probes(300, cells, 1);
    exact.emplace(city.input());
  }
  /// zoom is slow: it gets one.
  std::vector<uint32_t> cells_for(const std::string& method) const {
    return method == "zoom" ? std::vector{cells.front()} : cells;
  }
  const std::vector<CellOcclusion>& answers(const std::string& method) {
    auto& found = answers_[method];
    if (found.empty()) found = test::answers_of(method, city.input(), cells_for(method));
    return found;
  }

  OcclusionCity city;
  WindowOccluders smaller;  ///< occluders for parts half as large as the smallest that are used
  std::optional<reference::CellReference> exact;
  std::vector<uint32_t> cells;

 private:
  std::map<std::string, std::vector<CellOcclusion>> answers_;
};

class OcclusionMethods : public testing::TestWithParam<std::tuple<std::string, TestCity>> {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_GL();
    const TestCity& wanted = std::get<1>(GetParam());
    auto& kept = prepared_cities()[wanted.name];
    if (!kept && std::string(wanted.name) == "DenHaag" &&
        !std::filesystem::exists(VEDUTA_TEST_DATA "/denhaag/denhaag.city.json"))
      GTEST_SKIP() << "no tests/data/denhaag/denhaag.city.json here";
    if (!kept) kept = std::make_unique<Prepared>(wanted);
    prepared = kept.get();
  }
  static void TearDownTestSuite() { prepared_cities().clear(); }

  const std::string& method() const { return std::get<0>(GetParam()); }

  size_t noticed(const std::vector<WindowOccluders>& windows) const {
    return test::noticed(prepared->city, *prepared->exact, method(), windows, prepared->cells_for(method()),
                         eyes);
  }

  Prepared* prepared = nullptr;

 private:
  static std::map<std::string, std::unique_ptr<Prepared>>& prepared_cities() {
    static std::map<std::string, std::unique_ptr<Prepared>> all;
    return all;
  }
};
std::string parameter_name(const testing::TestParamInfo<OcclusionMethods::ParamType>& test) {
  return std::get<0>(test.param) + "_" + std::get<1>(test.param).name;
}
INSTANTIATE_TEST_SUITE_P(, OcclusionMethods,
                         testing::Combine(testing::ValuesIn(test::occlusion_methods),
                                          testing::ValuesIn(test_cities)),
                         parameter_name);

TEST_P(OcclusionMethods, HideNothingThatIsSeenAndNothingThatNoOccluderHides) {
  test::expect_nothing_wrong(prepared->city, *prepared->exact, prepared->answers(method()), 100'000, eyes);
}

TEST_P(OcclusionMethods, HideMostOfWhatTheirOccludersHide) {
  const OcclusionCity& city = prepared->city;
  uint64_t objects = 0, visible = 0, least_visible = 0, occluded = 0, most_occluded = 0;
  for (const CellOcclusion& answer : prepared->answers(method())) {
    const Occlusion ideal = prepared->exact->ideal(answer.cell);
    objects += ideal.visible.size();
    for (size_t o = 0; o < ideal.visible.size(); ++o)
      visible += answer.occlusion.visible[o] != 0, least_visible += ideal.visible[o] != 0;
    for (size_t s = 0; s < ideal.occluded.size(); ++s) {
      const uint32_t object = city.slices().slices[s].object;
      if (ideal.visible[object] == 0 || answer.occlusion.visible[object] == 0) continue;
      occluded += answer.occlusion.occluded[s], most_occluded += ideal.occluded[s];
    }
  }
  RecordProperty("visible", std::to_string(visible) + " of " + std::to_string(least_visible));
  RecordProperty("occluded", std::to_string(occluded) + " of " + std::to_string(most_occluded));
  EXPECT_LE(visible, std::get<1>(GetParam()).most_visible * least_visible);
  EXPECT_LT(least_visible, 0.7 * objects) << "nothing is hidden in this city: it tests nothing";
  // zoom does not take slices smaller by the part; panorama asks slices of what looks large of larger parts
  // than objects.
  EXPECT_GE(occluded, (method() == "zoom" ? 0.3 : 0.2) * most_occluded);
}

/// What takes many bakes, and is about the check more than about the method: without zoom, which is slow.
class OcclusionCheck : public OcclusionMethods {};
INSTANTIATE_TEST_SUITE_P(, OcclusionCheck,
                         testing::Combine(testing::Values("panorama"), testing::ValuesIn(test_cities)),
                         parameter_name);

TEST_P(OcclusionCheck, AnswerTheSameWhateverWasAskedBefore) {
  const auto& first = prepared->answers(method());
  const std::vector<uint32_t> backwards(prepared->cells.rbegin(), prepared->cells.rend());
  auto again = test::answers_of(method(), prepared->city.input(), backwards);
  std::reverse(again.begin(), again.end());
  ASSERT_EQ(first.size(), again.size());
  for (size_t c = 0; c < first.size(); ++c) {
    EXPECT_EQ(first[c].cell, again[c].cell);
    EXPECT_EQ(first[c].occlusion.visible, again[c].occlusion.visible);
    EXPECT_EQ(first[c].occlusion.occluded, again[c].occlusion.occluded);
  }
}

std::vector<WindowOccluders> grown(std::vector<WindowOccluders> windows, float times) {
  for (WindowOccluders& window : windows) {
    for (OccluderRing& ring : window.rings) {
      OccluderMesh& mesh = ring.occluders;
      for (size_t b = 0; b < mesh.bodies(); ++b) {
        const glm::vec3 middle = mesh.bounds(b).center();
        for (uint32_t c = mesh.face_begin[mesh.body_begin[b]]; c < mesh.face_begin[mesh.body_begin[b + 1]];
             ++c)
          mesh.corners[c] = middle + times * (mesh.corners[c] - middle);
      }
    }
  }
  return windows;
}

TEST_P(OcclusionCheck, OccludersThatAreTooLargeAreNoticed) {
  EXPECT_GT(noticed(grown(prepared->city.windows(), 1.2f)), 0u);
}

TEST_P(OcclusionCheck, OccludersForSmallerPartsAreNoticed) {
  auto windows = prepared->city.windows();
  for (WindowOccluders& window : windows) {
    for (size_t r = 0; r < window.rings.size(); ++r)
      window.rings[r].occluders = prepared->smaller.rings.at(r).occluders;
  }
  EXPECT_GT(noticed(windows), 0u);
}

}  // namespace
}  // namespace veduta
