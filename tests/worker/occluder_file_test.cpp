#include "worker/occluder_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "scene/error.h"

namespace veduta {
namespace {

class OccluderFile : public testing::Test {
 protected:
  void TearDown() override {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
  }
  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void replace(const std::string& bytes) const { std::ofstream(file_, std::ios::binary) << bytes; }
  void expect_refused(const std::string& why) const {
    try {
      read_occluder_file(file_);
      ADD_FAILURE() << "was read: " << why;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::bad_input) << why;
    }
  }
  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("veduta_occluders_" + std::to_string(getpid()));
};

/// Two windows, three rings, one of them empty; boxes and a tetrahedron.
std::vector<WindowOccluders> example() {
  OccluderMesh mixed;
  mixed.add_box({{0, 0, 0}, {1, 2, 3}});
  const glm::vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(0, 0, 1);
  mixed.add_face({a, c, b}), mixed.add_face({a, b, d}), mixed.add_face({b, c, d}), mixed.add_face({c, a, d});
  mixed.end_body();
  OccluderMesh box;
  box.add_box({{5, 5, 5}, {6, 6, 6}});
  return {{{2.5325, 2.5325, 0.5}, {{0.125, 50, mixed}, {0.25, 100, {}}}}, {{5, 5, 1}, {{0.25, 100, box}}}};
}

TEST_F(OccluderFile, ComesBackAsItWas) {
  const std::vector<WindowOccluders> windows = example();
  write_occluder_file(file_, windows);
  const std::vector<WindowOccluders> read = read_occluder_file(file_);
  ASSERT_EQ(read.size(), windows.size());
  for (size_t w = 0; w < windows.size(); ++w) {
    EXPECT_EQ(read[w].half_extent_m, windows[w].half_extent_m);
    ASSERT_EQ(read[w].rings.size(), windows[w].rings.size());
    for (size_t r = 0; r < windows[w].rings.size(); ++r) {
      const OccluderRing &a = read[w].rings[r], &b = windows[w].rings[r];
      EXPECT_EQ(a.h_m, b.h_m);
      EXPECT_EQ(a.depth_limit_m, b.depth_limit_m);
      EXPECT_EQ(a.occluders.corners, b.occluders.corners);
      EXPECT_EQ(a.occluders.face_begin, b.occluders.face_begin);
      EXPECT_EQ(a.occluders.body_begin, b.occluders.body_begin);
    }
  }
  write_occluder_file(file_, {});
  EXPECT_TRUE(read_occluder_file(file_).empty());
}

TEST_F(OccluderFile, DamageIsBadInput) {
  expect_refused("there is none");
  write_occluder_file(file_, example());
  const std::string good = bytes();
  for (size_t at = 0; at < good.size(); ++at) {
    std::string flipped = good;
    flipped[at] = static_cast<char>(flipped[at] ^ 1 << at % 8);
    replace(flipped);
    expect_refused("byte " + std::to_string(at) + " flipped");
    replace(good.substr(0, at));
    expect_refused("cut at " + std::to_string(at));
  }
  replace(good + "x");
  expect_refused("something behind it");
}

TEST_F(OccluderFile, WhatIsNotWellFormedIsBadInputThoughItsDigestFits) {
  std::vector<WindowOccluders> windows = example();
  OccluderMesh& mesh = windows[0].rings[0].occluders;
  const OccluderMesh good = mesh;
  const auto refused = [&](const std::string& why) {
    write_occluder_file(file_, windows);
    expect_refused(why);
    mesh = good;
  };
  mesh.face_begin[2] = 4000000000u, refused("a face that begins beyond the corners");
  mesh.face_begin[2] = mesh.face_begin[1] + 2, refused("a face of two corners");
  mesh.face_begin.clear(), refused("no faces' begins");
  mesh.body_begin.back() += 1, refused("a body of faces that there are not");
  mesh.body_begin[1] = 0, refused("a body without faces");
  mesh.corners.pop_back(), refused("a corner too few");
}

}  // namespace
}  // namespace veduta
