#include "common/files.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>

#include "common/diagnostic.h"

namespace spacetime {
namespace {

std::string reason() { return std::generic_category().message(errno); }

std::string read_stream(std::istream& in, const std::string& name) {
  std::string text;
  char block[1 << 16];
  while (in.read(block, sizeof block), in.gcount() > 0) {
    text.append(block, static_cast<std::size_t>(in.gcount()));
    if (text.size() > max_file_bytes) throw InputError(name + " is larger than a gigabyte");
  }
  if (in.bad()) throw InputError(name + " cannot be read to its end");
  return text;
}

void write_stream(std::ostream& out, std::string_view text, const std::string& name) {
  out << text << std::flush;
  if (!out) throw InputError("cannot write to " + name);
}

bool written_through(const std::string& file) {
  const int opened = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (opened < 0) return false;
  const bool done = ::fsync(opened) == 0;
  const int why = errno;
  ::close(opened);
  errno = why;
  return done;
}

}  // namespace

std::string read_text(const std::string& file) {
  if (file == "-") return read_stream(std::cin, "standard input");
  if (std::filesystem::is_directory(file)) throw InputError("cannot read '" + file + "': it is a directory");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError("cannot read '" + file + "': " + reason());
  return read_stream(in, "'" + file + "'");
}

void write_text(const std::string& file, std::string_view text) {
  if (file == "-") return write_stream(std::cout, text, "standard output");
  namespace fs = std::filesystem;
  const auto refuse = [&](const std::string& why) { throw InputError("cannot write '" + file + "': " + why); };
  std::error_code error;
  const fs::file_status there = fs::status(file, error);  // of what a link points to
  error.clear();  // where there is no such file, that is no mistake; where it cannot be seen, opening it says so
  if (fs::is_directory(there)) refuse("it is a directory");
  // A device or a pipe takes what it is given; a file put in its place would take it from everybody.
  if (fs::exists(there) && !fs::is_regular_file(there)) {
    std::ofstream out(file, std::ios::binary);
    if (!out) refuse(reason());
    return write_stream(out, text, "'" + file + "'");
  }
  // Behind a link the file itself is replaced.  Its new content gets a name of its own first, so that two programs that
  // write one file do not mix their halves.
  const fs::path target = fs::exists(there) ? fs::canonical(file) : fs::path(file);
  const fs::path beside = target.string() + ".part" + std::to_string(getpid());
  std::ofstream out(beside, std::ios::binary);
  if (!out) refuse(reason());
  out << text << std::flush;
  out.close();
  if (out && fs::exists(there)) fs::permissions(beside, there.permissions(), error);
  // Its content first, then its name: a machine that fails in between has the old one or the new one, whole.
  if (out && !error && !written_through(beside)) error = {errno, std::generic_category()};
  if (out && !error) fs::rename(beside, target, error);
  if (!out || error) {
    const std::string why = error ? error.message() : reason();
    fs::remove(beside, error);
    refuse(why);
  }
}

}  // namespace spacetime
