#include "protocol/framing.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "protocol/rpc.h"

namespace spacetime::protocol {
namespace {

constexpr std::size_t most = 100;

std::string text_of(const Frame& frame) {
  const char* kind[] = {"", "too long: ", "broken: "};
  return kind[static_cast<int>(frame.kind)] + frame.text;
}

// What a reader finds in a stream that comes in these pieces and ends.
std::vector<std::string> frames(const std::vector<std::string_view>& pieces) {
  FrameReader reader(most);
  std::vector<std::string> found;
  for (const auto piece : pieces) {
    reader.add(piece);
    while (const auto frame = reader.next()) found.push_back(text_of(*frame));
  }
  if (const auto frame = reader.last()) found.push_back("last: " + text_of(*frame));
  return found;
}

const std::string lines = "\r\n {\"a\": 1}\r\n\n[2]\n" + std::string(150, 'x') + "\n{\"b\": 3}\nunfinished";
const std::string headers =
    "Content-Length: 7\r\n\r\n{\"a\":1}content-length:3\r\nContent-Type: x\r\n\r\n[\n]\n\nContent-Length: "
    "0\n\nContent-Length: "
    "2\r\n\r\n{}";

TEST(Framing, WhatAStreamHoldsWhereverItIsCut) {
  for (const std::string& stream : {lines, headers}) {
    const auto whole = frames({stream});
    EXPECT_EQ(whole.size(), stream == lines ? 5u : 4u);
    std::vector<std::string_view> bytes;
    for (std::size_t k = 0; k < stream.size(); ++k) {
      const std::string_view view = stream;
      EXPECT_EQ(frames({view.substr(0, k), view.substr(k)}), whole) << k;
      bytes.push_back(view.substr(k, 1));
    }
    EXPECT_EQ(frames(bytes), whole);
  }
}

TEST(Framing, MessagesAreThoseThatWereSent) {
  EXPECT_EQ(frames({lines}),
            (std::vector<std::string>{"{\"a\": 1}", "[2]",
                                      "too long: a message of more than 100 bytes, more than the limit of 100",
                                      "{\"b\": 3}", "last: unfinished"}));
  EXPECT_EQ(frames({headers}), (std::vector<std::string>{"{\"a\":1}", "[\n]", "", "{}"}));
  for (const auto framing : {Framing::lines, Framing::headers}) {
    EXPECT_EQ(frames({framed("{\"c\":4}", framing)}), std::vector<std::string>{"{\"c\":4}"});
  }
}

TEST(Framing, WhoIsAnsweredInLinesKnowsAHeaderForNone) {
  FrameReader reader(most, Framing::lines);
  reader.add("hello\n{}\n");
  EXPECT_EQ(reader.next()->kind, Frame::Kind::broken);
  EXPECT_EQ(reader.next()->text, "{}");
}

TEST(Framing, ALongAnswerIsCopiedOnce) {
  const std::string result = "{\"long\":\"" + std::string(100'000, 'x') + "\"}";
  const auto stays = [&](std::string message) {
    const auto framing = message.size() % 2 == 0 ? Framing::lines : Framing::headers;
    const char* const begin = message.data();
    EXPECT_LT(message.capacity(), result.size() + 200);
    EXPECT_EQ(framed(std::move(message), framing).data(), begin);
  };
  for (const std::string method : {"a", "ab"}) {
    stays(answer(method, result));
    stays(request("1", method, result));
    stays(notification(method, result));
  }
}

TEST(Framing, WhatNoPeerMaySay) {
  for (const std::string stream : {"Content-Length: -1\r\n\r\n", "Content-Length: 1e3\r\n\r\n",
                                   "Content-Length 3\r\n\r\n", "Content-Length: 3\r\nContent-Length: 3\r\n\r\n",
                                   "GET / HTTP/1.1\r\n\r\n", "Content-Length: 99999999999999999999\r\n\r\n"}) {
    const auto found = frames({stream});
    ASSERT_EQ(found.size(), 1u) << stream;
    EXPECT_TRUE(found[0].starts_with("broken: ")) << stream;
  }
  EXPECT_TRUE(frames({"A" + std::string(2000, 'a')})[0].starts_with("broken: "));
  EXPECT_TRUE(frames({"Content-Length: 101\r\n\r\n"})[0].starts_with("too long: "));
  EXPECT_TRUE(frames({"Content-Length: 10000000000\r\n\r\n{"})[0].starts_with("too long: "));
}

TEST(Framing, WhatIsCutShortOrFramedTheOtherWayIsTold) {
  const auto told = [](const std::string& stream) { return frames({stream}).back(); };
  const std::string headed = "Content-Length: 2\r\n\r\n{}";
  EXPECT_EQ(frames({headed, "\r\n"}).size(), 1u);
  EXPECT_EQ(told(headed + "{"),
            "broken: expected a header \"Content-Length: N\" and an empty line before the message, found '{': this "
            "connection has headers, as its first byte said");
  EXPECT_EQ(told(headed + headed.substr(0, 22)),
            "last: broken: the input ended inside a message, of which, with its headers, 22 bytes came");
  EXPECT_EQ(told("{}\n" + std::string(150, 'x')),
            "too long: a message of more than 100 bytes, more than the limit of 100");
  const auto mixed = frames({"{}\n" + headed + "\n"});
  ASSERT_EQ(mixed.size(), 3u);
  EXPECT_EQ(mixed[1],
            "broken: expected a message that begins with '{', found 'Content-Length: 2': this connection has one "
            "message a line, as its first byte said");
  EXPECT_EQ(mixed[2], "{}");
}

}  // namespace
}  // namespace spacetime::protocol
