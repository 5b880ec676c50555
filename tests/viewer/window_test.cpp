// veduta-view in a window, as a user has it: on a display without a screen (Xvfb), keys pressed by another
// program (xdotool). What is shown is compared with the pictures of --headless, pixel by pixel.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <png.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <memory>

#include "pvs/pvs_file.h"
#include "tests/farm/processes.h"
#include "tests/pvs/small_city.h"
#include "tests/viewer/toy_city.h"
#include "tests/worker/celled_city.h"
#include "viewer/image.h"
#include "viewer/path.h"

namespace veduta {
namespace {

using test::Process;
using test::TemporaryDirectory;
using test::within;

constexpr double patience_s = 60;

/// A display of its own for each test: what it starts is shown there, drawn by the CPU as --gpu software is.
class Display {
 public:
  explicit Display(const std::filesystem::path& folder) {
    ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    // Two that begin at once, beside what a killed one left, may take the same number. One that resets when
    // its last client goes refuses the next for a moment.
    const int lock =
        ::open((testing::TempDir() + "veduta_display.lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    ::flock(lock, LOCK_EX);
    process_ = std::make_unique<Process>(
        "Xvfb -displayfd 1 -noreset -screen 0 1280x1024x24 -nolisten tcp 2>/dev/null", test::Environment{},
        folder / "display");
    within(patience_s, [&] { return process_->ended() || process_->output().ends_with('\n'); });
    const std::string number = process_->output().substr(0, process_->output().find('\n'));
    ::setenv("DISPLAY", (":" + number).c_str(), 1);
    works_ = within(patience_s, [&] {
      return process_->ended() || std::system("xdotool getdisplaygeometry >/dev/null 2>&1") == 0;
    });
    works_ = works_ && !process_->ended();
    ::close(lock);
  }
  ~Display() { end(); }
  bool works() const { return works_; }

 private:
  /// It removes its lock and socket.
  void end() {
    if (!process_) return;
    if (!process_->ended()) ::kill(process_->pid(), SIGTERM);
    process_->wait();
  }

  std::unique_ptr<Process> process_;
  bool works_ = false;
};

Image read_png(const std::filesystem::path& file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  Image image;
  if (!png_image_begin_read_from_file(&png, file.c_str())) return image;
  png.format = PNG_FORMAT_RGB;
  image.width = png.width, image.height = png.height;
  image.rgb.resize(PNG_IMAGE_SIZE(png));
  png_image_finish_read(&png, nullptr, image.rgb.data(), 0, nullptr);
  return image;
}

size_t different_pixels(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height) return std::max(a.rgb.size(), b.rgb.size()) / 3;
  size_t count = 0;
  for (size_t i = 0; i < a.rgb.size(); i += 3)
    count +=
        !std::equal(a.rgb.begin() + static_cast<ptrdiff_t>(i), a.rgb.begin() + static_cast<ptrdiff_t>(i + 3),
                    b.rgb.begin() + static_cast<ptrdiff_t>(i));
  return count;
}

/// A street with a tower, a wall, a house and a shed; every cell sees all of them, and there is room to walk.
void write_street(const std::filesystem::path& file) {
  toy::Street street = toy::make_street();
  City& city = street.file.city;
  CellOptions options;
  options.region = {{-20, -20}, {40, -20}, {40, 20}, {-20, 20}};
  const test::CelledCity celled(city.scene, options, 0.5);
  city.cells = celled.cells, city.navigation = celled.navigation;
  write_pvs(file, city, test::small_header(), [&](uint32_t) {
    BakedCell cell;
    for (uint32_t object = 0; object < city.scene.objects.size(); ++object)
      cell.row.push_back({object, completely_visible});
    return cell;
  });
}

class Window : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v Xvfb >/dev/null && command -v xdotool >/dev/null") != 0)
      GTEST_SKIP() << "no Xvfb or no xdotool here: apt-get install xvfb xdotool";
    write_street(folder_ / "city.pvs.h5");
    write_path(folder_ / "pose.csv", {pose_});
    display_ = std::make_unique<Display>(folder_.path());
    ASSERT_TRUE(display_->works());
    if (run("--path pose.csv --play --size 32x32", "MESA_DEBUG=silent") == 2 &&
        said_.find("OpenGL 4.3") != std::string::npos)
      GTEST_SKIP() << "Xvfb has no OpenGL 4.3 here";
  }

