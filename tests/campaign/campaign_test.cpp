// The campaign itself: scenes repeat, what fails is found and made small, and a check that is spoilt fails.
#include "tests/campaign/campaign.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <set>

#include "tests/campaign/generate.h"
#include "tests/campaign/minimise.h"
#include "tests/pvs/small_city.h"
#include "tests/worker/occlusion_checks.h"

namespace veduta {
namespace {

using campaign::CampaignScene;
using campaign::Outcome;
using campaign::Thing;
using campaign::Verdict;

std::string bytes_of(const CampaignScene& scene) {
  const test::TemporaryDirectory folder;
  campaign::write_scene(scene, folder.path());
  return test::read_bytes(folder / "scene.obj") + test::read_bytes(folder / "bake.toml");
}

TEST(CampaignScene, IsTheSameForANumberAndAnotherForAnother) {
  std::set<std::string> all;
  for (const uint64_t number : {0ull, 1ull, 2ull, ~0ull}) {
    EXPECT_EQ(bytes_of(campaign::generate(number)), bytes_of(campaign::generate(number)));
    all.insert(bytes_of(campaign::generate(number)));
  }
  EXPECT_EQ(all.size(), 4u);
}

TEST(CampaignScene, EveryKindOfThingAndOfSettingComesUp) {
  std::set<std::string> found;
  for (uint64_t number = 0; number < 300; ++number) {
    const CampaignScene scene = campaign::generate(number);
    for (const Thing& thing : scene.things) found.insert(thing.name.substr(0, thing.name.find('_')));
    for (const std::string& choice :
         {scene.settings.navigation.mode, scene.settings.shrink.method, scene.settings.occlusion.method})
      found.insert(choice);
    if (scene.origin.x != 0) found.insert("far from the origin");
  }
  for (const char* name : {"ground",
                           "block",
                           "wall",
                           "slit",
                           "fence",
                           "tower",
                           "row",
                           "court",
                           "arcade",
                           "overhang",
                           "thin",
                           "spike",
                           "stack",
                           "open",
                           "outer",
                           "inner",
                           "sliver",
                           "far",
                           "over",
                           "small",
                           "walk",
                           "fly",
                           "planes",
                           "sections",
                           "sealed",
                           "vertex",
                           "panorama",
                           "zoom",
                           "far from the origin"})
    EXPECT_TRUE(found.contains(name)) << name;
}

TEST(CampaignScene, ItsConfigurationReadsBack) {
  const test::TemporaryDirectory folder;
  for (uint64_t number = 0; number < 50; ++number) {
    const CampaignScene scene = campaign::generate(number);
    campaign::write_scene(scene, folder.path());
    EXPECT_EQ(to_toml(load_settings(folder / "bake.toml")), to_toml(scene.resolved(folder.path())));
  }
}

TEST(CampaignScene, TerrainIsAsHighAsItsTriangles) {
  campaign::Piece terrain;
  terrain.shape = campaign::Shape::terrain, terrain.foot = {1, 2, 3}, terrain.size = {16, 24, 5},
  terrain.bumps = 7;
  double highest = 0;
  for (const campaign::Polygon& face : faces(terrain)) {
    const glm::dvec3 middle = (face[0] + face[1] + face[2]) / 3.0;
    EXPECT_NEAR(terrain_height(terrain, glm::dvec2(middle)), middle.z, 1e-9);
    highest = std::max(highest, middle.z);
  }
  EXPECT_GT(highest, 5);
}

TEST(Fewest, FindsTheElementsThatItTakes) {
  std::vector<int> all(50);
  for (int n = 0; n < 50; ++n) all[static_cast<size_t>(n)] = n;
  for (const std::set<int>& needed : {std::set<int>{}, {0}, {49}, {3, 4}, {7, 30, 31, 48}}) {
    const auto left = campaign::fewest(all, [&](const std::vector<int>& some) {
      return std::ranges::all_of(needed, [&](int n) { return std::ranges::count(some, n) == 1; });
    });
    EXPECT_EQ(std::set<int>(left.begin(), left.end()), needed);
    EXPECT_EQ(left.size(), needed.size());
  }
}

TEST(Minimise, LeavesWhatTheFailureTakesAndSimpleNumbers) {
  const CampaignScene scene = campaign::generate(5);
  ASSERT_GT(scene.things.size(), 8u);
  const std::string first = scene.things[2].name, second = scene.things.back().name;
  const auto check = [&](const CampaignScene& tried) {
    Outcome outcome;
    const auto has = [&](const std::string& name) {
      return std::ranges::any_of(tried.things, [&](const Thing& thing) { return thing.name == name; });
    };
    if (has(first) && has(second)) outcome.verdict = Verdict::false_invisible;
    return outcome;
  };
  const campaign::Minimal minimal = campaign::minimise(scene, check(scene), check, 1000);
  ASSERT_EQ(minimal.scene.things.size(), 2u);
  EXPECT_LT(minimal.checks, 500u) << "it comes to an end by itself";
  for (const Thing& thing : minimal.scene.things) {
    ASSERT_EQ(thing.pieces.size(), 1u);
    EXPECT_EQ(thing.pieces[0].turn, 0);
    EXPECT_EQ(thing.pieces[0].foot.x, std::round(thing.pieces[0].foot.x));
  }
  EXPECT_EQ(minimal.scene.settings.occlusion.subdivide, 1);
}

TEST(Campaign, GoesOnAfterCrashesAndHangs) {
  const test::TemporaryDirectory folder;
  campaign::CampaignOptions options;
  options.numbers = {1, 2, 3, 4, 5, 6};
  options.timeout_s = 2, options.jobs = 2, options.quiet = true;
  const campaign::CampaignReport report =
      campaign::run_campaign(options, [](const CampaignScene& scene) -> Outcome {
        Outcome outcome;
        if (scene.number == 2) std::raise(SIGKILL);
        if (scene.number == 3) _exit(0);  // says nothing
        if (scene.number == 4) pause();
        if (scene.number == 5) outcome.verdict = Verdict::threw, outcome.what = "five\nlines";
        outcome.cells = 1, outcome.pairs = 10, outcome.hidden = 3;
        return outcome;
      });
  EXPECT_EQ(report.scenes, 6u);
  EXPECT_FALSE(report.passed());
  EXPECT_EQ(report.verdicts.at(Verdict::passed), 2u);
  EXPECT_EQ(report.verdicts.at(Verdict::crashed), 2u);
  EXPECT_EQ(report.verdicts.at(Verdict::hung), 1u);
  EXPECT_EQ(report.verdicts.at(Verdict::threw), 1u);
  EXPECT_EQ(report.sum.cells, 3u);
  EXPECT_DOUBLE_EQ(report.hidden_share(), 0.3);
}

TEST(Campaign, KeepsASmallCaseOfWhatCrashes) {
  const test::TemporaryDirectory folder;
  campaign::CampaignOptions options;
  options.numbers = {5};
  options.out = folder.path(), options.quiet = true, options.minimising_checks = 60;
  const std::string guilty = campaign::generate(5).things[3].name;
  const campaign::CampaignReport report = campaign::run_campaign(options, [&](const CampaignScene& scene) {
    for (const Thing& thing : scene.things)
      if (thing.name == guilty) std::raise(SIGKILL);
    return Outcome{};
  });
  ASSERT_EQ(report.failures.size(), 1u);
  EXPECT_EQ(report.failures[0].things, 1u);
  for (const char* file : {"scene.obj", "bake.toml", "what.txt", "whole/scene.obj"})
    EXPECT_TRUE(std::filesystem::exists(report.failures[0].folder / file)) << file;
}

/// A slit between two walls, turned by an angle and so many seeds wide, a box behind it and one beside that.
CampaignScene slit_scene(double angle, double seeds, double off_m) {
  CampaignScene scene;
  Settings& s = scene.settings;
  s.navigation.seed_size_m = 0.25, s.cells.size_m = 1, s.slices.max = 1;
  s.occlusion.subdivide = 1, s.occlusion.resolution = 256, s.occlusion.max_overestimate = 1000;  // no rays
  scene.lower = glm::dvec2(-0.5), scene.upper = glm::dvec2(0.5);
  const double slit = seeds * s.navigation.seed_size_m, c = std::cos(angle), sine = std::sin(angle);
  const auto add = [&](const char* name, const glm::dvec3& foot, const glm::dvec3& size) {
    campaign::Piece piece;
    piece.foot = {c * foot.x - sine * foot.y + off_m, sine * foot.x + c * foot.y, foot.z};
    piece.size = size, piece.turn = angle;
    scene.things.push_back({name, {piece}});
  };
  add("ground", {0, 0, -1}, {60, 60, 1});
  add("left", {-5 - 0.5 * slit, 9, 0}, {10, 6, 8});
  add("right", {5 + 0.5 * slit, 9, 0}, {10, 6, 8});
  add("lid", {0, 9, 8}, {20 + slit, 6, 1});  // else the fill comes from above
  add("behind_slit", {0, 20, 0}, {3, 3, 3});
  add("behind_wall", {8, 14, 0}, {1, 1, 2});
  return scene;
}

// A gap of two seeds stays open for the fill between walls that are parallel to the axes. Of a turned one
// what is sure is that each seed on its middle plane lies within it where it is as wide as a cube of two
// seeds is across it, and the seeds on a plane are joined by their faces.
TEST(TurnedGap, WhatACubeOfTwoSeedsPassesIsOpen) {
  SKIP_WITHOUT_GL();
  for (const double angle : {0.0, 0.3, 0.785}) {
    for (const double off_m : {0.0, 0.07, 0.16}) {
      const double seeds = 2 * (std::cos(angle) + std::sin(angle)) + 0.02;
      const Outcome outcome = campaign::check_scene(slit_scene(angle, seeds, off_m));
      EXPECT_EQ(outcome.verdict, Verdict::passed) << angle << " " << off_m << ": " << outcome.what;
      EXPECT_GE(outcome.hidden, 1u) << "behind the wall";
      EXPECT_EQ(outcome.narrow_gap_objects, 0u);
    }
  }
}

TEST(TurnedGap, WhatMayBeClosedIsToldFromAFault) {
  SKIP_WITHOUT_GL();
  campaign::CheckOptions options;
  options.eyes_per_cell = 0;  // rays alone
  options.spoil_answer = [](CellOcclusion& answer, const OcclusionInput& input) {
    for (size_t o = 0; o < answer.occlusion.visible.size(); ++o)
      if (input.city.scene.objects[o].name == "behind_slit") answer.occlusion.visible[o] = 0;
  };
  const auto verdict = [&](double angle, double seeds) {
    return campaign::check_scene(slit_scene(angle, seeds, 0), options).verdict;
  };
  EXPECT_EQ(verdict(0, 1.95), Verdict::passed) << "narrower than two seeds";
  EXPECT_EQ(verdict(0, 2.05), Verdict::false_invisible);
  EXPECT_EQ(verdict(0.6, 1.95), Verdict::passed);
  EXPECT_EQ(verdict(0.6, 2.05), Verdict::turned_gap);
  EXPECT_EQ(verdict(0.6, 2.7), Verdict::turned_gap) << "a cube of two seeds is 2.78 wide there";
  EXPECT_EQ(verdict(0.6, 2.9), Verdict::false_invisible);
}

void grow(std::vector<WindowOccluders>& windows, float times) {
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
}

/// A scene fails with a spoilt check and not with an honest one, and is made small.
void expect_noticed(const campaign::CheckOptions& spoilt, uint64_t number) {
  const auto check = [&](const CampaignScene& scene) { return campaign::check_scene(scene, spoilt); };
  const CampaignScene scene = campaign::generate(number);
  const Outcome honest = campaign::check_scene(scene), outcome = check(scene);
  EXPECT_EQ(honest.verdict, Verdict::passed) << honest.what;
  ASSERT_TRUE(is_failure(outcome.verdict)) << "not noticed";
  EXPECT_FALSE(outcome.what.empty());
  const campaign::Minimal minimal = campaign::minimise(scene, outcome, check, 60);
  EXPECT_LE(minimal.scene.things.size(), 4u) << minimal.outcome.what;
  EXPECT_TRUE(is_failure(minimal.outcome.verdict));
}

TEST(CampaignCheck, NoticesOccludersThatAreTooLarge) {
  SKIP_WITHOUT_GL();
  campaign::CheckOptions options;
  options.cells = 1, options.rays_per_cell = 20'000;
  options.spoil_occluders = [](std::vector<WindowOccluders>& windows) { grow(windows, 1.05f); };
  expect_noticed(options, 21);
}

TEST(CampaignCheck, NoticesBytesThatAreOneTooTight) {
  SKIP_WITHOUT_GL();
  campaign::CheckOptions options;
  options.cells = 1, options.rays_per_cell = 20'000;
  options.spoil_answer = [](CellOcclusion& answer, const OcclusionInput& input) {
    const SliceBoxes& slices = input.slices;
    for (size_t s = 0; s < slices.slices.size(); ++s) {
      uint32_t& occluded = answer.occlusion.occluded[s];
      if (occluded > 0 && occluded < slices.slices[s].heights) ++occluded;
    }
  };
  expect_noticed(options, 4);
}

}  // namespace
}  // namespace veduta
