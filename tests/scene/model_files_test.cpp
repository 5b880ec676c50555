// scene/model_files.h, and the archives below it.
#include "scene/model_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include "archives.h"
#include "scene/archive.h"
#include "scene/error.h"
#include "scene/model_format.h"
#include "temporary_models.h"

namespace veduta {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

class ModelFilesTest : public TemporaryModels {
 protected:
  void put(const std::string& name, const std::string& content = "x") const {
    fs::create_directories((directory_ / name).parent_path());
    write(name, content);
  }
  static std::string refusal(const fs::path& path) {
    try {
      ModelFiles files(path);
      return "";
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::bad_input);
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      EXPECT_TRUE(std::string(error.what()).starts_with(path.string() + ": ")) << error.what();
      return error.what();
    }
  }
  Names models(const fs::path& path) {
    const ModelFiles files(path);
    report_ = {};
    return choose_models(files, report_);
  }
  uint64_t dropped(const std::string& reason) const {
    const auto found = report_.dropped.find(reason);
    return found == report_.dropped.end() ? 0 : found->second.count;
  }
  ImportReport report_;
};

TEST_F(ModelFilesTest, AFolderIsListedInOrderWithoutWhatIsHidden) {
  for (const char* name :
       {"b/2.obj", "b/10.obj", "a.obj", "b.obj", ".git/x.obj", ".hidden.obj", "c/.a/b.obj"})
    put(name);
  const ModelFiles files(directory_);
  EXPECT_EQ(files.form(), ModelFiles::Form::folder);
  EXPECT_EQ(files.names(), (Names{"a.obj", "b.obj", "b/10.obj", "b/2.obj"}));
  EXPECT_EQ(files.read("b/2.obj").content(), "x");
  EXPECT_EQ(files.read("b/2.obj").name, (directory_ / "b/2.obj").string());
  EXPECT_EQ(files.head("a.obj", 100), "x");
}

TEST_F(ModelFilesTest, LinksAndPipesNeitherLoopNorBlock) {
  put("a/x.obj");
  fs::create_directory_symlink(directory_, directory_ / "a/up");
  fs::create_directory_symlink(directory_ / "a", directory_ / "b");
  fs::create_symlink("nowhere", directory_ / "broken.obj");
  fs::create_symlink("a/x.obj", directory_ / "link.obj");
  ASSERT_EQ(mkfifo((directory_ / "pipe.obj").c_str(), 0600), 0);
  const ModelFiles files(directory_);
  EXPECT_EQ(files.names(), (Names{"a/x.obj", "link.obj"})) << "b is a again, and a/up is the folder itself";
  EXPECT_EQ(files.not_files(), (Names{"broken.obj", "pipe.obj"}));
  EXPECT_EQ(models(directory_), files.names());
  EXPECT_EQ(dropped("link, pipe or device, not read"), 2u);
}

TEST_F(ModelFilesTest, AnArchiveIsLikeTheFolderItHolds) {
  const std::vector<ArchiveEntry> entries = {{"city/b.obj", "second"},
                                             {"./city/a.obj", "first"},
                                             {"city/.c", "hidden"},
                                             {"city/l.obj", "", "a.obj"}};
  for (const char* name : {"m.tar", "m.tar.gz", "m.tar.xz", "m.tar.bz2", "m.zip", "m.7z"}) {
    write_archive(directory_ / name, entries);
    const ModelFiles files(directory_ / name);
    EXPECT_EQ(files.form(), ModelFiles::Form::archive) << name;
    EXPECT_EQ(files.names(), (Names{"city/a.obj", "city/b.obj"})) << name;
    EXPECT_EQ(files.not_files(), (Names{"city/l.obj"})) << name;
    const InputFile first = files.read("city/a.obj");
    EXPECT_EQ(first.content(), "first");
    EXPECT_EQ(first.name, (directory_ / name / "city/a.obj").string());
    EXPECT_EQ(first.extension, ".obj");
    EXPECT_EQ(files.head("city/b.obj", 3), "sec");
    const auto beside = files.find_from("city/a.obj")("../city/b.obj");
    ASSERT_TRUE(beside.has_value());
    EXPECT_EQ(beside->content(), "second");
  }
}

TEST_F(ModelFilesTest, ACompressedFileIsOneFileOfItsStem) {
  archive* const out = archive_write_new();
  archive_write_set_format_raw(out);
  archive_write_add_filter_gzip(out);
  const fs::path path = directory_ / "city.obj.gz";
  ASSERT_EQ(archive_write_open_filename(out, path.c_str()), ARCHIVE_OK);
  archive_entry* const entry = archive_entry_new();
  archive_entry_set_filetype(entry, AE_IFREG);
  ASSERT_EQ(archive_write_header(out, entry), ARCHIVE_OK);
  ASSERT_EQ(archive_write_data(out, "v 0 0 0\n", 8), 8);
  archive_entry_free(entry);
  archive_write_close(out);
  archive_write_free(out);
  const ModelFiles files(path);
  EXPECT_EQ(files.names(), Names{"city.obj"});
  EXPECT_EQ(files.read("city.obj").content(), "v 0 0 0\n");
}

