#include "protocol/path.h"

namespace spacetime {

std::string below(std::string_view path, std::string_view member) {
  std::string result(path);
  result += '/';
  for (const char character : member) {
    if (character == '~') {
      result += "~0";
    } else if (character == '/') {
      result += "~1";
    } else {
      result += character;
    }
  }
  return result;
}

std::string below(std::string_view path, std::size_t index) {
  return std::string(path).append("/").append(std::to_string(index));
}

}  // namespace spacetime