  std::string viewer(const std::string& words) const {
    return std::string(VEDUTA_VIEW_PROGRAM) + " city.pvs.h5 " + words;
  }
  std::string in_folder(const std::string& environment = "") const {
    return "env -C " + folder_.path().string() + " -u WAYLAND_DISPLAY " + environment + " ";
  }
  /// Runs the viewer to its end. \return its exit status; what it printed is in said_.
  int run(const std::string& words, const std::string& environment = "") {
    Process process("timeout -s KILL 100 " + in_folder(environment) + viewer(words), {}, folder_ / "said");
    const int status = process.wait();
    said_ = process.output();
    return status;
  }

  void open(const std::string& words) {
    process_ = std::make_unique<Process>(
        in_folder() + viewer("--out shots --path pose.csv --stats stats.csv " + words), test::Environment{},
        folder_ / "output");
    const std::string found = "xdotool search --onlyvisible --name Veduta windowfocus >/dev/null 2>&1";
    ASSERT_TRUE(within(patience_s, [&] { return process_->ended() || tool(found); }));
    ASSERT_FALSE(process_->ended()) << process_->output();
  }
  bool tool(const std::string& words) const { return std::system((in_folder() + words).c_str()) == 0; }
  void press(const std::string& keys) const { ASSERT_TRUE(tool("xdotool key --delay 30 " + keys)); }
  void on_window(const std::string& action) const {
    ASSERT_TRUE(tool("xdotool search --onlyvisible --name Veduta " + action));
  }

  /// The next line "saved FILE"; where the file lies.
  std::filesystem::path saved() {
    std::string text;
    const auto whole = [&] {
      text = process_->output().substr(read_);
      return text.find('\n') != std::string::npos;
    };
    EXPECT_TRUE(within(patience_s, whole)) << text;
    const std::string line = text.substr(0, text.find('\n'));
    read_ += line.size() + 1;
    EXPECT_EQ(line.rfind("saved shots/", 0), 0u) << line;
    return folder_.path() / line.substr(line.find(' ') + 1);
  }
  Image screenshot() {
    press("F12");
    return read_png(saved());
  }
  /// Screenshots until one is the picture: pages come when they come, and what is said goes by itself.
  testing::AssertionResult shows(const Image& picture) {
    size_t different = 0;
    const bool equal = within(patience_s, [&] {
      different = different_pixels(screenshot(), picture);
      if (different > 0) std::this_thread::sleep_for(std::chrono::seconds(5));
      return different == 0;
    });
    if (equal) return testing::AssertionSuccess();
    return testing::AssertionFailure() << different << " pixels differ";
  }
  void quit() {
    press("ctrl+q");
    EXPECT_EQ(process_->wait(), 0) << process_->output();
  }

  Image headless(const std::string& words) {
    EXPECT_EQ(run("--headless --gpu software --path pose.csv --out pictures " + words), 0) << said_;
    return read_png(folder_ / "pictures/frame_0000.png");
  }
  /// Rows of stats.csv, as numbers.
  std::vector<std::vector<double>> stats() const {
    std::istringstream file(test::slurp(folder_ / "stats.csv"));
    std::vector<std::vector<double>> rows;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
      std::istringstream words(line);
      rows.emplace_back();
      for (std::string word; std::getline(words, word, ',');) rows.back().push_back(std::stod(word));
    }
    return rows;
  }

  const Pose pose_{{0.25f, 0.25f, 1.7f}, -10, 5};
  TemporaryDirectory folder_;
  std::unique_ptr<Display> display_;
  std::unique_ptr<Process> process_;
  std::string said_;
  size_t read_ = 0;
};

TEST_F(Window, ShowsWhatHeadlessDraws) {
  const Image picture = headless("--size 320x200");
  ASSERT_EQ(picture.width, 320u);
  open("--size 320x200");
  press("h");  // without the figures
  EXPECT_TRUE(shows(picture));
  EXPECT_GT(different_pixels(screenshot(), headless("--size 320x200 --fov 50")), 1000u)
      << "any picture would do";
  quit();
}