TEST_F(ModelFilesTest, HostileArchivesAreRefused) {
  write_archive(directory_ / "up.tar", {{"a/../../etc/passwd", "x"}});
  EXPECT_NE(refusal(directory_ / "up.tar").find("leads out of the archive"), std::string::npos);
  write_archive(directory_ / "root.tar", {{"/etc/passwd", "x"}});
  EXPECT_NE(refusal(directory_ / "root.tar").find("leads out of the archive"), std::string::npos);
  write_archive(directory_ / "secret.zip", {{"a.obj", "secret text"}}, "key");
  EXPECT_NE(refusal(directory_ / "secret.zip").find("is encrypted"), std::string::npos);
  write_archive(directory_ / "bomb.zip", {{"a.obj", std::string(40'000'000, ' ')}});
  ASSERT_LT(fs::file_size(directory_ / "bomb.zip"), 200'000u);
  EXPECT_NE(refusal(directory_ / "bomb.zip").find("unpacks to more than"), std::string::npos);
  std::vector<ArchiveEntry> many(60'000);
  for (size_t i = 0; i < many.size(); ++i) many[i].path = std::to_string(i);
  write_archive(directory_ / "many.tar.xz", many);
  EXPECT_NE(refusal(directory_ / "many.tar.xz").find("unpacks to more than"), std::string::npos);
}

TEST_F(ModelFilesTest, CutAndChangedArchivesNeverCrash) {
  std::string text;
  for (int i = 0; i < 400; ++i) text += "v " + std::to_string(i * 7919 % 1009) + " 0 0\n";
  for (const char* name : {"m.tar.gz", "m.tar.xz", "m.zip", "m.7z"}) {
    write_archive(directory_ / name, {{"a.obj", text}, {"b.obj", text}});
    std::string good;
    {
      std::ifstream in(directory_ / name, std::ios::binary);
      good.assign(std::istreambuf_iterator<char>(in), {});
    }
    enum Answer { right, wrong, refused };
    const auto try_it = [&](const std::string& bytes) {
      try {
        const ModelFiles files(write(std::string("bad-") + name, bytes));
        if (files.form() == ModelFiles::Form::file) return refused;  // not even the signature is left
        const bool both = files.names() == Names{"a.obj", "b.obj"} && files.read("a.obj").content() == text &&
                          files.read("b.obj").content() == text;
        return both ? right : wrong;
      } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::bad_input) << error.what();
        return refused;
      }
    };
    EXPECT_EQ(try_it(good), right) << name;
    int refusals = 0;
    for (size_t length = 0; length < good.size(); length += 7) {
      const Answer answer = try_it(good.substr(0, length));
      EXPECT_NE(answer, wrong) << name << " cut to " << length;
      refusals += answer == refused;
    }
    EXPECT_GE(refusals, static_cast<int>(good.size() / 7 * 3 / 4))
        << "only a table of contents may be missing";
    uint32_t state = 1;
    for (int round = 0; round < 150; ++round) {
      std::string changed = good;
      state = state * 1664525u + 1013904223u;
      changed[(state >> 8) % changed.size()] = static_cast<char>(state >> 3);
      try_it(changed);
    }
  }
}

TEST_F(ModelFilesTest, AFolderThatCannotBeListedIsSaid) {
  put("locked/a.obj");
  if (geteuid() == 0) GTEST_SKIP() << "the superuser may read everything";
  fs::permissions(directory_ / "locked", fs::perms::none);
  EXPECT_NE(refusal(directory_).find("cannot be listed"), std::string::npos);
  fs::permissions(directory_ / "locked", fs::perms::owner_all);
}

TEST_F(ModelFilesTest, ReferencesStayInsideOfTheModel) {
  put("city/tiles/a.gltf");
  put("city/textures/b.bin", "bytes");
  put("secret", "key");
  const ModelFiles files(directory_ / "city");
  const FindFile find = files.find_from("tiles/a.gltf");
  EXPECT_EQ(find("../textures/./b.bin")->content(), "bytes");
  EXPECT_FALSE(find("c.bin").has_value());
  for (const std::string& out :
       {std::string("../../secret"), (directory_ / "secret").string(), std::string()})
    EXPECT_THROW(find(out), Error) << out;
  const ModelFiles one(directory_ / "city/tiles/a.gltf");
  EXPECT_EQ(one.form(), ModelFiles::Form::file);
  EXPECT_EQ(one.names(), Names{"a.gltf"});
  EXPECT_TRUE(one.find_from("a.gltf")("a.gltf").has_value());
  EXPECT_THROW(one.find_from("a.gltf")("../textures/b.bin"), Error) << "outside of the file's folder";
}

