// The client's daemons that are no daemons, or speak otherwise than the protocol has it: told, and never the client's
// end.
#include <unistd.h>

#include <filesystem>

#include "tests/wire/clients.h"

namespace spacetime::protocol {
namespace {

TEST(WrongDaemon, IsGivenUpWhereThereIsNoProgram) {
  Client client({{"/nowhere/spacetime-optimizer"}, {}, {}}, {});
  const Reply reply = answer(client, "motion/get", Json::object());
  EXPECT_EQ(reply.error["code"], static_cast<int>(Code::internal));
}

TEST(WrongDaemon, IsLostWhereItsGreetingIsRefused) {
  // What a daemon of another protocol's version says, and one that is full.
  const auto says = [](int code, const std::string& why) {
    const std::string error = R"({"jsonrpc":"2.0","id":0,"error":{"code":)" + std::to_string(code) + R"(,"message":")";
    return Target{{"/bin/sh", "-c", "read line; echo '" + error + why + "\"}}'; exec cat > /dev/null"}, {}, {}};
  };
  {
    Course course;
    Client client(says(static_cast<int>(Code::unknown_version), "this daemon speaks version 2"), course.callbacks());
    EXPECT_TRUE(course.next_is(Client::State::lost, "this daemon speaks version 2"));
    EXPECT_EQ(answer(client, "motion/get", Json::object()).error["code"], static_cast<int>(Code::internal));
    EXPECT_EQ(client.process(), 0);
  }
  Course course;
  const Client client(says(static_cast<int>(Code::too_many_sessions), "17 connections"), course.callbacks());
  EXPECT_TRUE(course.next_is(Client::State::connecting, "17 connections"));
  EXPECT_TRUE(course.next_is(Client::State::connecting, "17 connections"));
}

TEST(WrongDaemon, IsLostWhereANewDaemonRefusesWhatTheLastOneHasDone) {
  // The first daemon of a folder loads anything and ends; the next loads nothing.
  const auto folder = std::filesystem::path(testing::TempDir()) / ("refuses" + std::to_string(getpid()));
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  const std::string script = "cd '" + folder.string() + R"('; read line; echo '{"jsonrpc":"2.0","id":0,"result":{}}'
read line; mkdir loaded 2> /dev/null && echo '{"jsonrpc":"2.0","id":1,"result":{}}' && exit
echo '{"jsonrpc":"2.0","id":0,"error":{"code":-32005,"message":"not any more"}}'; exec cat > /dev/null)";
  Course course;
  Client client({{"/bin/sh", "-c", script}, {}, {}}, course.callbacks());
  result(client, "problem/load", {{"problem", Json::object()}});
  EXPECT_TRUE(course.next_is(Client::State::connecting, "the daemon has ended the connection"));
  EXPECT_TRUE(course.next_is(Client::State::lost, "problem/load: not any more"));
  EXPECT_EQ(client.process(), 0);
}

// A daemon that greets, waits for one request, and says this.
Target saying(const std::string& words) {
  return {{"/bin/sh", "-c",
           R"(read line; echo '{"jsonrpc":"2.0","id":0,"result":{}}'; read line; echo ')" + words +
               "'; exec cat > /dev/null"},
          {},
          {}};
}

TEST(WrongDaemon, IsLostWithASentenceWhereItsAnswersAreNone) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({"method":"$/progress","params":[]})", "message: /params: expected an object, found a list of 0"},
      {R"({"method":"$/progress","params":{"token":1}})", "message: /params: the member \"value\" is missing"},
      {R"({"method":7})", "message: /method: expected a string, found 7"},
      {R"({"id":1,"result":null})", "answer to motion/get: /result: expected an object, found null"},
      {R"({"id":1,"result":{}})", "answer to motion/get: /result: the member \"motion\" is missing"},
      {R"({"id":1,"result":{"motion":[]}})", "answer to motion/get: /result/motion: expected an object"},
      {R"({"id":1,"result":{"log":{},"motion":{}}})", "answer to motion/get: /result/log: expected a list"},
      {R"({"id":1})", "answer to motion/get: the member \"result\" is missing"},
      {R"({"id":1,"error":"no"})", "answer to motion/get: /error: expected an object, found \"no\""},
      {R"({"id":1,"error":{"code":1,"message":null}})",
       "answer to motion/get: /error/message: expected a string, found null"},
      {R"({"id":1,"error":{"code":"1","message":""}})",
       "answer to motion/get: /error/code: expected an integer, found \"1\""},
  };
  for (const auto& [words, why] : cases) {
    Course course;
    Client client(saying(words), course.callbacks());
    const Reply reply = answer(client, "motion/get", Json::object());
    EXPECT_EQ(reply.error["code"], static_cast<int>(Code::internal)) << words;
    const std::string sentence = std::string("what the daemon says is not as the protocol says: ") + why;
    EXPECT_TRUE(course.next_is(Client::State::lost, sentence)) << words;
  }
}

TEST(WrongDaemon, WhatNobodyHasAskedForIsPassedOver) {
  for (const char* words :
       {R"({"id":7,"result":null})", R"({"id":null,"error":7})", R"({"id":"1"})", R"({"id":0,"result":null})",
        R"({"method":"$/other"})", R"({"method":"$/progress","params":{"token":"x","value":1}})", "{}"}) {
    Course course;
    Client client(saying(words + std::string("\n") + R"({"id":1,"result":{"well":true}})"), course.callbacks());
    EXPECT_EQ(answer(client, "sample", Json::object()).result["well"], true) << words;
  }
}

TEST(WrongDaemon, IsStartedAnewAndToldWhereItSaysWhatIsNoMessage) {
  const auto says = [](const std::string& words) {
    return Target{{"/bin/sh", "-c", "echo '" + words + "'; exec cat > /dev/null"}, {}, {}};
  };
  const std::pair<const char*, const char*> cases[] = {
      {"hello", "no message: expected a message that begins with '{', found 'hello'"},
      {"12 o\u2019clock, and all is well", "no message: 12 o\u2019clock, and all"},
      {"[1, 2]", "no message: [1, 2]"},
      {"{\"id\": 0,", "no message: {\"id\": 0,"},
  };
  for (const auto& [words, why] : cases) {
    Course course;
    const Client client(says(words), course.callbacks());
    EXPECT_TRUE(course.next_is(Client::State::connecting, why));
    EXPECT_TRUE(course.next_is(Client::State::connecting, why));
  }
}

}  // namespace
}  // namespace spacetime::protocol
