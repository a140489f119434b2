// spacetime-gui render as a person runs it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/diagnostic.h"
#include "common/files.h"
#include "gui/render/image.h"
#include "gui/render/pattern.h"
#include "tests/process/process.h"

namespace spacetime::gui {
namespace {

namespace fs = std::filesystem;
using test::Result, test::scratch;

// A bead that slides from 0 to 1 in half a second, as a motion file.
const std::string& motion() {
  static const std::string file = [] {
    const Result solved = test::solve_scene(
        "time [0, 0.5]\ntrajectory bspline spans 4\ncreature ball {\n  link body { prismatic X axis (1, 0, 0); mass 1 "
        "}\n}\n"
        "constrain (ball.X, ball.X') = 0 at 0\nconstrain ball.X = 1 at 0.5\nminimize integral(ball.X''^2)\n",
        {"-q"});
    EXPECT_EQ(solved.code, 0) << solved.err;
    std::string path = scratch("motion.json");
    write_text(path, solved.out);
    return path;
  }();
  return file;
}

Result render(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"render", motion()});
  return test::run("spacetime-gui", arguments);
}

// Reddish, bluish, ... : how many pixels are not nearly grey.
int coloured(const Image& image) {
  int count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto* p = image.at(x, y);
      count += std::max({p[0], p[1], p[2]}) - std::min({p[0], p[1], p[2]}) > 40 ? 1 : 0;
    }
  }
  return count;
}

double middle_of_colour(const Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto* p = image.at(x, y);
      if (std::max({p[0], p[1], p[2]}) - std::min({p[0], p[1], p[2]}) > 40) sum += x;
    }
  }
  return sum / coloured(image);
}

