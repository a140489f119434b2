// Where one message ends and the next begins, in a stream of bytes.  A peer either sends Content-Length headers before
// each message, as the base protocol of the Language Server Protocol has it, or one message a line; the first byte it
// sends tells which (a letter begins a header, anything else a line), and it is answered in kind.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace spacetime::protocol {

enum class Framing { unknown, headers, lines };

// One thing that was found in the stream: a message, or why there is none.
struct Frame {
  std::string text;  // the message, or a sentence on what is wrong with it
  enum class Kind {
    message,
    too_long,  // a message above the limit: a line is skipped, what has headers ends the stream
    broken,    // no header at all where one should be, which ends the stream; or one where a line should be
  } kind = Kind::message;
  bool ends = false;  // nothing more can be understood
};

// Takes bytes as they come, in pieces of any size, and gives the messages in them.  Holds at most one message of the
// permitted length, and never makes room for more than has arrived.
class FrameReader {
 public:
  // Whoever has spoken first is answered as he spoke: then the framing is known.
  explicit FrameReader(std::size_t most_bytes, Framing framing = Framing::unknown)
      : most_bytes_(most_bytes), framing_(framing) {}

  void add(std::string_view bytes) { buffer_.append(bytes); }
  std::optional<Frame> next();  // nothing: more bytes are needed
  std::optional<Frame>
  last();  // what is left where no more come: a line without its end, or that a message is cut short

  std::size_t begun() const { return buffer_.size() - begin_; }  // bytes of a message that is not complete
  Framing framing() const { return framing_; }

 private:
  std::optional<Frame> next_line();
  std::optional<Frame> next_with_headers();
  Frame end(Frame::Kind kind, std::string sentence);
  void skip_blanks();
  void drop(std::size_t bytes);

  std::size_t most_bytes_;
  std::string buffer_;
  std::size_t begin_ = 0;    // of what is not used yet
  std::size_t scanned_ = 0;  // from there, how far a line's end has been looked for
  bool skipping_ = false;    // inside a line that is too long
  bool ended_ = false;
  Framing framing_;
};

// The bytes that carry a message.  Text without line ends.
std::string framed(std::string message, Framing framing);

}  // namespace spacetime::protocol
