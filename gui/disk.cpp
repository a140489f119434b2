#include "gui/disk.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "common/files.h"
#include "gui/journal.h"
#include "protocol/json.h"

namespace spacetime::gui {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds between_looks{1};  // at the watched file

std::string settings_file(const std::string& folder) { return folder + "/settings.json"; }

std::optional<std::pair<long, long>> changed(const std::string& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return std::nullopt;
  return std::pair<long, long>(status.st_mtim.tv_sec, status.st_mtim.tv_nsec);
}

// From the root, so that it names the same file for a window that is started elsewhere.
std::string whole_name(const std::string& file) { return fs::absolute(file).lexically_normal().string(); }

// A program that is being started has what this one has open, and so its locks, until it runs itself: a lock is tried
// for so long before another window is blamed.
constexpr std::chrono::milliseconds lock_patience{1000}, between_tries{5};

bool lock(int file, std::chrono::milliseconds patience) {
  const auto until = std::chrono::steady_clock::now() + patience;
  while (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EINTR && errno != EWOULDBLOCK) return false;
    if (std::chrono::steady_clock::now() >= until) return false;
    std::this_thread::sleep_for(between_tries);
  }
  return true;
}

// A journal held so that no other window takes it.
class Held {
 public:
  explicit Held(const std::string& file, std::chrono::milliseconds patience = lock_patience)
      : file_(::open(file.c_str(), O_RDWR | O_CLOEXEC)) {
    if (file_ >= 0 && lock(file_, patience)) return;
    if (file_ >= 0) ::close(file_);
    file_ = -1;
  }
  ~Held() {
    if (file_ >= 0) ::close(file_);
  }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  explicit operator bool() const { return file_ >= 0; }

 private:
  int file_;
};

// So that a file that was made in it is found after the machine has failed, too.
void sync_folder(const std::string& folder) {
  const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) return;
  ::fsync(opened);
  ::close(opened);
}

bool holds(const std::string& file, const std::string& text) {
  try {
    return read_text(file) == text;
  } catch (const std::exception&) {
    return false;
  }
}

SettingsRead read_settings(const std::string& folder) {
  SettingsRead settings;
  const std::string file = settings_file(folder);
  if (!fs::exists(file)) return settings;
  const Json json = parse(read_text(file), "settings");
  settings.dark = json.value("dark", true);
  for (const auto& recent : json.value("recent", Json::array())) {
    if (recent.is_string()) settings.recent.push_back(recent.get<std::string>());
  }
  return settings;
}

// What a window that is gone left of its session.
std::optional<Restored> read_left(const std::string& file) {
  const std::string text = read_text(file);
  if (text.find('\n') == std::string::npos) return std::nullopt;  // not even its beginning was written
  return read_journal(text);
}

// Sessions that ended without being saved.  Journals of which nothing is left to say go; those that cannot be read stay
// and are told of: a newer program, or a disk that is well again, may read them.
std::vector<LeftBehind> left_behind(const std::string& folder, const std::function<void(Event)>& post) {
  std::vector<LeftBehind> left;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string file = entry.path().string();
    if (!file.ends_with(journal_extension)) continue;
    const Held held(file, std::chrono::milliseconds(0));  // another window's is no business of this one
    if (!held) continue;
    try {
      const auto restored = read_left(file);
      if (restored && unsaved(*restored)) {
        left.push_back({file, restored->file});
        continue;
      }
    } catch (const std::exception& error) {
      post(
          FileFailed{{}, "A session that was not saved cannot be read and is kept as '" + file + "': " + error.what()});
      continue;
    }
    std::error_code error;
    fs::remove(entry.path(), error);
  }
  std::ranges::sort(left, {}, &LeftBehind::journal);
  return left;
}

}  // namespace

std::string state_folder() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state && *state) return std::string(state) + "/spacetime";
  if (const char* home = std::getenv("HOME"); home && *home) return std::string(home) + "/.local/state/spacetime";
  return {};
}

Disk::Disk(std::string folder, std::function<void(Event)> post)
    : folder_(std::move(folder)), post_(std::move(post)), thread_([this] { run(); }) {}

Disk::~Disk() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  arrived_.notify_one();
  thread_.join();
  if (journal_ >= 0) ::close(journal_);
}

void Disk::perform(Effect effect) {
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back(std::move(effect));
  }
  arrived_.notify_one();
}

bool Disk::idle() {
  const std::lock_guard lock(mutex_);
  return queue_.empty() && !busy_;
}

bool Disk::wait(std::chrono::milliseconds most) {
  std::unique_lock lock(mutex_);
  return done_.wait_for(lock, most, [&] { return queue_.empty() && !busy_; });
}