TEST_F(Window, ShowsEachKindOfStereo) {
  // Half pictures, both in one, and one that goes by the rows of the screen.
  for (const std::string mode : {"side-by-side-half", "anaglyph", "interlaced-rows"}) {
    const Image picture = headless("--size 320x200 --stereo " + mode);
    read_ = 0;
    open("--size 320x200 --stereo " + mode);
    press("h");
    EXPECT_TRUE(shows(picture)) << mode;
    if (mode == "interlaced-rows") {  // a row further down, the other eye's rows are shown
      const Image swapped = headless("--size 320x200 --swap-eyes --stereo " + mode);
      ASSERT_GT(different_pixels(picture, swapped), 100u);
      on_window("windowmove 31 41");
      EXPECT_TRUE(shows(swapped));
    }
    quit();
  }
}

TEST_F(Window, KeysChangeWhatIsShown) {
  const Image mono = headless("--size 320x200"), right = headless("--size 320x200 --stereo right");
  ASSERT_GT(different_pixels(mono, right), 100u);
  open("--size 320x200");
  press("h t t");
  EXPECT_TRUE(shows(right));
  press("shift+t shift+t");
  EXPECT_TRUE(shows(mono));
  press("F1");
  EXPECT_GT(different_pixels(screenshot(), mono), 1000u) << "no help";
  press("Escape");
  EXPECT_TRUE(shows(mono));
  quit();
}

TEST_F(Window, RecordsAWalkAndPlaysItBack) {
  open("--size 160x100");
  press("r");
  ASSERT_TRUE(tool("xdotool keydown s sleep 1.5 keyup s"));
  press("r");
  const std::vector<Pose> path = read_path(saved());
  quit();
  EXPECT_GT(path.size(), 30u);
  EXPECT_LT(path.back().position_m.x, path.front().position_m.x - 1) << "backwards from the tower";
  EXPECT_NEAR(path.back().position_m.z, 1.7f, 0.3f) << "it walks";
  const auto rows = stats();
  ASSERT_GT(rows.size(), 5u);
  EXPECT_NEAR(rows.back()[10], path.back().position_m.x, 0.01) << "the last line tells where it ended";

  // Played, a pose a frame, it is over by itself.
  write_path(folder_ / "walk.csv", {path.begin(), path.begin() + 20});
  ASSERT_EQ(run("--path walk.csv --play --stats played.csv --size 160x100"), 0) << said_;
  std::filesystem::rename(folder_ / "played.csv", folder_ / "stats.csv");
  const auto played = stats();
  ASSERT_EQ(played.size(), 20u);
  for (size_t i = 0; i < played.size(); ++i) EXPECT_NEAR(played[i][10], path[i].position_m.x, 1e-4) << i;
}

TEST_F(Window, FillsTheScreenAndComesBack) {
  open("--size 320x200");
  press("F11");
  EXPECT_TRUE(within(patience_s, [&] { return screenshot().width == 1280; }));
  press("F11");
  EXPECT_TRUE(within(patience_s, [&] { return screenshot().width == 320; }));
  on_window("windowsize 333 201");
  EXPECT_TRUE(within(patience_s, [&] { return screenshot().width == 333; }));
  quit();
}

TEST_F(Window, FallsBackToSideBySideWithoutQuadBuffer) {
  const Image picture = headless("--size 160x200 --stereo side-by-side");
  ASSERT_EQ(picture.width, 320u);
  open("--size 320x200 --stereo quad-buffer");
  ASSERT_TRUE(within(patience_s, [&] { return process_->output().find('\n') != std::string::npos; }));
  read_ = process_->output().find('\n') + 1;
  EXPECT_NE(process_->output().find("quad-buffer"), std::string::npos) << process_->output();
  press("h");
  EXPECT_TRUE(shows(picture));
  quit();
}

TEST_F(Window, SaysWhatItLacks) {
  EXPECT_EQ(run("", "MESA_GL_VERSION_OVERRIDE=3.3"), 2) << said_;
  EXPECT_NE(said_.find("no OpenGL 4.3"), std::string::npos) << said_;
  EXPECT_NE(said_.find("--headless"), std::string::npos) << said_;
  EXPECT_EQ(std::count(said_.begin(), said_.end(), '\n'), 1) << said_;
  EXPECT_EQ(run("", "-u DISPLAY"), 2) << said_;
  EXPECT_NE(said_.find("no display"), std::string::npos) << said_;
  EXPECT_EQ(std::count(said_.begin(), said_.end(), '\n'), 1) << said_;
}

}  // namespace
}  // namespace veduta
