// Terminals: what is read, how borders are closed, and what is refused.
#include "scene/city/terminal.h"

#include "city_files.h"
#include "closed_mesh.h"

namespace veduta::city {
namespace {

class CityTerminal : public CityFiles {
 protected:
  Terminal load_obj(const std::string& content) {
    return load_terminal("T", write("t.obj", content), "wall_brick", "", layers_);
  }
  std::vector<std::string> layers_of(const Terminal& terminal) const {
    std::vector<std::string> names;
    for (const Face& face : terminal.faces) names.push_back(layers_[face.layer]);
    return names;
  }
  std::vector<std::string> layers_;
};

TEST_F(CityTerminal, PlainQuad) {
  const Terminal terminal = load_obj("g Glass\n" + flat_obj);
  EXPECT_EQ(terminal.vertices.size(), 4u);
  EXPECT_EQ(layers_of(terminal), std::vector<std::string>{"glass"});
  EXPECT_EQ(terminal.at_border, std::vector<bool>(4, true));
}

// A pane behind the wall gets a reveal on each side, on the wall's layer.
TEST_F(CityTerminal, RevealsAroundPane) {
  const Terminal terminal = load_obj("g glass\nv 0 0 -0.2\nv 1 0 -0.2\nv 1 1 -0.2\nv 0 1 -0.2\nf 1 2 3 4\n");
  EXPECT_EQ(terminal.vertices.size(), 8u);
  EXPECT_EQ(layers_of(terminal),
            (std::vector<std::string>{"glass", "wall_brick", "wall_brick", "wall_brick", "wall_brick"}));
  // The sill, at y = 0, faces up and the lintel down.
  int lying = 0;
  for (const Face& face : terminal.faces) {
    const glm::dvec3 a = terminal.vertices[face.corner[0]], b = terminal.vertices[face.corner[1]],
                     c = terminal.vertices[face.corner[2]];
    const glm::dvec3 normal = glm::cross(b - a, c - b);
    if (a.y == b.y && b.y == c.y) {
      EXPECT_GT(a.y == 0 ? normal.y : -normal.y, 0);
      ++lying;
    }
  }
  EXPECT_EQ(lying, 2);
}

TEST_F(CityTerminal, SlopedSideEndsInTriangle) {
  const Terminal terminal = load_obj("v 0 0 0\nv 1 0 0\nv 1 1 -0.5\nv 0 1 -0.5\nf 1 2 3 4\n");
  EXPECT_EQ(terminal.faces.size(), 4u);  // the pane, two triangles, the lintel
}

// Two panes at different depths, one above the other: the wall beside them meets one edge, not two.
TEST_F(CityTerminal, OneRevealAlongASide) {
  const Terminal terminal = load_obj(
      "v 0 0 -.2\nv 1 0 -.2\nv 1 .5 -.2\nv 0 .5 -.2\nv 0 .5 -.1\nv 1 .5 -.1\nv 1 1 -.1\nv 0 1 -.1\n"
      "f 1 2 3 4\nf 4 3 6 5\nf 5 6 7 8\n");
  EXPECT_EQ(terminal.vertices.size(), 12u);  // of the wall the four corners only
  size_t triangles = 0;
  for (const Face& face : terminal.faces) triangles += face.is_quad() ? 2 : 1;
  EXPECT_EQ(triangles, 6u + 2 * 2 + 2 * 4);
}

TEST_F(CityTerminal, LayersOfFilesAndStyles) {
  const std::string halves =
      "v 0 0 0\nv .5 0 0\nv 1 0 0\nv 1 1 0\nv .5 1 0\nv 0 1 0\ng wall\nf 1 2 5 6\ng Frame\nf 2 3 4 5\n";
  EXPECT_EQ(layers_of(load_obj(halves)), (std::vector<std::string>{"wall_brick", "frame"}));
  const Terminal one = load_terminal("T", directory_ / "t.obj", "wall", "stone", layers_);
  EXPECT_EQ(layers_of(one), (std::vector<std::string>{"stone", "stone"}));
}

TEST_F(CityTerminal, Dxf) {
  std::string text = "0\nSECTION\n2\nENTITIES\n0\n3DFACE\n8\nGlass\n";
  const int corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int i = 0; i < 4; ++i)
    for (int axis = 0; axis < 3; ++axis)
      text +=
          std::to_string(10 * (axis + 1) + i) + "\n" + std::to_string(axis < 2 ? corners[i][axis] : 0) + "\n";
  const Terminal terminal =
      load_terminal("T", write("t.dxf", text + "0\nENDSEC\n0\nEOF\n"), "wall", "", layers_);
  EXPECT_EQ(terminal.vertices.size(), 4u);
  EXPECT_EQ(layers_of(terminal), std::vector<std::string>{"glass"});
}

// Concave faces and faces with many corners are triangulated.
TEST_F(CityTerminal, ManyCorners) {
  const Terminal terminal = load_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv .5 1 0\nv 0 1 0\nf 1 2 3 4 5\n");
  EXPECT_EQ(terminal.faces.size(), 3u);
}

TEST_F(CityTerminal, Refused) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const std::string box = "v .2 .2 .1\nv .4 .2 .1\nv .4 .4 .1\nv .2 .4 .1\n";
  const std::pair<std::string, std::string> table[] = {
      {square + "f 4 3 2 1\n", "faces too few along z"},                                 // inside out
      {"v 0 0 0\nv .9 0 0\nv .9 1 0\nv 0 1 0\nf 1 2 3 4\n", "1 faces too few along z"},  // a gap at its right
      {square + "f 1 2 3\n", "1 faces too few along z"},
      {square + box + "f 1 2 3 4\nf 5 6 7 8\n", "1 faces too many along z"},  // a sheet without a back
      {square, "whole file: holds no surface"},
      {square + "f 1 2 3 4\nl 1 2\n", "a terminal may hold surfaces only"},
      {square + "f 1 2 3 4\nf 1 1 2\n", "line 6: a face without area"},
      {square + "f 1 2 3 9\n", "line 5: vertex 9"},
      {"v 0 0 0\nv 100 0 0\nv 100 100 0\nv 0 100 0\nf 1 2 3 4\n", "reach far out of the unit square"},
      {"v 0 0 -1\nv 1 0 1\nv 1 1 1\nv 0 1 -1\nf 1 2 3 4\n", "border: an edge that passes through the wall"},
  };
  for (const auto& [content, message] : table) try {
      load_obj(content);
      ADD_FAILURE() << "read: " << content;
    } catch (const Error& error) {
      const std::string what = error.what();
      EXPECT_EQ(error.status(), ExitStatus::bad_input);
      EXPECT_NE(what.find(message), std::string::npos) << what << "\ndoes not say: " << message;
      EXPECT_NE(what.find("t.obj"), std::string::npos) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    }
  EXPECT_THROW(load_terminal("T", write("t.ply", "ply\n"), "wall", "", layers_), Error);
}

}  // namespace
}  // namespace veduta::city