void Disk::run() {
  begin();
  std::unique_lock lock(mutex_);
  while (true) {
    arrived_.wait_for(lock, between_looks, [&] { return ending_ || !queue_.empty(); });
    if (queue_.empty() && ending_) return;
    if (queue_.empty()) {
      lock.unlock();
      look_at_watched();
      lock.lock();
      continue;
    }
    const Effect effect = std::move(queue_.front());
    queue_.pop_front();
    busy_ = true;
    lock.unlock();
    std::visit([&](const auto& which) { act(which); }, effect);
    lock.lock();
    busy_ = false;
    if (queue_.empty()) done_.notify_all();
  }
}

void Disk::begin() {
  if (folder_.empty()) return;
  try {
    fs::create_directories(folder_);
    post_(read_settings(folder_));
    post_(SessionsFound{left_behind(folder_, post_)});
  } catch (const std::exception& error) {
    // Without settings and journals one can still work.
    post_(FileFailed{folder_, "What is kept between sessions cannot be read: " + std::string(error.what())});
  }
}

void Disk::look_at_watched() {
  if (watched_.empty()) return;
  const auto now = changed(watched_);
  if (!now || now == told_) return;
  told_ = now;
  post_(FileChanged{watched_});
}

void Disk::know(const std::string& file) {
  read_ = file;
  read_stamp_ = changed(file);
  if (file == watched_) known_ = told_ = read_stamp_;
}

void Disk::act(const ReadFile& effect) {
  try {
    const std::string file = whole_name(effect.file);
    if (!file.ends_with(journal_extension)) {
      know(file);
      return post_(FileRead{file, read_text(file), effect.discard});
    }
    const Held held(file);
    if (!held) throw InputError("'" + file + "' cannot be opened, or another window has it");
    Restored restored = read_journal(read_text(file));
    restored.journal = effect.file;
    restored.discard = effect.discard;
    // Whatever its file holds now that is not what the session knew was written by somebody else.
    if (!restored.file.empty()) {
      know(restored.file);
      if (read_stamp_ && !holds(restored.file, restored.saved)) read_stamp_.reset();
    }
    post_(std::move(restored));
  } catch (const std::exception& error) {
    post_(FileFailed{effect.file, error.what()});
  }
}

void Disk::act(const WriteFile& effect) {
  try {
    const std::string file = whole_name(effect.file);
    const Stamp there = file == watched_ ? changed(file) : std::nullopt;
    if (there && there != known_ && !effect.overwrite) {
      told_ = there;
      return post_(FileChanged{effect.file, true, effect.number});
    }
    write_text(file, effect.text);
    know(file);
    post_(FileWritten{file, effect.text, effect.number});
  } catch (const std::exception& error) {
    post_(FileFailed{effect.file, error.what(), effect.number});
  }
}

void Disk::act(const WatchFile& effect) {
  if (watched_ == effect.file) return;
  watched_ = effect.file;
  known_ = told_ = watched_.empty() ? std::nullopt : watched_ == read_ ? read_stamp_ : changed(watched_);
}

void Disk::act(const JournalBegin&) {
  act(JournalEnd{true});
  if (folder_.empty()) return;
  // One's own, whatever sessions there were before.  Until it is locked, a window that starts may take it for an empty
  // one and remove it.
  while (journal_ < 0) {
    journal_file_ =
        folder_ + "/" + std::to_string(::getpid()) + "-" + std::to_string(++journals_) + std::string(journal_extension);
    journal_ = ::open(journal_file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0600);
    if (journal_ < 0 && errno == EEXIST) continue;
    if (journal_ < 0 || !lock(journal_, lock_patience)) return lose_journal();
    if (changed(journal_file_)) return sync_folder(folder_);
    ::close(journal_);
    journal_ = -1;
  }
}

void Disk::lose_journal() {
  if (journal_ >= 0) ::close(journal_);
  journal_ = -1;
  post_(FileFailed{{}, "The journal of this session cannot be written: save often."});
}

void Disk::act(const JournalLine& effect) {
  if (journal_ < 0) return;
  const std::string line = effect.json + "\n";
  std::size_t done = 0;
  while (done < line.size()) {
    const auto wrote = ::write(journal_, line.data() + done, line.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) break;
    done += static_cast<std::size_t>(wrote);
  }
  if (done == line.size() && ::fdatasync(journal_) == 0) return;
  lose_journal();  // half a line ends what can be read
}

void Disk::act(const JournalEnd& effect) {
  if (journal_ < 0) return;
  if (!effect.keep) ::unlink(journal_file_.c_str());
  ::close(journal_);
  journal_ = -1;
}

void Disk::act(const JournalDrop& effect) {
  if (effect.continued && journal_ < 0) return;
  const Held held(effect.journal);
  if (held && effect.journal.ends_with(journal_extension)) ::unlink(effect.journal.c_str());
}

void Disk::act(const KeepSettings& effect) {
  if (folder_.empty()) return;
  try {
    Json json{{"dark", effect.dark}, {"recent", effect.recent}};
    write_text(settings_file(folder_), json.dump(2) + "\n");
  } catch (const std::exception& error) {
    post_(FileFailed{folder_, "Settings cannot be kept: " + std::string(error.what())});
  }
}

}  // namespace spacetime::gui
