#include "common/files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "common/diagnostic.h"

namespace spacetime {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  Files() : folder_(fs::temp_directory_path() / ("spacetime_files_" + std::to_string(getpid()))) {
    fs::create_directory(folder_);
  }
  ~Files() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t count() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {})); }
  static std::string refusal(const std::string& file) {
    try {
      write_text(file, "new");
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

 private:
  fs::path folder_;
};

TEST_F(Files, AreReplacedWhole) {
  write_text(path("a"), "old");
  write_text(path("a"), "new");
  EXPECT_EQ(read_text(path("a")), "new");
  EXPECT_EQ(count(), 1U);
}

TEST_F(Files, KeepTheirPermissions) {
  write_text(path("a"), "old");
  fs::permissions(path("a"), fs::perms::owner_read | fs::perms::owner_write);
  write_text(path("a"), "new");
  EXPECT_EQ(fs::status(path("a")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(Files, BehindALinkAreWrittenAndTheLinkStays) {
  write_text(path("a"), "old");
  fs::create_symlink("a", path("link"));
  write_text(path("link"), "new");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(read_text(path("a")), "new");
}

TEST_F(Files, ThatArePipesAreWrittenToAndStayPipes) {
  const std::string pipe = path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::string got;
  std::thread reader([&] { got = read_text(pipe); });
  write_text(pipe, "new");
  reader.join();
  EXPECT_EQ(got, "new");
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(count(), 1U);
}

TEST_F(Files, ThatCannotBeWrittenAreNamedAsTheyWereGiven) {
  EXPECT_EQ(refusal(path("")), "cannot write '" + path("") + "': it is a directory");
  EXPECT_EQ(refusal(path("no/a")), "cannot write '" + path("no/a") + "': No such file or directory");
  EXPECT_THROW(read_text(path("none")), InputError);
  EXPECT_THROW(read_text(path("")), InputError);
}

}  // namespace
}  // namespace spacetime
