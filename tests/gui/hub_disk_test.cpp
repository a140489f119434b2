// The thread that touches files: journals that are locked, unreadable or cannot be made, and files that others change.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <thread>

#include "common/files.h"
#include "gui/disk.h"
#include "tests/process/process.h"

namespace spacetime::test {
namespace {

using namespace gui;
namespace fs = std::filesystem;

const std::string a_journal =
    R"({"journal":"spacetime-journal/1","file":"","saved":"","text":"time [0, 1]\n","script":[],"number":1})"
    "\n";

// A disk with what it told.
struct Told {
  explicit Told(const std::string& folder) : disk(folder, [this](Event event) { keep(std::move(event)); }) {}

  void keep(Event event) {
    const std::lock_guard hold(mutex);
    events.push_back(std::move(event));
  }
  // The first event of the kind; waits for it.
  template <typename Kind>
  std::optional<Kind> wait() {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (std::chrono::steady_clock::now() < deadline) {
      {
        const std::lock_guard hold(mutex);
        for (std::size_t i = 0; i < events.size(); ++i) {
          if (!std::holds_alternative<Kind>(events[i])) continue;
          Kind found = std::get<Kind>(std::move(events[i]));
          events.erase(events.begin() + static_cast<std::ptrdiff_t>(i));
          return found;
        }
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return std::nullopt;
  }
  void rest() {
    while (!disk.idle()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  std::mutex mutex;
  std::vector<Event> events;
  Disk disk;
};

// A process that is being started has the lock of the one that starts it until it runs its own program.
TEST(HubDisk, ALockThatAStartingProgramHasForAMomentIsWaitedFor) {
  const std::string folder = scratch("lock"), journal = folder + "/1-1.journal";
  Told told(folder);
  ASSERT_TRUE(told.wait<SessionsFound>());
  write_text(journal, a_journal);
  const int held = ::open(journal.c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(::flock(held, LOCK_EX | LOCK_NB), 0);
  const pid_t child = fork();
  if (child == 0) {
    usleep(100000);
    _exit(0);
  }
  ::close(held);
  told.disk.perform(ReadFile{journal});
  told.rest();
  EXPECT_TRUE(
      std::ranges::any_of(told.events, [](const Event& event) { return event.index() == Event(Restored{}).index(); }));
  waitpid(child, nullptr, 0);
}

TEST(HubDisk, AJournalThatCannotBeReadIsKeptAndToldOf) {
  const std::string folder = scratch("unreadable");
  fs::create_directories(folder);
  const std::string newer = folder + "/1-1.journal", begun = folder + "/1-2.journal";
  write_text(newer, "{\"journal\":\"spacetime-journal/99\"}\n");
  write_text(begun, "{\"journal\":\"spacetime-jou");
  Told told(folder);
  const auto failed = told.wait<FileFailed>();
  ASSERT_TRUE(failed);
  EXPECT_NE(failed->message.find(newer), std::string::npos) << failed->message;
  ASSERT_TRUE(told.wait<SessionsFound>());
  EXPECT_TRUE(fs::exists(newer));
  EXPECT_FALSE(fs::exists(begun));
}

TEST(HubDisk, AJournalGoesOnlyWhenAnotherHoldsWhatItHeld) {
  const std::string folder = scratch("nowhere"), old = scratch("old.journal");
  write_text(old, a_journal);
  Told told(folder);
  ASSERT_TRUE(told.wait<SessionsFound>());
  fs::remove_all(folder);
  told.disk.perform(JournalBegin{});
  ASSERT_TRUE(told.wait<FileFailed>());  // it cannot be made
  told.disk.perform(JournalLine{"{}"});
  told.disk.perform(JournalDrop{old, true});
  told.rest();
  EXPECT_TRUE(fs::exists(old));
  fs::create_directories(folder);
  told.disk.perform(JournalBegin{});
  told.disk.perform(JournalDrop{old, true});
  told.rest();
  EXPECT_FALSE(fs::exists(old));
}

TEST(HubDisk, FilesAreKnownByTheirWholeNames) {
  const std::string file = scratch("whole.scene"), relative = fs::relative(file).string();
  ASSERT_NE(file, relative);
  Told told({});
  told.disk.perform(WriteFile{relative, "a", false});
  told.disk.perform(ReadFile{relative});
  const auto written = told.wait<FileWritten>();
  const auto read = told.wait<FileRead>();
  ASSERT_TRUE(written && read);
  EXPECT_EQ(written->file, file);
  EXPECT_EQ(read->file, file);
}

TEST(HubDisk, WhatOthersWroteSinceItWasReadIsNotReplacedUnasked) {
  const std::string file = scratch("shared.scene");
  write_text(file, "as it was");
  Told told({});
  told.disk.perform(ReadFile{file});
  told.disk.perform(WatchFile{file});
  told.disk.perform(WriteFile{file, "mine", false});
  ASSERT_TRUE(told.wait<FileWritten>());
  write_text(file, "another's");
  fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(2));
  told.disk.perform(WriteFile{file, "mine again", false});
  const auto changed = told.wait<FileChanged>();
  ASSERT_TRUE(changed);
  told.rest();
  EXPECT_EQ(read_text(file), "another's");
  told.disk.perform(WriteFile{file, "mine again", true});
  ASSERT_TRUE(told.wait<FileWritten>());
  EXPECT_EQ(read_text(file), "mine again");
}

}  // namespace
}  // namespace spacetime::test
