// The panorama on GL against the slow one on the CPU: depths, then answers, in a bracket of a looser and a
// stricter question.
#include "worker/panorama.h"

#include "tests/worker/panorama_fixture.h"
#include "worker/cube_face.h"

namespace veduta {
namespace {

using reference::Strictness;
using test::Random;
using test::World;

constexpr Strictness loose{0, 0}, alike{1.0 / 64, 0}, strict{1, 1e-3};

/// Whether occluders are boxes or convex bodies of many shapes.
class PanoramaTest : public test::GlTest, public testing::WithParamInterface<bool> {};
INSTANTIATE_TEST_SUITE_P(, PanoramaTest, testing::Values(true, false),
                         [](const auto& test) { return test.param ? "Boxes" : "Bodies"; });

const std::vector<glm::vec3> eyes{{0, 0, 1.7f}, {1.9f, -1.2f, 1.5f}, {-0.7f, 1.6f, 2.1f}};

/// near / depth around a pixel, as the reference has it: least and most of 3 x 3, and at the pixel itself.
struct Around {
  double least = 1e30, most = 0, here = 0;
  Around(const reference::Panorama& reference, int size, int face, int x, int y) {
    for (int b = std::max(y - 1, 0); b <= std::min(y + 1, size - 1); ++b) {
      for (int a = std::max(x - 1, 0); a <= std::min(x + 1, size - 1); ++a) {
        const double value = Panorama::near_m / reference.depth_m(face, a, b);  // 0 for none
        least = std::min(least, value), most = std::max(most, value);
        if (a == x && b == y) here = value;
      }
    }
  }
};

struct DepthDifferences {
  int equal = 0, silhouette = 0, farther = 0, nearer = 0, drawn = 0;
};

DepthDifferences compare_depths(const World& world, const glm::vec3& eye) {
  Panorama gl = world.panorama();
  test::ask_everything(gl, 0, {}, {eye});
  const reference::Panorama reference = world.reference(eye);
  DepthDifferences d;
  for (int face = 0; face < face_count; ++face) {
    const std::vector<float> depth = gl.read_face(face);
    for (int y = 0; y < world.resolution; ++y) {
      for (int x = 0; x < world.resolution; ++x) {
        const double got = depth[static_cast<size_t>(y) * world.resolution + x];
        const Around expected(reference, world.resolution, face, x, y);
        d.drawn += got > 0;
        if (std::abs(got - expected.here) <= 1e-3 * expected.here) {
          ++d.equal;
        } else if (got > expected.most * (1 + 1e-3)) {
          ++d.nearer;
        } else if (got < expected.least * (1 - 1e-3)) {
          ++d.farther;
        } else {
          ++d.silhouette;
        }
      }
    }
  }
  return d;
}

TEST_P(PanoramaTest, DepthsEqualTheReferenceSaveAtSilhouettes) {
  for (const uint32_t seed : {1u, 2u, 3u}) {
    const World world =
        test::random_world({.seed = seed, .occluders = 40, .objects = 1, .floating = 1, .boxes = GetParam()});
    for (const glm::vec3& eye : eyes) {
      const DepthDifferences d = compare_depths(world, eye);
      const int pixels = face_count * world.resolution * world.resolution;
      EXPECT_GE(d.equal, 0.98 * pixels) << "silhouette " << d.silhouette;
      EXPECT_EQ(d.nearer, 0);
      EXPECT_EQ(d.farther, 0);
      EXPECT_GT(d.drawn, pixels / 20);
    }
  }
}

TEST_P(PanoramaTest, TheHorizonLeavesOutLittleThatIsSeen) {
  for (const uint32_t seed : {4u, 5u, 6u}) {
    const World world =
        test::random_world({.seed = seed, .occluders = 60, .objects = 1, .boxes = GetParam()});
    for (const glm::vec3& eye : eyes) {
      const DepthDifferences d = compare_depths(world, eye);
      const int pixels = face_count * world.resolution * world.resolution;
      EXPECT_GE(d.equal, 0.95 * pixels) << "silhouette " << d.silhouette << ", farther " << d.farther;
      EXPECT_EQ(d.nearer, 0) << "an occluder where there is none";
      EXPECT_GT(d.drawn, pixels / 10);
    }
  }
}

/// How high a vertical slice is occluded. What is hidden hides all that is in it, though a box that is
/// smaller than the part may not be found hidden by itself (T2 asks for its middle alone). So the looser
/// question is for the highest of the nested boxes that is hidden, and the stricter one for the lowest that
/// is not.
uint32_t occluded_height(const World& world, const VerticalSlice& slice, const reference::Panorama& p,
                         const Strictness& strictness, bool highest) {
  uint32_t height = 0;
  for (uint32_t h = 0; h < slice.heights; ++h) {
    const Box& box = world.slices.boxes[slice.first_box + h];
    if (box.empty() || p.hidden(box, world.half_extent_m, strictness)) {
      height = h + 1;
    } else if (!highest) {
      break;
    }
  }
  return height;
}

struct Bracket {
  int hidden = 0, visible = 0, wrongly_hidden = 0, hidden_alone = 0, strictly_hidden = 0, missed = 0;
  int slices = 0, too_high = 0, too_low = 0;
};

Bracket bracket(const World& world, const glm::vec3& eye) {
  const Occlusion occlusion = world.occlusion({eye});
  const reference::Panorama p = world.reference(eye), rounded = world.reference(eye, 1.0 / 128);
  const glm::dvec3 e = world.half_extent_m;
  Bracket b;
  for (size_t o = 0; o < world.objects.size(); ++o) {
    const bool hidden = occlusion.visible[o] == 0, strictly = p.hidden(world.objects[o], e, strict);
    (hidden ? b.hidden : b.visible) += 1;
    b.wrongly_hidden += hidden && !rounded.hidden(world.objects[o], e, loose);
    b.hidden_alone += hidden && !p.hidden(world.objects[o], e, alike);
    b.strictly_hidden += strictly, b.missed += strictly && !hidden;
  }
  for (size_t s = 0; s < world.slices.slices.size(); ++s) {
    const VerticalSlice& slice = world.slices.slices[s];
    if (occlusion.visible[slice.object] == 0) {
      EXPECT_EQ(occlusion.occluded[s], slice.heights) << "of a hidden object all is hidden";
      continue;
    }
    ++b.slices;
    b.too_high += occlusion.occluded[s] > occluded_height(world, slice, rounded, loose, true);
    b.too_low += occlusion.occluded[s] < occluded_height(world, slice, p, strict, false);
  }
  return b;
}

TEST_P(PanoramaTest, AnswersLieBetweenALooserAndAStricterReference) {
  for (const int resolution : {32, 64, 128}) {
    World world =
        test::random_world({.seed = 7, .occluders = 150, .objects = 900, .floating = 1, .boxes = GetParam()});
    world.resolution = resolution;
    for (const glm::vec3& eye : eyes) {
      const Bracket b = bracket(world, eye);
      EXPECT_EQ(b.wrongly_hidden, 0);
      EXPECT_EQ(b.missed, 0) << "of " << b.strictly_hidden;
      EXPECT_EQ(b.too_high, 0) << "of " << b.slices;
      EXPECT_EQ(b.too_low, 0) << "of " << b.slices;
      EXPECT_GT(b.strictly_hidden, 20);
      EXPECT_GT(b.visible, 20);
    }
  }
}

TEST_P(PanoramaTest, WithTheHorizonWhatIsHiddenIsHiddenByAllOccludersToo) {
  int hidden = 0, hidden_alone = 0, strictly_hidden = 0, missed = 0;
  for (uint32_t seed = 10; seed < 14; ++seed) {
    World world = test::random_world({.seed = seed,
                                      .occluders = 250,
                                      .objects = 500,
                                      .floating = seed % 2 == 0 ? 0 : 0.4,
                                      .boxes = GetParam()});
    world.resolution = seed % 4 < 2 ? 64 : 128;
    for (const glm::vec3& eye : eyes) {
      const Bracket b = bracket(world, eye);
      EXPECT_EQ(b.wrongly_hidden, 0) << "seed " << seed;
      EXPECT_EQ(b.too_high, 0) << "seed " << seed;
      EXPECT_GT(b.hidden, 50) << "seed " << seed;
      strictly_hidden += b.strictly_hidden, missed += b.missed;
      hidden += b.hidden, hidden_alone += b.hidden_alone;
    }
  }
  RecordProperty("hidden", hidden);
  RecordProperty("hidden_alone", hidden_alone);
  RecordProperty("strictly_hidden", strictly_hidden);
  RecordProperty("missed", missed);
  // A silhouette may take a pixel or not; that no fewer are looked at shows in all others.
  EXPECT_LE(hidden_alone, hidden / 2000);
  EXPECT_LE(missed, strictly_hidden / 50) << "the horizon costs more than it should";
}

TEST_P(PanoramaTest, PartsAreUnited) {
  World world = test::random_world({.seed = 20, .occluders = 120, .objects = 300, .boxes = GetParam()});
  const Occlusion all = world.occlusion(eyes);
  std::vector<Occlusion> each;
  for (const glm::vec3& eye : eyes) each.push_back(world.occlusion({eye}));
  int differ = 0;
  for (size_t o = 0; o < world.objects.size(); ++o) {
    uint32_t visible = 0;
    for (const Occlusion& one : each) visible |= one.visible[o];
    ASSERT_EQ(all.visible[o], visible) << o;
    differ += each[0].visible[o] != visible;
  }
  EXPECT_GT(differ, 0) << "the parts see the same: nothing was tested";
  for (size_t s = 0; s < world.slices.slices.size(); ++s) {
    uint32_t least = world.slices.slices[s].heights;
    for (const Occlusion& one : each) least = std::min(least, one.occluded[s]);
    ASSERT_EQ(all.occluded[s], least) << s;
  }
}

TEST_P(PanoramaTest, AnswersDoNotDependOnWhatWasAskedBefore) {
  const World world = test::random_world({.seed = 21, .occluders = 120, .objects = 300, .boxes = GetParam()});
  const Occlusion first = world.occlusion({eyes[0], eyes[1]});
  Panorama again = world.panorama();
  for (const std::vector<glm::vec3>& centers :
       {std::vector{eyes[2]}, {eyes[0], eyes[1]}, {eyes[1], eyes[0]}}) {
    const Occlusion now = test::ask_everything(again, world.objects.size(), world.slices, centers);
    if (centers.size() == 1) continue;
    EXPECT_EQ(now.visible, first.visible);
    EXPECT_EQ(now.occluded, first.occluded);
  }
}

TEST_P(PanoramaTest, PanesGiveTheAnswersOfWholeFacesForFewQuestions) {
  World world = test::random_world({.seed = 22, .occluders = 150, .objects = 600, .boxes = GetParam()});
  world.resolution = 256;
  const Occlusion whole = world.occlusion({eyes[0]});
  Panorama panorama = world.panorama();
  QuestionBatch batch;
  std::vector<uint32_t> asked;
  int differ = 0, hidden = 0;
  for (uint32_t o = 0; o < world.objects.size(); o += 3) {
    batch.clear();
    batch.objects = {o};
    batch.parts.push_back({eyes[0], 0, false, 0, 1, 0, 0});
    for (uint32_t s = world.slices.object_slice_begin[o]; s < world.slices.object_slice_begin[o + 1]; ++s) {
      batch.slices.push_back({world.slices.slices[s].first_box, 0, world.slices.slices[s].heights, 0});
      ++batch.parts[0].slices;
    }
    panorama.ask(batch, static_cast<int>(o) % Panorama::slots);
    const std::vector<uint32_t>& answers = panorama.answers(static_cast<int>(o) % Panorama::slots);
    // The horizon works on what is drawn, so the two leave out different occluders now and then.
    differ += answers[0] != whole.visible[o];
    hidden += answers[0] == 0;
    for (uint32_t s = 0; s < batch.slices.size(); ++s)
      differ += answers[1 + s] != whole.occluded[world.slices.object_slice_begin[o] + s];
  }
  EXPECT_GT(hidden, 40);
  EXPECT_LE(differ, 6);
}

TEST_P(PanoramaTest, SlicesAreAskedBetweenWhatIsKnownAndWhatIsWorthToKnow) {
  const World world = test::random_world({.seed = 23, .occluders = 150, .objects = 300, .boxes = GetParam()});
  const Occlusion all = world.occlusion({eyes[1]});
  Panorama panorama = world.panorama();
  QuestionBatch batch;
  batch.parts.push_back({eyes[1], 0, true, 0, 0, 0, 0});
  std::vector<uint32_t> expected;
  for (uint32_t s = 0; s < world.slices.slices.size(); ++s) {
    const VerticalSlice& slice = world.slices.slices[s];
    if (all.visible[slice.object] == 0) continue;
    const uint32_t height = all.occluded[s], low = height / 2,
                   high = std::min(height + 1, slice.heights) - s % 2;
    batch.slices.push_back({slice.first_box, low, high});
    expected.push_back(std::max(low, std::min(height, high)));
  }
  batch.parts[0].slices = static_cast<uint32_t>(batch.slices.size());
  panorama.ask(batch, 0);
  const std::span<const uint32_t> answers = panorama.answers(0);
  ASSERT_EQ(answers.size(), expected.size());
  // Of nested boxes that T2 leaves no thickness the larger may be hidden and the smaller not: then it matters
  // where the bisection begins, and either answer is a height that is hidden.
  size_t differ = 0;
  for (size_t n = 0; n < answers.size(); ++n) {
    EXPECT_GE(answers[n], batch.slices[n].low);
    EXPECT_LE(answers[n], expected[n]) << n;
    differ += answers[n] != expected[n];
  }
  EXPECT_LE(differ, expected.size() / 50);
  EXPECT_GT(expected.size(), 50u);
}

}  // namespace
}  // namespace veduta