TEST_F(ModelFilesTest, FilesThatOthersReferToAreNoModels) {
  put("a/tileset.json",
      R"({"asset":{},"root":{"content":{"uri":"0.b3dm"},"children":[{"content":{"url":"sub/more.json"}}]}})");
  put("a/0.b3dm");
  put("a/sub/more.json", R"({"root":{"content":{"uri":"1.glb"}}})");
  put("a/sub/1.glb");
  put("a/lost.b3dm");
  put("b/house.gltf", R"({"buffers":[{"uri":"house%20data.dat"},{"uri":"data:,x"}]})");
  put("b/house data.dat");
  put("plan.shp");
  for (const char* beside : {"plan.dbf", "plan.shx", "plan.prj", "c.mtl", "README", "SOURCE.txt", "c.PNG"})
    put(beside);
  put("c.obj");
  put("metadata.xml", "<?xml version=\"1.0\"?><gmd:MD_Metadata/>");
  put("town.xml", "<?xml version=\"1.0\"?><CityModel/>");
  put("points.las", "LASF");
  EXPECT_EQ(models(directory_), (Names{"a/tileset.json", "b/house.gltf", "c.obj", "plan.shp", "town.xml"}));
  EXPECT_EQ(dropped("tile that no tileset refers to"), 1u);
  EXPECT_EQ(dropped("file that is no model"), 2u) << "the metadata and the points";
  EXPECT_EQ(models(directory_ / "points.las"), Names{"points.las"}) << "named directly, its reader decides";
}

TEST_F(ModelFilesTest, ContentComesBeforeTheExtension) {
  EXPECT_EQ(format_of("{\"type\":\"CityJSON\"}", ".txt"), ModelFormat::cityjson);
  EXPECT_EQ(format_of("{\"type\":\"FeatureCollection\"}", ".json"), ModelFormat::geojson);
  EXPECT_EQ(format_of("{\"features\":[{\"properties\":{\"models\":[]}}],\"type\":\"FeatureCollection\"}",
                      ".geojson"),
            ModelFormat::model_index);
  EXPECT_EQ(format_of("{\"asset\":{},\"geometricError\":1}", ".json"), ModelFormat::tiles_3d);
  EXPECT_EQ(format_of("{\"asset\":{},\"meshes\":[]}", ".json"), ModelFormat::gltf);
  EXPECT_EQ(format_of("glTF\2", ".b3dm"), ModelFormat::gltf);
  EXPECT_EQ(format_of("b3dm", ".glb"), ModelFormat::tiles_3d);
  EXPECT_EQ(format_of("\xEF\xBB\xBF <?xml", ".json"), ModelFormat::citygml);
  EXPECT_EQ(format_of("  0\r\nSECTION\r\n", ".txt"), ModelFormat::dxf);
  EXPECT_EQ(format_of("999\nmade by\n  0\nSECTION\n", ".dxf"), ModelFormat::dxf);
  EXPECT_EQ(format_of("ply\nformat", ".obj"), ModelFormat::polygon_soup);
  EXPECT_EQ(format_of("OFF\n3 1 0", ".txt"), ModelFormat::polygon_soup);
  EXPECT_EQ(format_of("solid a\nfacet normal", ""), ModelFormat::polygon_soup);
  EXPECT_EQ(format_of("# made by", ""), ModelFormat::obj);
  EXPECT_EQ(format_of("# made by", ".off"), ModelFormat::polygon_soup);
  EXPECT_EQ(format_of("\x89PNG", ".png"), ModelFormat::unknown);
  EXPECT_EQ(format_of("", ""), ModelFormat::unknown);
}

TEST_F(ModelFilesTest, FilesThatAModelDependsOn) {
  put("a/tileset.json", "{}");
  put("a/tiles/0.b3dm");
  put("b/x.shp");
  put("b/x.dbf");
  put("b/y.dbf");
  put("b/g.gltf", R"({"buffers":[{"uri":"g.bin"},{"uri":"missing.bin"}]})");
  put("b/g.bin");
  const auto names = [&](const std::string& model) {
    Names found;
    for (const auto& [name, path] : files_of(directory_ / model)) {
      EXPECT_TRUE(fs::is_regular_file(path)) << path;
      found.push_back(name);
    }
    return found;
  };
  EXPECT_EQ(names("a/tileset.json"), (Names{"tiles/0.b3dm", "tileset.json"}));
  EXPECT_EQ(names("a"), names("a/tileset.json"));
  EXPECT_EQ(names("b/x.shp"), (Names{"", "x.dbf"}));
  EXPECT_EQ(names("b/g.gltf"), (Names{"", "g.bin"}));
  EXPECT_EQ(names("b/y.dbf"), Names{""});
  EXPECT_THROW(files_of(directory_ / "none"), Error);
}

}  // namespace
}  // namespace veduta
