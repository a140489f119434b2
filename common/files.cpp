#include "common/files.h"

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

}  // namespace

std::string read_text(const std::string& file) {
  if (file == "-") return read_stream(std::cin, "standard input");
  if (std::filesystem::is_directory(file)) throw InputError("cannot read '" + file + "': it is a directory");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError("cannot read '" + file + "': " + reason());
  return read_stream(in, "'" + file + "'");
}

void write_text(const std::string& file, std::string_view text) {
  if (file == "-") {
    std::cout << text << std::flush;
    if (!std::cout) throw InputError("cannot write to standard output");
    return;
  }
  // A name of its own, so that two programs writing one file do not mix their halves.
  const std::string beside = file + ".part" + std::to_string(getpid());
  std::ofstream out(beside, std::ios::binary);
  if (!out) throw InputError("cannot write '" + beside + "': " + reason());
  out << text << std::flush;
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(beside, file, error);
  if (!out || error) {
    const std::string why = error ? error.message() : reason();
    std::filesystem::remove(beside, error);
    throw InputError("cannot write '" + file + "': " + why);
  }
}

}  // namespace spacetime
