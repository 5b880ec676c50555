// What import_scene() answers to files that cannot be used: one line, with the file and the place, and
// status 65.
#include <sys/stat.h>

#include "scene/error.h"
#include "temporary_models.h"

namespace veduta {
namespace {

class BadInput : public TemporaryModels {
 protected:
  void expect_refused(const std::filesystem::path& path, const std::string& place) {
    try {
      import_scene({path});
      ADD_FAILURE() << path << " was read";
    } catch (const Error& error) {
      const std::string what = error.what();
      EXPECT_EQ(error.status(), ExitStatus::bad_input) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      EXPECT_LT(what.size(), 600u) << what;
      EXPECT_TRUE(what.starts_with(path.string() + ": " + place)) << what << "\nis not at " << place;
    }
  }
};

TEST_F(BadInput, Files) {
  expect_refused(directory_ / "missing.json", "file: does not exist");
  expect_refused(directory_, "folder: none of its 0 files is a model");
  expect_refused(write("empty.obj", ""), "file: is empty");
  ASSERT_EQ(mkfifo((directory_ / "pipe.obj").c_str(), 0600), 0);
  expect_refused(directory_ / "pipe.obj", "file: is not a regular file");
  expect_refused(write("city.gml", "<?xml version=\"1.0\"?>\n<CityModel/>"),
                 "line 2: the root is 'CityModel'");
  expect_refused(write("image.png", "\x89PNG\r\n\x1a\n"), "line 1: neither");
  expect_refused(write("blank.txt", " \n\n"), "line 1: neither");
}

TEST_F(BadInput, SmallFilesByName) {
  const std::filesystem::path cases = VEDUTA_TEST_CASES;
  expect_refused(cases / "import_truncated/city.json", "line 4, byte ");
  expect_refused(cases / "import_nan_vertex/tower.obj", "line 3: coordinate 'nan'");
  expect_refused(cases / "import_empty_scene/city.json", "whole file: holds no surface");
  expect_refused(cases / "import_flat_polygon/city.json", "whole file: none of its 1 polygons");
}

TEST_F(BadInput, CrsOfAFile) {
  std::string text =
      cityjson(object("a", "Building", geometry("Solid", "[" + cube_faces + "]")), cube_vertices);
  text.replace(text.find("7415"), 4, "99");
  expect_refused(write("crs.json", text), "CRS: ");
}

TEST_F(BadInput, ObjLines) {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::pair<std::string, std::string> table[] = {
      {"v inf 0 0\n", "line 1: coordinate 'inf' is not a finite number"},
      {"v 0 1e400 0\n", "line 1: coordinate '1e400' is not a finite number"},
      {"v 0 0\n", "line 1: a vertex of 2 numbers"},
      {"v 0 0 0,5\n", "line 1: '0,5' is not a number"},
      {v + "f 1 2 4\n", "line 4: vertex 4 of the face"},
      {v + "f 0 1 2\n", "line 4: vertex 0 of the face"},
      {v + "f -4 1 2\n", "line 4: vertex -4 of the face"},
      {v + "f 1 2 99999999999999999999\n", "line 4: '99999999999999999999' is not a vertex index"},
      {v + "f 1 2 3.5\n", "line 4: '3.5' is not a vertex index"},
      {v + "f 1 2 /3\n", "line 4: '/3' is not a vertex index"},
      {v + "f\n", "line 4: a face without vertices"},
      {v + "f 1 2 \\\n 9\n", "line 4: vertex 9"},
      {v + "# only points\n", "whole file: holds no surface"},
      {v + std::string("f 1 2 3\nw\0\x1b\n", 12), "line 5: unknown statement 'w?\?'"},
      {v + "f 1 2 3\n" + std::string(100000, 'x') + "\n", "line 5: unknown statement"},
      {"v 0 0 0\nv 1e30 0 0\nv 0 1e30 0\nf 1 2 3\n", "vertices: the surfaces span"},
      {"v 1e308 0 0\nv -1e308 0 0\nv 0 1e308 0\nf 1 2 3\n", "vertices: the surfaces span"},
  };
  for (const auto& [content, place] : table) expect_refused(write("bad.obj", content), place);
}

TEST_F(BadInput, CityJson) {
  const std::string good =
      cityjson(object("a", "Building", geometry("Solid", "[" + cube_faces + "]")), cube_vertices);
  ASSERT_NO_THROW(import("good.json", good));
  const auto with = [&](const std::string& old, const std::string& replacement) {
    std::string text = good;
    const size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return text.replace(at, old.size(), replacement);
  };
  const std::string faces = "CityObjects/a/geometry/0/boundaries/0/0";
  const std::pair<std::string, std::string> table[] = {
      {with("[0,3,2,1]", "[0,3,2,8]"), faces + "/0: vertex index 8 is not below 8"},
      {with("[0,3,2,1]", "[0,3,2,-1]"), faces + "/0: holds something other than a vertex index"},
      {with("[0,3,2,1]", "[0,3,2,1.5]"), faces + "/0: holds something other"},
      {with("[0,3,2,1]", "[0,3,[2],1]"), faces + "/0: holds something other"},
      {with("[[0,3,2,1]]", "7"), faces + ": is not an array"},
      {with("\"boundaries\"", "\"bounds\""), "CityObjects/a/geometry/0/boundaries: is missing"},
      {with("\"Solid\"", "3"), "CityObjects/a/geometry/0/type: is missing"},
      {with("\"Solid\"", "\"MultiSolid\""), "CityObjects/a/geometry/0/boundaries/0/0/0/0: is not an array"},
      {with("\"Solid\"", "\"MultiPoint\""), "whole file: holds no surface"},
      {with("[10000,0,0]", "[1e400,0,0]"), "line 1, byte "},
      {with("[10000,0,0]", "[NaN,0,0]"), "line 1, byte "},
      {with("[10000,0,0]", "[\"1\",0,0]"), "vertices/1: is not an array of 3 numbers"},
      {with("[10000,0,0]", "[1,2]"), "vertices/1: is not an array of 3 numbers"},
      {with("[10000,0,0]", "[1,2,3,4]"), "vertices/1: is not an array of 3 numbers"},
      {with("[0.001,0.001,0.001]", "[1e308,1,1]"), "vertices/1: is not finite"},
      {with("[0.001,0.001,0.001]", "[1,1]"), "transform/scale: is not an array of 3 numbers"},
      {with("\"2.0\"", "\"0.9\""), "version: CityJSON 0.9 is not read"},
      {with("\"CityJSON\"", "\"CityJSONFeature\""), "type: is CityJSONFeature before"},
      {with("\"vertices\"", "\"corners\""), "vertices: is missing"},
      {with("\"CityObjects\"", "\"Objects\""), "CityObjects: is missing"},
      {with("\"type\":\"Building\"", "\"kind\":\"Building\""), "CityObjects/a/type: is missing"},
      {good.substr(0, good.size() - 40), "line 1, byte "},
      {std::string(3000, '['), "line 1, byte 3000"},
      {"{" + std::string(3000000, '['), "line 1, byte "},
      {"[]", "type: is missing"},
      {"{}", "type: is missing"},
      {"{\"type\":\"CityJSON\"}", "version: is missing"},
      {"\"\xff\xfe\"", "line 1, byte "},
  };
  for (const auto& [content, place] : table) expect_refused(write("bad.json", content), place);
}

TEST_F(BadInput, CityJsonSequences) {
  const std::string header = cityjson("", "[]") + "\n";
  expect_refused(write("bad.jsonl", R"({"type":"CityJSONFeature","CityObjects":{},"vertices":[]})"),
                 "type: is CityJSONFeature before");
  expect_refused(write("bad.jsonl", header + "\n{\"type\":\"CityJSONFeature\",\n"), "line 3, byte ");
  expect_refused(write("bad.jsonl", header + "{\"type\":\"Feature\"}\n"), "line 2: is not a CityJSONFeature");
  expect_refused(write("bad.jsonl", header + R"({"type":"CityJSONFeature","CityObjects":{)" +
                                        object("a", "Building", geometry("MultiSurface", "[[0,1,2]]")) +
                                        R"(},"vertices":[[0,0,0]]})"),
                 "line 2: CityObjects/a/geometry/0/boundaries/0/0: vertex index 1 is not below 1");
  expect_refused(write("bad.jsonl", header), "whole file: holds no surface");
}

// Every way of cutting a file short, and 2,000 changed bytes: an error or a scene, never a crash.
TEST_F(BadInput, CutAndChangedFilesNeverCrash) {
  const std::string good =
      cityjson(object("a", "Building", geometry("Solid", "[" + cube_faces + "]")), cube_vertices);
  const auto try_it = [&](const std::string& name, const std::string& content) {
    try {
      expect_consistent(import(name, content).scene);
      return true;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::bad_input) << error.what();
      return false;
    }
  };
  for (size_t length = 0; length + 1 < good.size(); ++length)
    EXPECT_FALSE(try_it("cut.json", good.substr(0, length)));
  uint32_t state = 1;
  for (int round = 0; round < 2000; ++round) {
    std::string changed = good;
    state = state * 1664525u + 1013904223u;
    changed[(state >> 8) % changed.size()] = "0123456789[]{},:\"-e."[(state >> 4) % 20];
    try_it("changed.json", changed);
  }
}

}  // namespace
}  // namespace veduta
