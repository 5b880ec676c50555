#include "worker/section_picture.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <glm/geometric.hpp>
#include <sstream>

#include "scene/error.h"
#include "tests/worker/convex_bodies.h"
#include "worker/city_section.h"
#include "worker/section_outline.h"

namespace veduta {
namespace {

using test::Random;

double area(const std::vector<glm::vec3>& outline) {
  glm::dvec3 sum(0);
  for (size_t n = 1; n + 1 < outline.size(); ++n)
    sum += glm::cross(glm::dvec3(outline[n] - outline[0]), glm::dvec3(outline[n + 1] - outline[0]));
  return 0.5 * glm::length(sum);
}

TEST(SectionOutline, OfABoxIsARectangle) {
  OccluderMesh mesh;
  mesh.add_box({{1, 2, 3}, {4, 8, 10}});
  EXPECT_TRUE(cut_body(mesh, 0, 2, 2.9f).empty());
  EXPECT_TRUE(cut_body(mesh, 0, 0, 4.1f).empty());
  for (const auto& [axis, expected] : {std::pair{0, 6.0 * 7}, {1, 3.0 * 7}, {2, 3.0 * 6}}) {
    const auto outlines = cut_body(mesh, 0, axis, 3.5f);
    ASSERT_EQ(outlines.size(), 1u);
    EXPECT_EQ(outlines[0].size(), 4u);
    EXPECT_NEAR(area(outlines[0]), expected, 1e-4);
  }
}

TEST(SectionOutline, OfAConvexBodyIsOneClosedPolygonInsideOfIt) {
  Random random(1);
  int cut = 0;
  for (int round = 0; round < 200; ++round) {
    const test::Faces faces = test::random_body(random, {4, 3, 5});
    OccluderMesh mesh;
    test::add_body(mesh, faces, {0, 0, 0});
    const int axis = random.integer(0, 2);
    const auto at = static_cast<float>(random.real(-3, 3));
    const auto outlines = cut_body(mesh, 0, axis, at);
    ASSERT_LE(outlines.size(), 1u);
    if (outlines.empty()) continue;
    ++cut;
    glm::dvec3 middle(0);
    for (const glm::vec3& corner : outlines[0]) {
      EXPECT_NEAR(corner[axis], at, 1e-5);
      middle += glm::dvec3(corner) / static_cast<double>(outlines[0].size());
    }
    EXPECT_TRUE(area(outlines[0]) < 0.01 || test::inside(faces, middle)) << round;
  }
  EXPECT_GT(cut, 120);
}

/// A house on a plane, as a file.
class SectionPicture : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream out(folder_ / "toy.obj");
    const auto box = [&](glm::vec3 l, glm::vec3 u) {
      for (int c = 0; c < 8; ++c)
        out << "v " << ((c & 1) != 0 ? u.x : l.x) << ' ' << ((c & 2) != 0 ? u.y : l.y) << ' '
            << ((c & 4) != 0 ? u.z : l.z) << '\n';
      for (const char* face : {"1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"}) {
        std::istringstream corners(face);
        out << 'f';
        for (int n = 0; corners >> n;) out << ' ' << n + first_;
        out << '\n';
      }
      first_ += 8;
    };
    out << "o ground\n", box({-40, -40, -1}, {40, 40, 0});
    out << "o house\n", box({-12, -10, 0}, {0, 10, 9});
    out.close();
    settings_.scene.model = {(folder_ / "toy.obj").string()};
    settings_.cells.size_m = 4;
  }
  void TearDown() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  static std::filesystem::path make_folder() {
    auto folder = std::filesystem::temp_directory_path() / ("veduta_section_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    return folder;
  }

  std::filesystem::path folder_ = make_folder();
  int first_ = 0;
  Settings settings_;
};

TEST_F(SectionPicture, ShowsWhatThePreparationFinds) {
  const SectionContent content = city_section(settings_, {.at = {{0.5, 1}}, .size_m = 20});
  EXPECT_NEAR(content.square.upper.x - content.square.lower.x, 20, 1.1);
  EXPECT_GT(content.square.upper.z, 9);
  EXPECT_FALSE(content.cells.empty());
  EXPECT_FALSE(content.free_leaves.empty());
  EXPECT_FALSE(content.solid_leaves.empty());
  ASSERT_FALSE(content.occluders.rings.empty());
  EXPECT_GT(content.occluders.rings[0].occluders.bodies(), 0u);
  const std::string svg = draw_section(content);
  for (const char* name : {"surface", "sealed", "solid", "free", "cell", "near"}) {
    const std::string layer = "<path class=\"" + std::string(name) + "\"";
    const auto drawn = [&](size_t at) {  // is there something in the layer that begins here?
      return svg.substr(at, svg.find("/>", at) - at).find("d=\"M") != std::string::npos;
    };
    const size_t plan = svg.find(layer), section = svg.find(layer, plan + 1);
    ASSERT_NE(section, std::string::npos) << name;
    EXPECT_TRUE(drawn(plan)) << name;
    EXPECT_TRUE(drawn(section)) << name;
  }
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
  write_section(folder_ / "a.svg", content);
  EXPECT_EQ(std::filesystem::file_size(folder_ / "a.svg"), svg.size());
}

TEST_F(SectionPicture, MistakesAreTold) {
  try {
    city_section(settings_, {.at = {{500, 0}}, .size_m = 20});
    FAIL() << "drew what lies outside";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::usage);
  }
  const SectionContent content = city_section(settings_, {.at = {{0, 0}}, .size_m = 5});
  try {
    write_section(folder_ / "none" / "a.svg", content);
    FAIL() << "wrote to a folder that is not there";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::input_output);
  }
}

}  // namespace
}  // namespace veduta
