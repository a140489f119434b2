#include "protocol/framing.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace spacetime::protocol {
namespace {

// All headers of one message together.  Real ones have some forty bytes; a thousand leave room for any library's.
constexpr std::size_t most_header_bytes = 1024;

bool is_blank(char character) {
  return character == ' ' || character == '\t' || character == '\r' || character == '\n';
}

bool same_word(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

// The length that a block of headers tells.
std::optional<std::size_t> content_length(std::string_view headers) {
  std::optional<std::size_t> length;
  while (!headers.empty()) {
    const auto end = std::min(headers.find('\n'), headers.size());
    const auto line = trimmed(headers.substr(0, end));
    headers.remove_prefix(std::min(end + 1, headers.size()));
    const auto colon = line.find(':');
    if (colon == line.npos) return std::nullopt;
    if (!same_word(line.substr(0, colon), "Content-Length")) continue;
    const auto digits = trimmed(line.substr(colon + 1));
    std::size_t value = 0;
    const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || rest != digits.data() + digits.size() || length) return std::nullopt;
    length = value;
  }
  return length;
}

std::string too_long(std::string_view found, std::size_t most) {
  return "a message of " + std::string(found) + " bytes, more than the limit of " + std::to_string(most);
}

bool is_letter(char character) { return std::isalpha(static_cast<unsigned char>(character)) != 0; }

// The beginning of what should have been something else.
std::string beginning(std::string_view found) {
  constexpr std::size_t longest = 40;
  const auto line = found.substr(0, found.find_first_of("\r\n"));
  return "'" + std::string(line.substr(0, longest)) + (line.size() > longest ? "..." : "") + "'";
}

std::string no_header(std::string_view found) {
  return "expected a header \"Content-Length: N\" and an empty line before the message, found " + beginning(found);
}

}  // namespace

std::optional<Frame> FrameReader::next() {
  if (ended_) return std::nullopt;
  if (framing_ == Framing::unknown) {
    skip_blanks();
    if (begin_ == buffer_.size()) return std::nullopt;
    framing_ = is_letter(buffer_[begin_]) ? Framing::headers : Framing::lines;
  }
  return framing_ == Framing::headers ? next_with_headers() : next_line();
}

std::optional<Frame> FrameReader::next_line() {
  for (;;) {
    const std::string_view rest = std::string_view(buffer_).substr(begin_);
    const auto end = rest.find('\n', scanned_);
    const auto length = std::min(end, rest.size());
    if (skipping_ || length > most_bytes_) {
      const bool first = !skipping_;
      skipping_ = end == rest.npos;
      drop(skipping_ ? rest.size() : end + 1);
      if (first) return Frame{too_long("more than " + std::to_string(most_bytes_), most_bytes_), Frame::Kind::too_long};
      if (skipping_) return std::nullopt;
      continue;
    }
    if (end == rest.npos) {
      scanned_ = rest.size();
      return std::nullopt;
    }
    Frame frame{std::string(trimmed(rest.substr(0, end)))};
    drop(end + 1);
    if (frame.text.empty()) continue;
    if (!is_letter(frame.text.front())) return frame;
    return Frame{"expected a message that begins with '{', found " + beginning(frame.text) +
                     ": this connection has one message a line, as its first byte said",
                 Frame::Kind::broken};
  }
}

std::optional<Frame> FrameReader::next_with_headers() {
  skip_blanks();
  const std::string_view rest = std::string_view(buffer_).substr(begin_);
  if (!rest.empty() && !is_letter(rest.front())) {
    return end(Frame::Kind::broken, no_header(rest) + ": this connection has headers, as its first byte said");
  }
  std::size_t headers = rest.npos, body = 0;  // where the empty line and what follows it begin
  for (std::size_t at = 0, end; headers == rest.npos && (end = rest.find('\n', at)) != rest.npos; at = end + 1) {
    if (trimmed(rest.substr(at, end - at)).empty()) headers = at, body = end + 1;
  }
  if (std::min(headers, rest.size()) > most_header_bytes) {
    return end(Frame::Kind::broken, "headers of more than " + std::to_string(most_header_bytes) + " bytes");
  }
  if (headers == rest.npos) return std::nullopt;
  const auto length = content_length(rest.substr(0, headers));
  if (!length) {
    return end(Frame::Kind::broken, no_header(rest) + ", or one message a line that begins with '{'");
  }
  if (*length > most_bytes_) return end(Frame::Kind::too_long, too_long(std::to_string(*length), most_bytes_));
  if (rest.size() - body < *length) return std::nullopt;
  Frame frame{std::string(rest.substr(body, *length))};
  drop(body + *length);
  return frame;
}

std::optional<Frame> FrameReader::last() {
  if (ended_ || framing_ == Framing::unknown) return std::nullopt;
  if (framing_ == Framing::lines) {
    Frame frame{skipping_ ? std::string() : std::string(trimmed(std::string_view(buffer_).substr(begin_)))};
    drop(begun());
    return frame.text.empty() ? std::nullopt : std::optional(std::move(frame));
  }
  skip_blanks();
  if (begun() == 0) return std::nullopt;
  return end(Frame::Kind::broken, "the input ended inside a message, of which, with its headers, " +
                                      std::to_string(begun()) + " bytes came");
}

void FrameReader::skip_blanks() {
  const auto begins = std::find_if_not(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_), buffer_.end(), is_blank);
  drop(static_cast<std::size_t>(begins - buffer_.begin()) - begin_);
}

Frame FrameReader::end(Frame::Kind kind, std::string sentence) {
  ended_ = true;
  buffer_ = {};
  begin_ = 0;
  return {std::move(sentence), kind, true};
}

void FrameReader::drop(std::size_t bytes) {
  begin_ += bytes;
  scanned_ = 0;
  if (begin_ < buffer_.size() / 2) return;  // so that copying stays in proportion to what arrives
  buffer_.erase(0, begin_);
  begin_ = 0;
  if (buffer_.empty() && buffer_.capacity() > (std::size_t{1} << 16)) buffer_ = {};
}

std::string framed(std::string message, Framing framing) {
  if (framing == Framing::headers) {
    message.insert(0, "Content-Length: " + std::to_string(message.size()) + "\r\n\r\n");
  } else {
    message += '\n';
  }
  return message;
}

}  // namespace spacetime::protocol