TEST(Render, NumberedPicturesShowTheMotion) {
  const fs::path folder = scratch("frames");  // which is made
  const Result result = render({"-o", (folder / "%04d.png").string(), "--rate", "10", "--size", "320x180"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  double last = 0;
  for (int k = 0; k < 6; ++k) {
    const Image image = read_png((folder / ("000" + std::to_string(k) + ".png")).string());
    EXPECT_EQ(image.width, 320);
    EXPECT_EQ(image.height, 180);
    EXPECT_GT(coloured(image), 100);
    const double middle = middle_of_colour(image);
    EXPECT_GT(middle, last + 5) << k;  // it slides to the right
    last = middle;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 6);
}

// After half of its time the ball has slid (3 s^2 - s^3) / 2 = 0.3125 m, s being that half; the camera looks there, or
// beside it.
TEST(Render, TheCameraStandsWhereItIsTold) {
  const auto middle = [](const std::string& camera) {
    const std::string file = scratch("camera.png");
    const Result result = render({"-o", file, "--at", "0.25", "--size", "320x180", "--camera=" + camera});
    EXPECT_EQ(result.code, 0) << camera << result.err;
    return middle_of_colour(read_png(file));
  };
  EXPECT_NEAR(middle("0.3125,0,0,0,0,3"), 160, 2);
  EXPECT_NEAR(middle("0.3125,0,0,0,0,3,orthographic"), 160, 2);
  const double aside = middle("0.6125,0,0,0,0,3");
  EXPECT_LT(aside, 140);
  EXPECT_NEAR(middle("0.0125,0,0,0,0,3"), 320 - aside, 2);
  EXPECT_GT(middle("0.6125,0,0,180,0,3"), 180);  // from behind
  for (const std::string wrong : {"1,2,3", "0,0,0,0,0,-1", "a,b,c,d,e,f"}) {
    const Result result = render({"-o", "x.png", "--at", "0", "--camera=" + wrong});
    EXPECT_EQ(result.code, 1) << wrong;
    EXPECT_NE(result.err.find(wrong), std::string::npos) << result.err;
  }
}

TEST(Render, APartOfTheMotionIsDrawnAlone) {
  const fs::path folder = scratch("part");
  const Result result =
      render({"-o", (folder / "%d.png").string(), "--rate", "10", "--size", "64x48", "--from=0.2", "--to", "0.4"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 3);
}

// A constant that is a place is marked where the problem tells of it, as the window does.
TEST(Render, PlacesAreMarkedWhereTheProblemIsGiven) {
  const std::string scene =
      "time [0, 1]\ntrajectory bspline spans 4\nconstant GoalX = 1\nconstant GoalY = 0.5\ncreature ball {\n  link body "
      "{ prismatic X axis (1, 0, 0); mass 1 }\n}\nconstrain ball.X = GoalX at 1\nminimize integral(ball.X''^2)\n";
  const std::string problem = scratch("place.problem.json"), moving = scratch("place.motion.json");
  write_text(problem, test::run("spacetime-symbolic", {"compile", "-"}, scene).out);
  write_text(moving, test::solve_scene(scene, {"-q"}).out);
  const auto picture = [&](std::vector<std::string> more) {
    const std::string file = scratch("place.png");
    more.insert(more.begin(),
                {"render", moving, "-o", file, "--at", "0", "--size", "320x180", "--camera=1,0.5,0,0,0,2"});
    const Result result = test::run("spacetime-gui", more);
    EXPECT_EQ(result.code, 0) << result.err;
    return read_png(file);
  };
  const Image without = picture({}), with = picture({"--problem", problem});
  // The ring is about the middle, its inside as it was.
  EXPECT_EQ(std::vector(with.at(160, 90), with.at(161, 90)), std::vector(without.at(160, 90), without.at(161, 90)));
  int changed = 0;
  for (int y = 80; y <= 100; ++y)
    for (int x = 150; x <= 170; ++x) changed += with.at(x, y)[2] != without.at(x, y)[2] ? 1 : 0;
  EXPECT_GT(changed, 60);
  int beside = 0;  // its name
  for (int y = 80; y <= 100; ++y)
    for (int x = 176; x <= 230; ++x) beside += with.at(x, y)[2] != without.at(x, y)[2] ? 1 : 0;
  EXPECT_GT(beside, 40);
  EXPECT_EQ(with.at(20, 20)[2], without.at(20, 20)[2]);
}

TEST(Render, AStripHasAllPoses) {
  const std::string one = scratch("one.png"), strip = scratch("strip.png");
  ASSERT_EQ(render({"-o", one, "--at", "0.25", "--size", "320x180"}).code, 0);
  ASSERT_EQ(render({"-o", strip, "--strip", "4", "--size", "320x180"}).code, 0);
  EXPECT_GT(coloured(read_png(strip)), 2 * coloured(read_png(one)));  // the palest hardly count
}

TEST(Render, PosesApartDoNotOverlap) {
  const std::string strip = scratch("apart.png");
  ASSERT_EQ(render({"-o", strip, "--strip", "5", "--apart", "--size", "400x120"}).code, 0);
  const Image image = read_png(strip);
  int runs = 0;  // of columns with colour
  bool inside = false;
  for (int x = 0; x < image.width; ++x) {
    bool colour = false;
    for (int y = 0; y < image.height; ++y) {
      const auto* p = image.at(x, y);
      colour = colour || std::max({p[0], p[1], p[2]}) - std::min({p[0], p[1], p[2]}) > 40;
    }
    runs += colour && !inside ? 1 : 0;
    inside = colour;
  }
  EXPECT_EQ(runs, 5);
}

TEST(Render, TheDarkThemeIsDark) {
  const std::string light = scratch("light.png"), dark = scratch("dark.png");
  ASSERT_EQ(render({"-o", light, "--at", "0", "--size", "64x48"}).code, 0);
  ASSERT_EQ(render({"-o", dark, "--at", "0", "--size", "64x48", "--theme", "dark"}).code, 0);
  EXPECT_GT(read_png(light).at(2, 2)[0], 200);
  EXPECT_LT(read_png(dark).at(2, 2)[0], 60);
}

TEST(Render, AFilmHasItsFramesAndSize) {
  const std::string film = scratch("film.mp4");
  const Result result = render({"-o", film, "--rate", "20", "--size", "161x91"});
  ASSERT_EQ(result.code, 0) << result.err;
  const std::string told = scratch("told");
  ASSERT_EQ(
      std::system(
          ("ffprobe -v error -show_entries stream=width,height,nb_frames -of csv=p=0 " + film + " > " + told).c_str()),
      0);
  EXPECT_EQ(read_text(told), "162,92,11\n");  // each edge is even
  EXPECT_FALSE(fs::exists(film + ".part"));
}

TEST(Render, CurvesAreDrawnAsPngAndAsSvg) {
  const std::string png = scratch("curves.png"), svg = scratch("curves.svg");
  ASSERT_EQ(render({"--curves", "ball,ball.X'", "--curves", "ball''", "-o", png}).code, 0);
  EXPECT_EQ(read_png(png).height, 550);
  EXPECT_GT(coloured(read_png(png)), 1000);
  ASSERT_EQ(render({"--curves", "ball.X'", "-o", svg}).code, 0);
  EXPECT_NE(read_text(svg).find(">ball.X'</text>"), std::string::npos);
}

TEST(Render, WithoutFfmpegItSaysWhatToInstall) {
  const Result result = [&] {
    const std::string path = std::getenv("PATH");
    setenv("PATH", "/nowhere", 1);
    auto made = render({"-o", scratch("none.mp4"), "--size", "64x48"});
    setenv("PATH", path.c_str(), 1);
    return made;
  }();
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.err.find("install the package ffmpeg"), std::string::npos) << result.err;
}

TEST(Render, CtrlCLeavesWhatIsFinished) {
  const fs::path folder = scratch("stopped");
  const Result result = test::run(
      "spacetime-gui", {"render", motion(), "-o", (folder / "%d.png").string(), "--rate", "900"}, "", "picture 2 ");
  EXPECT_EQ(result.code, 2);
  EXPECT_NE(result.err.find("stopped after"), std::string::npos);
  const auto files = std::distance(fs::directory_iterator(folder), {});
  EXPECT_GE(files, 2);
  EXPECT_LT(files, 450);
  for (int k = 0; k < files; ++k) read_png((folder / (std::to_string(k) + ".png")).string());  // all whole
}

TEST(Render, RefusesInSentencesThatSayWhatToDo) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"-o", "x.gif"}, "'x.gif' is none of them"},
      {{"-o", "x.png"}, "--at 0.5"},
      {{"-o", "x%d%d.png"}, "exactly one %04d"},
      {{"-o", "x%5d.png"}, "exactly one %04d"},
      {{"-o", "x%s.png"}, "exactly one %04d"},
      {{"-o", "x%d.png", "--at", "0"}, "numbers many files"},
      {{"-o", "x.mp4", "--strip", "4"}, "no film"},
      {{"-o", "x.png", "--at", "7"}, "lasts from"},
      {{"-o", "x%d.png", "--from", "0.4", "--to", "0.2"}, "no motion from 0.4 to 0.2 s"},
      {{"-o", "x%d.png", "--to", "0.7"}, "lasts from 0 to 0.5 s"},
      {{"-o", "x.png", "--at", "0", "--apart"}, "poses of a --strip"},
      {{"-o", "x.png", "--at", "0", "--size", "12"}, "like 1280x720"},
      {{"-o", "x.png", "--at", "0", "--size", "9999999x20"}, "like 1280x720"},
      {{"-o", "x.png", "--at", "0", "--size", "99999x20"}, "its edges must be"},
      {{"-o", "x.png", "--at", "0", "--trail", "nose"}, "there are ball, ball.body"},
      {{"-o", "x%d.png", "--rate", "0"}, "--rate"},
      {{"-o", "x.png", "--curves", "ball.X,nose"}, "there is no curve 'nose'; there are ball.X"},
      {{"-o", "x.mp4", "--curves", "ball"}, "as .png or .svg"},
      {{"-o", "x.png", "--curves", "ball", "--at", "0"}, "by themselves"},
      {{"-o", "x.png", "--at", "0", "--view", "under"}, "--view"},
      {{"-o", "/proc/no/x.png", "--at", "0"}, "/proc/no"},
      {{"-o", "/proc/x.png", "--at", "0"}, "/proc/x.png"},
      {{"-o", "x.png", "--at", "0", "--problem", "/nowhere.json"}, "/nowhere.json"},
  };
  for (const auto& [arguments, words] : cases) {
    const Result result = render(arguments);
    EXPECT_EQ(result.code, 1) << arguments[1];
    EXPECT_NE(result.err.find(words), std::string::npos) << arguments[1] << ": " << result.err;
  }
}

TEST(Render, TheProblemOfAnotherMotionIsRefused) {
  const std::string other = scratch("other.json");
  const Result compiled =
      test::run("spacetime-symbolic", {"compile", "-"}, "time [0, 1]\ntrajectory bspline spans 4\ndof stray\n");
  ASSERT_EQ(compiled.code, 0) << compiled.err;
  write_text(other, compiled.out);
  const Result result = render({"-o", "x.png", "--at", "0", "--problem", other});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.err.find("the motion has no 'stray'"), std::string::npos) << result.err;
}

TEST(Pattern, NumbersFiles) {
  EXPECT_EQ(pattern_of("a/%04d.png")->file(7), "a/0007.png");
  EXPECT_EQ(pattern_of("%d")->file(123), "123");
  EXPECT_EQ(pattern_of("f%02d_x.png")->file(123), "f123_x.png");
  EXPECT_FALSE(pattern_of("plain.png"));
  for (const char* wrong : {"%", "%%", "%x", "%0d", "%00d", "%04", "%04d%d", "%010d", "%-4d", "100%"}) {
    EXPECT_THROW(pattern_of(wrong), InputError) << wrong;
  }
}

}  // namespace
}  // namespace spacetime::gui
