// What veduta-view says to bad input: one printable line and the exit status of its kind, and it leaves
// nothing behind. The program itself, in a process of its own; damage at random has
// tests/farm/damaged_result_test.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <set>

#include "tests/farm/processes.h"
#include "tests/pvs/small_city.h"

namespace veduta {
namespace {

using test::Process;
using test::TemporaryDirectory;

constexpr const char* header = "x,y,z,yaw_deg,pitch_deg\n";

class BadViewInput : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(directory_ / "work");
    write_pvs(at("good.h5"), test::small_city(), test::small_header(), test::small_row);
    write("good.csv", std::string(header) + "15,-5,1.5,0,0\r\n\n5,-5,1.5,350,-90\n");
  }

  std::string at(const std::string& name) const { return directory_ / "work" / name; }
  void write(const std::string& name, const std::string& bytes) const { test::write_bytes(at(name), bytes); }
  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(directory_ / "work"))
      names.insert(entry.path().filename());
    return names;
  }

  /// In the folder of the files, without a display. The exit status; what it says goes to `said_`.
  int run(const std::string& words, const std::string& environment = "") {
    Process process("timeout -s KILL 60 env -C " + at("") + " -u DISPLAY -u WAYLAND_DISPLAY " + environment +
                        " " VEDUTA_VIEW_PROGRAM " " + words,
                    {}, directory_ / "said");
    const int status = process.wait();
    said_ = process.output();
    return status;
  }
  int draw(const std::string& words) {
    return run(words + " --headless --frames 1 --size 32x32 --gpu software --out pictures --stats s.csv");
  }

  void expect_refused(int status, int expected, const std::string& why) {
    EXPECT_EQ(status, expected) << said_;
    EXPECT_NE(said_.find(why), std::string::npos) << said_;
    EXPECT_EQ(said_.substr(0, 13), "veduta-view: ") << said_;
    EXPECT_EQ(std::count(said_.begin(), said_.end(), '\n'), 1) << said_;
    EXPECT_LT(said_.size(), 400u) << said_.substr(0, 1000);
    EXPECT_TRUE(std::all_of(said_.begin(), said_.end() - 1, [](char c) { return (c & 0xe0) != 0; })) << said_;
  }
  void expect_file_refused(const std::string& file, const std::string& why) {
    const auto before = files();
    expect_refused(draw(file), 65, why);
    EXPECT_EQ(files(), before) << "nothing is left behind";
  }
  void expect_path_refused(const std::string& content, const std::string& why) {
    write("bad.csv", content);
    expect_file_refused("good.h5 --path bad.csv", why);
    EXPECT_NE(said_.find("bad.csv"), std::string::npos) << said_;
  }
  void expect_usage_refused(const std::string& words, const std::string& why) {
    const auto before = files();
    expect_refused(run(words), 2, why);
    EXPECT_EQ(files(), before) << "nothing is left behind";
  }

  /// good.h5 with one byte changed in the middle of the first chunk of a dataset.
  void damage(const std::string& name, const char* dataset) const {
    const hid_t file = H5Fopen(at("good.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t data = H5Dopen(file, dataset, H5P_DEFAULT);
    const hid_t space = H5Dget_space(data);
    hsize_t offset[2] = {}, size = 0;
    haddr_t address = 0;
    unsigned mask = 0;
    ASSERT_GE(H5Dget_chunk_info(data, space, 0, offset, &mask, &address, &size), 0);
    H5Sclose(space), H5Dclose(data), H5Fclose(file);
    std::string bytes = test::read_bytes(at("good.h5"));
    bytes[address + size / 2] = static_cast<char>(bytes[address + size / 2] ^ 0x10);
    write(name, bytes);
  }

  TemporaryDirectory directory_;
  std::string said_;
};

// Without this, the refusals below would show nothing.
TEST_F(BadViewInput, GoodInputIsDrawn) {
  const int status = draw("good.h5 --path good.csv");
  if (status == 2 && said_.find("gpu: ") != std::string::npos) GTEST_SKIP() << said_;
  EXPECT_EQ(status, 0) << said_;
  EXPECT_TRUE(std::filesystem::exists(at("pictures/frame_0000.png")));
  EXPECT_TRUE(std::filesystem::exists(at("s.csv")));
}

TEST_F(BadViewInput, AFileThatIsNone) {
  expect_file_refused("none.h5", "none.h5");
  expect_file_refused(".", "regular file");
  expect_file_refused("/dev/null", "regular file");
  write("empty.h5", "");
  expect_file_refused("empty.h5", "empty.h5");
  write("text.h5", "this is no city\n");
  expect_file_refused("text.h5", "text.h5");
  expect_file_refused("good.csv", "good.csv");
  write("png.h5", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16));
  expect_file_refused("png.h5", "png.h5");
}

TEST_F(BadViewInput, AFileThatIsCutOff) {
  const std::string bytes = test::read_bytes(at("good.h5"));
  for (const size_t part : {1, 2, 3}) {
    write("cut.h5", bytes.substr(0, bytes.size() * part / 4));
    expect_file_refused("cut.h5", "cut.h5");
  }
  write("cut.h5", bytes.substr(0, bytes.size() - 1));
  expect_file_refused("cut.h5", "cut.h5");
}

