#include "protocol/writer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "common/diagnostic.h"
#include "protocol/json.h"

namespace spacetime {
namespace {

// Printable ASCII that stands for itself between quotes; almost every string of a document is.
bool is_plain(char character) { return character >= 0x20 && character < 0x7F && character != '"' && character != '\\'; }

void append_string(std::string& text, std::string_view value) {
  if (std::all_of(value.begin(), value.end(), is_plain)) {
    text.append("\"").append(value).append("\"");
    return;
  }
  try {
    text += Json(value).dump();
  } catch (const Json::type_error&) {
    throw InputError("text that is not UTF-8 cannot be written to a document");
  }
}

}  // namespace

void Writer::open(char bracket, Set set) {
  separate();
  text_ += bracket;
  levels_.push_back({broken_ && set == Set::in_lines, true});
}

void Writer::close(char bracket) {
  const auto level = levels_.back();
  levels_.pop_back();
  if (level.lines && !level.empty) next_line();
  text_ += bracket;
}

void Writer::separate() {
  if (std::exchange(after_key_, false) || levels_.empty()) return;
  auto& level = levels_.back();
  if (!level.empty) text_ += ',';
  if (level.lines) {
    next_line();
  } else if (!level.empty && broken_) {
    text_ += ' ';
  }
  level.empty = false;
}

void Writer::next_line() {
  text_ += '\n';
  text_.append(levels_.size(), ' ');
}

void Writer::key(std::string_view name) {
  separate();
  append_string(text_, name);
  text_ += broken_ ? ": " : ":";
  key_ = name;
  after_key_ = true;
}

void Writer::number(double value) {
  if (!std::isfinite(value)) throw InputError("a number that is not finite cannot be written (\"" + key_ + "\")");
  separate();
  if (value == 0 && std::signbit(value)) {
    text_ += "-0.0";  // readers take -0 for the integer 0 and lose the sign
    return;
  }
  char digits[32];
  text_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void Writer::integer(std::int64_t value) {
  separate();
  char digits[24];
  text_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void Writer::string(std::string_view value) {
  separate();
  append_string(text_, value);
}

void Writer::boolean(bool value) {
  separate();
  text_ += value ? "true" : "false";
}

void Writer::null() {
  separate();
  text_ += "null";
}

void Writer::json(std::string_view text) {
  separate();
  text_ += text;
}

void Writer::numbers(std::span<const double> values) {
  list_of(values, [&](double value) { number(value); });
}

void Writer::integers(std::span<const std::int32_t> values) {
  list_of(values, [&](std::int32_t value) { integer(value); });
}

std::string Writer::take() {
  SPACETIME_ASSERT(levels_.empty() && !after_key_);
  if (broken_) text_ += '\n';
  return std::move(text_);
}

}  // namespace spacetime
