// Cases of the panorama that have a name: thin occludees, the near plane, the cube's edges, the limits of
// rings.
#include "tests/worker/panorama_fixture.h"
#include "worker/cube_face.h"

namespace veduta {
namespace {

using test::hidden_behind;

constexpr glm::vec3 eye{0, 0, 1.7f}, e{1, 1, 0.5f};
const Box wall{{10, -5, -2}, {12, 5, 8}};  // seen from the eye: right / forward within 0.5

class PanoramaCase : public test::GlTest {};

TEST_F(PanoramaCase, BehindAWallAndBeforeIt) {
  EXPECT_TRUE(hidden_behind({wall}, {{20, -2, 0}, {22, 2, 4}}, eye));
  EXPECT_FALSE(hidden_behind({wall}, {{6, -2, 0}, {8, 2, 4}}, eye));
  EXPECT_FALSE(hidden_behind({wall}, {{20, -2, 0}, {22, 2, 40}}, eye)) << "taller";
  EXPECT_FALSE(hidden_behind({wall}, {{20, -12, 0}, {22, 2, 4}}, eye)) << "wider";
  EXPECT_FALSE(hidden_behind({}, {{20, -2, 0}, {22, 2, 4}}, eye));
  EXPECT_FALSE(hidden_behind({wall}, {{9, -2, 0}, {22, 2, 4}}, eye)) << "in it and before it";
}

TEST_F(PanoramaCase, ThinOccludeesAreTested) {
  for (const glm::vec3& half : {glm::vec3(0, 2, 1), glm::vec3(2, 0, 1), glm::vec3(2, 2, 0),
                                glm::vec3(0, 0, 1), glm::vec3(0, 2, 0), glm::vec3(2, 0, 0), glm::vec3(0)}) {
    const glm::vec3 behind(20, 1, 2), before(6, 1, 2), beside(20, 14, 2);
    for (const glm::vec3& margin : {glm::vec3(0), e}) {
      EXPECT_TRUE(hidden_behind({wall}, {behind - half, behind + half}, eye, margin));
      EXPECT_FALSE(hidden_behind({wall}, {before - half, before + half}, eye, margin));
      EXPECT_FALSE(hidden_behind({wall}, {beside - half, beside + half}, eye, margin));
    }
  }
}

TEST_F(PanoramaCase, AnOccludeeIsTakenSmallerByThePartAndNoMore) {
  // The wall's silhouette is at y = 10 at a depth of 20.
  const auto box = [](float y, float half) {
    return Box{{20 - half, y - half, 1}, {20 + half, y + half, 2}};
  };
  EXPECT_TRUE(hidden_behind({wall}, box(9, 0.9f), eye, e)) << "a point within";
  EXPECT_FALSE(hidden_behind({wall}, box(9, 0.9f), eye)) << "a box across";
  EXPECT_TRUE(hidden_behind({wall}, box(7, 2), eye, e));
  EXPECT_FALSE(hidden_behind({wall}, box(9, 2.5f), eye, e))
      << "1.5 m are left, to y = 10.5 at a depth of 18.5";
}

TEST_F(PanoramaCase, AtTheEyeAndBelowIsVisible) {
  // Walls all around and a roof, 3 m away.
  const std::vector<Box> room{{{3, -9, -9}, {5, 9, 9}},
                              {{-5, -9, -9}, {-3, 9, 9}},
                              {{-9, 3, -9}, {9, 5, 9}},
                              {{-9, -5, -9}, {9, -3, 9}},
                              {{-9, -9, 5}, {9, 9, 7}}};
  EXPECT_TRUE(hidden_behind(room, {{20, 20, 1}, {25, 25, 5}}, eye));
  EXPECT_FALSE(hidden_behind(room, {{-1, -1, 1}, {1, 1, 2}}, eye)) << "around the eye";
  EXPECT_FALSE(hidden_behind(room, {{0.02f, -1, 1}, {30, 1, 2}}, eye)) << "from before the near plane on";
  EXPECT_FALSE(hidden_behind(room, {{-1, -1, -2}, {1, 1, -1}}, eye)) << "below";
  EXPECT_FALSE(hidden_behind(room, {{-50, -50, -2}, {50, 50, -1}}, eye)) << "the ground";
  EXPECT_FALSE(hidden_behind(room, {{10, 10, -90}, {11, 11, 1}}, eye)) << "partly below";
  EXPECT_TRUE(hidden_behind(room, {{10, 10, -7}, {11, 11, 1}}, eye)) << "not below: within 45 degrees";
}

TEST_F(PanoramaCase, AcrossTheEdgesOfTheCube) {
  const Box east{{10, -10.5f, -2}, {12, 10.5f, 10}}, north{{-10.5f, 10, -2}, {10.5f, 12, 10}};
  const Box west{{-12, -10.5f, -2}, {-10, 10.5f, 10}}, south{{-10.5f, -12, -2}, {10.5f, -10, 10}};
  const Box roof{{-20, -20, 8}, {20, 20, 9}};
  const Box north_east{{28, 25, 0}, {32, 35, 6}}, south_west{{-32, -35, 0}, {-26, -28, 6}};
  EXPECT_TRUE(hidden_behind({east, north}, north_east, eye));
  EXPECT_FALSE(hidden_behind({east}, north_east, eye));
  EXPECT_FALSE(hidden_behind({north}, north_east, eye));
  EXPECT_TRUE(hidden_behind({south, west}, south_west, eye));
  EXPECT_FALSE(hidden_behind({east, north, west}, south_west, eye));
  EXPECT_FALSE(hidden_behind({south, north, east}, south_west, eye));
  const Box high{{11.5f, -1, 11}, {13, 1, 16}};  // on +x and on +z
  EXPECT_TRUE(hidden_behind({east, roof}, high, eye));
  EXPECT_FALSE(hidden_behind({east}, high, eye));
  EXPECT_FALSE(hidden_behind({roof}, {{11.5f, -1, 0}, {13, 1, 16}}, eye));
  const Box all_around{{-40, -40, 12}, {40, 40, 14}};  // on all five faces
  EXPECT_TRUE(hidden_behind({east, north, west, south, roof}, all_around, eye));
  EXPECT_FALSE(hidden_behind({east, north, west, south}, all_around, eye));
  EXPECT_FALSE(hidden_behind({east, north, west, roof}, all_around, eye));
}

TEST_F(PanoramaCase, OccludersFuseButAGapIsAGap) {
  const Box left{{10, -5, -2}, {12, 0, 8}}, right{{10, 0, -2}, {12, 5, 8}}, apart{{10, 1, -2}, {12, 5, 8}};
  const Box object{{20, -2, 0}, {22, 4, 4}};
  EXPECT_TRUE(hidden_behind({left, right}, object, eye));
  EXPECT_FALSE(hidden_behind({left, apart}, object, eye));
}

TEST_F(PanoramaCase, NothingIsDrawnBeyondARingsLimit) {
  EXPECT_TRUE(hidden_behind({wall}, {{20, -2, 0}, {22, 2, 4}}, eye, {}, 10.5f));
  EXPECT_FALSE(hidden_behind({wall}, {{20, -2, 0}, {22, 2, 4}}, eye, {}, 9.5f));
  // A wall along the view crosses the limit: what is nearer is drawn, what is farther is not.
  constexpr float limit = 15;
  test::World world;
  world.rings.push_back(
      {0.25, limit, test::mesh_of({{{5, 4, -2}, {40, 6, 9}}, {{16, -9, -2}, {18, -2, 9}}})});
  world.objects.push_back(wall);
  Panorama p = world.panorama();
  test::ask_everything(p, world.objects.size(), {}, {eye});
  float farthest = 0;
  for (int face = 0; face < face_count; ++face) {
    for (const float value : p.read_face(face)) {
      if (value > 0) farthest = std::max(farthest, Panorama::near_m / value);
    }
  }
  EXPECT_LE(farthest, limit * (1 + 1e-5f));
  EXPECT_GT(farthest, 0.85f * limit);
}

TEST_F(PanoramaCase, ABoxAroundTheEyeHidesNothing) {
  EXPECT_FALSE(hidden_behind({{{-3, -3, -3}, {3, 3, 5}}}, {{20, -2, 0}, {22, 2, 4}}, eye));
}

TEST_F(PanoramaCase, ASlantedBodyHidesWhatItsSilhouetteCovers) {
  test::Faces gable{{{12, -5, -2}, {12, 5, -2}, {12, 5, 4}, {12, 0, 9}, {12, -5, 4}},
                    {{10, 5, -2}, {10, -5, -2}, {10, -5, 4}, {10, 0, 9}, {10, 5, 4}}};
  test::World world;
  OccluderMesh mesh;
  test::add_body(mesh, gable, {0, 0, 0});
  world.rings.push_back({0.25, 100, mesh});
  // At a depth of 20 the silhouette is at y = 10 up to 6.3 m, the ridge at 16.3 m above y = 0.
  world.object({{20, -1, 0}, {21, 1, 14}});
  world.object({{20, 6, 0}, {21, 8, 6}});
  world.object({{20, -1, 0}, {21, 1, 18}});  // above the ridge
  world.object({{20, 6, 0}, {21, 8, 14}});   // beside the ridge, in the bounds
  EXPECT_EQ(world.occlusion({eye}).visible, (std::vector<uint32_t>{0, 0, 1, 1}));
}

TEST_F(PanoramaCase, AWallOfManyBodiesHidesAsOne) {
  std::vector<Box> bricks;  // more than are drawn at a time
  for (int y = 0; y < 170; ++y) {
    for (int z = 0; z < 120; ++z) {
      const auto at = [](int n) { return -5 + 0.0625f * static_cast<float>(n); };
      bricks.push_back({{10, at(y), at(z) + 3}, {10.1f, at(y + 1), at(z + 1) + 3}});
    }
  }
  EXPECT_TRUE(hidden_behind(bricks, {{20, -2, 0}, {22, 2, 4}}, eye));
  bricks.erase(bricks.begin() + 76 * 120, bricks.begin() + 84 * 120);  // a slit of two pixels
  EXPECT_FALSE(hidden_behind(bricks, {{20, -2, 0}, {22, 2, 4}}, eye));
}

TEST_F(PanoramaCase, EachPartHasItsWindow) {
  // A wall in the east for large parts, one in the west for small ones; other pixels for each.
  const std::vector<WindowOccluders> windows{
      {{1, 1, 0.5}, {{1.6, 100, test::mesh_of({{{-12, -5, -2}, {-10, 5, 8}}})}}},
      {{3, 3, 1}, {{3.2, 100, test::mesh_of({{{10, -5, -2}, {12, 5, 8}}})}}}};
  const std::vector<Box> objects{{{20, -2, 0}, {22, 2, 4}}, {{-22, -2, 0}, {-20, 2, 4}}};
  Panorama p(objects, {}, windows);
  EXPECT_EQ(p.resolution(0), 64);
  EXPECT_EQ(p.resolution(1), 32);
  for (const bool everywhere : {true, false}) {
    QuestionBatch batch;
    batch.objects = {0, 1, 1, 0};
    batch.parts = {{eye, 0, everywhere, 0, 2, 0, 0}, {eye, 1, everywhere, 2, 2, 0, 0}};
    p.ask(batch, 1);
    EXPECT_EQ(p.answers(1), (std::vector<uint32_t>{1, 0, 1, 0}));
  }
}

TEST_F(PanoramaCase, AnEmptyCityIsAllVisible) {
  test::World world;
  EXPECT_TRUE(world.occlusion({eye}).visible.empty());
  world.objects.push_back(wall);
  world.rings.push_back({0.25, 100, {}});
  EXPECT_EQ(world.occlusion({eye}).visible, std::vector<uint32_t>{1});
}

TEST_F(PanoramaCase, AnOccludedHeightIsThatOfTheHorizon) {
  test::World world;
  world.rings.push_back(
      {0.25, 100,
       test::mesh_of({{{10, -30, -2}, {12, 30, 5.7f}}})});  // rises 4 m above the eye in 10: 8 m in 20
  world.object({{20, -4, 0}, {20.5f, 4, 20}});              // hidden up to 9.7 m, less a pixel or two
  for (int storey = 0; storey < 20; ++storey) {             // walls in one piece could not be left out below
    const auto z = static_cast<float>(storey);
    world.mesh.box({{20, -4, z}, {20.5f, 4, z + 0.9f}});
  }
  world.resolution = 512;
  world.slice({1, 2, 20});
  const Occlusion occlusion = world.occlusion({eye});
  EXPECT_EQ(occlusion.visible[0], 1u);
  for (const uint32_t height : occlusion.occluded) EXPECT_EQ(height, 9u);
}

}  // namespace
}  // namespace veduta