TEST_F(BadViewInput, AFileOfAnotherVersion) {
  std::filesystem::copy_file(at("good.h5"), at("old.h5"));
  const hid_t file = H5Fopen(at("old.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t attribute = H5Aopen(file, "version", H5P_DEFAULT);
  const uint32_t version = 97;
  H5Awrite(attribute, H5T_NATIVE_UINT32, &version);
  H5Aclose(attribute), H5Fclose(file);
  expect_file_refused("old.h5", "version 97");
}

TEST_F(BadViewInput, AnHdf5FileThatIsNoCity) {
  H5Fclose(H5Fcreate(at("other.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  expect_file_refused("other.h5", "other.h5");
}

TEST_F(BadViewInput, AByteThatChanged) {
  if (draw("good.h5 --path good.csv") == 2) GTEST_SKIP() << said_;
  std::filesystem::remove_all(at("pictures"));
  std::filesystem::remove(at("s.csv"));
  // Some of it is read only when it is drawn: the folder may be there, a picture or figures are not.
  for (const char* dataset : {"/scene/vertices", "/scene/triangles", "/pvs/object_step", "/cells/bounds"}) {
    damage("bad.h5", dataset);
    expect_refused(draw("bad.h5 --path good.csv"), 65, dataset);
    EXPECT_FALSE(std::filesystem::exists(at("pictures/frame_0000.png"))) << dataset;
    EXPECT_FALSE(std::filesystem::exists(at("s.csv"))) << dataset;
  }
}

TEST_F(BadViewInput, APathThatIsNone) {
  expect_file_refused("good.h5 --path none.csv", "none.csv");
  expect_file_refused("good.h5 --path .", ".");
  expect_file_refused("good.h5 --path good.h5", "header");
  expect_path_refused("", "header");
  expect_path_refused(header, "no eye point");
  expect_path_refused("time,x,y,z\n1,2,3,4\n", "header");
  expect_path_refused("5,-5,1.5,0,0\n", "header");
}

TEST_F(BadViewInput, APathOfNonsense) {
  const auto line = [](const std::string& text) { return header + ("5,-5,1.5,0,0\n" + text + "\n"); };
  expect_path_refused(line("nan,0,0,0,0"), "line 3: \"nan\"");
  expect_path_refused(line("0,inf,0,0,0"), "line 3: \"inf\"");
  expect_path_refused(line("0,0,1e39,0,0"), "line 3: \"1e39\"");
  expect_path_refused(line("0,0,0,north,0"), "line 3: \"north\"");
  expect_path_refused(line("0,0,0,0"), "line 3: ");
  expect_path_refused(line("0,0,0,0,0,0"), "line 3: ");
  expect_path_refused(line(",,,,"), "line 3: ");
  expect_path_refused(line("0 0 0 0 0"), "line 3: ");
  expect_path_refused(line("0,0,0,0,91"), "line 3: pitch_deg");
  expect_path_refused(line("\x1b[31m\a,0,0,0,0"), "line 3: ");
  expect_path_refused(line(std::string(1000, '\xff')), "line 3: ");
  expect_path_refused(line(std::string(10'000'000, '7') + ",0,0,0,0"), "line 3: ");
  expect_path_refused(std::string(10'000'000, 'x'), "header");
}

TEST_F(BadViewInput, AnEyePointOutsideTheWorldIsDrawn) {
  write("far.csv", std::string(header) + "3e38,-3e38,1e30,1e30,90\n");
  const int status = draw("good.h5 --path far.csv");
  if (status == 2 && said_.find("gpu: ") != std::string::npos) GTEST_SKIP() << said_;
  EXPECT_EQ(status, 0) << said_;
  EXPECT_EQ(std::count(said_.begin(), said_.end(), '\n'), 2)
      << "outside every view-cell; 1 picture: " << said_;
}

TEST_F(BadViewInput, WordsThatItDoesNotKnow) {
  const std::string headless = "good.h5 --headless --out pictures ";
  expect_usage_refused("", "");
  expect_usage_refused("--headless --out pictures", "");
  expect_usage_refused(headless + "--stereo hologram", "hologram");
  expect_usage_refused(headless + "--stereo Side-By-Side-3D", "Side-By-Side-3D");
  expect_usage_refused(headless + "--pvs perhaps", "perhaps");
  expect_usage_refused(headless + "--size 12by9", "12by9");
  expect_usage_refused(headless + "--size 99999x99999", "99999");
  for (const char* option : {"--iod", "--screen-distance", "--fov"})
    expect_usage_refused(headless + option + " nan", option);
  expect_usage_refused(headless + "--fov 180", "--fov");
  expect_usage_refused(headless + "--stereo quad-buffer", "quad-buffer");
  expect_usage_refused(headless + "--memory 1", "--memory");
  expect_usage_refused(headless + "--find castle", "castle");
  expect_usage_refused(headless + "--find '\nca\x1b[31mstle\n'", "stle");
  expect_usage_refused(headless + "--stereo 'a\nb'", "a?b");
  expect_usage_refused("good.h5 --compare", "--out");
  expect_usage_refused("good.h5 --play", "--path");
  expect_usage_refused(headless + "--telescope", "telescope");
  expect_usage_refused(headless + "other.h5", "other.h5");
  expect_usage_refused("good.h5 --headless", "--out");
}

TEST_F(BadViewInput, AGpuThatIsNotThere) {
  expect_refused(run("good.h5 --headless --out pictures --gpu 4000000"), 2, "4000000");
}

TEST_F(BadViewInput, AWindowWithoutADisplay) {
  expect_usage_refused("good.h5", "--headless");
  expect_refused(run("good.h5", "DISPLAY=:9999"), 2, "--headless");
}

TEST_F(BadViewInput, AFolderThatCannotBe) {
  write("taken", "a file");
  const int status = run("good.h5 --headless --frames 1 --size 32x32 --out taken/pictures");
  expect_refused(status, 74, "taken");
}

}  // namespace
}  // namespace veduta
