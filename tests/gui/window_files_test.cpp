// The window where folders are not what it expects.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "common/files.h"
#include "tests/gui/driven.h"
#include "tests/gui/driver.h"
#include "tests/process/process.h"

namespace spacetime::test {
namespace {

namespace fs = std::filesystem;

// The folder that it was started in is gone: files are chosen from elsewhere.
TEST(Window, OpensFilesWhereItsFolderIsGone) {
  const fs::path before = fs::current_path();
  const std::string folder = scratch("window_files_gone");
  fs::create_directories(folder);
  Driver d(daemons(), 960, 600);
  d.open_example("double_integrator");
  fs::current_path(folder);
  fs::remove_all(folder);
  EXPECT_NO_THROW({
    d.key(GLFW_KEY_O, true);
    d.frame(3);
  });
  EXPECT_TRUE(d.has("confirm file"));
  d.key(GLFW_KEY_ESCAPE);
  d.frame(3);
  d.screen().memory().files.dialog = gui::FilesMemory::Dialog::film;
  EXPECT_NO_THROW(d.frame(3));
  EXPECT_TRUE(d.has("make film"));
  fs::current_path(before);
}

TEST(Window, AFilmWithoutAFolderForItsFilesIsToldOf) {
  Driver d(daemons(), 960, 600);
  d.open_example("double_integrator");
  const char* set = std::getenv("TMPDIR");
  const std::optional<std::string> before = set ? std::optional<std::string>(set) : std::nullopt;
  const std::string film = scratch("window_files_film") + ".png";
  ::setenv("TMPDIR", "/proc/nothing", 1);
  d.hub().post(gui::Film{film, 12});
  d.frame(2);
  d.until([](const gui::State& s) { return !s.film; }, "an end of the film");
  if (before)
    ::setenv("TMPDIR", before->c_str(), 1);
  else
    ::unsetenv("TMPDIR");
  EXPECT_NE(told(d.state()).find("TMPDIR"), std::string::npos) << told(d.state());
}

// A folder is read again now and then, not with every frame.
TEST(Window, AFolderIsListedAsItChanges) {
  const std::string folder = scratch("window_files_list");
  fs::create_directories(folder);
  write_text(folder + "/one.scene", "time [0, 1]\n");
  Driver d(daemons(), 960, 600);
  d.key(GLFW_KEY_O, true);
  d.frame(3);
  d.screen().memory().files.folder = folder;
  d.frame(2);
  EXPECT_TRUE(d.has("file one.scene"));
  write_text(folder + "/two.scene", "time [0, 1]\n");
  const double since = d.screen().memory().files.listing.since;
  d.frame(10);
  EXPECT_EQ(d.screen().memory().files.listing.since, since);
  d.frame(60);
  EXPECT_TRUE(d.has("file two.scene"));
}

}  // namespace
}  // namespace spacetime::test
