// SPDX-License-Identifier: Apache-2.0
#include "text/words.hpp"

#include <gtest/gtest.h>

namespace cortex::cli {
namespace {

using Split = std::vector<std::string>;

TEST(Words, AreSplitAtBlanksOutsideOfQuotes) {
    EXPECT_EQ(splitWords("set  /arm\tgain=0.5\r"), (Split{"set", "/arm", "gain=0.5"}));
    EXPECT_EQ(splitWords("set /arm \"weights=0.1 0.2\" 'a \"b\"'"),
              (Split{"set", "/arm", "weights=0.1 0.2", "a \"b\""}));
    EXPECT_EQ(splitWords("a\\ b c=\"\\\"\" '\\' \"\""), (Split{"a b", "c=\"", "\\", ""}));
    EXPECT_EQ(splitWords(" \t "), Split{});
}

TEST(Words, EndAtARemarkThatBeginsAWord) {
    EXPECT_EQ(splitWords("list # all"), Split{"list"});
    EXPECT_EQ(splitWords("set /arm name=a#b '#c'"), (Split{"set", "/arm", "name=a#b", "#c"}));
}

TEST(Words, AreWrittenAsTheyAreReadAgain) {
    for (const std::string text : {"alice", "Bob of the night", "it's", "a \"b\" \\c", "#1", "",
                                   "Zoë", " ", "a\tb", "desk#4711"}) {
        EXPECT_EQ(splitWords(asWord(text)), Split{text}) << asWord(text);
        if (text.empty()) continue;
        EXPECT_EQ(splitWords(asWord(text, "\"")), Split{text}) << asWord(text, "\"");
        if (text.front() != '#') EXPECT_EQ(splitWords(asWord(text, "a")), Split{text}) << text;
    }
    EXPECT_EQ(asWord("alice"), "alice");
    EXPECT_EQ(asWord("Bob of the night", "'B"), "'Bob of the night'");
}

TEST(Words, HaveALastOneThatMayGoOn) {
    const struct {
        const char *line, *last;
    } table[] = {
        {"", ""},
        {"list", "list"},
        {"list ", ""},
        {"list /dr", "/dr"},
        {"handover / \"Bob of", "\"Bob of"},
        {"handover / \"Bob of\" ", ""},
        {"handover / 'Bob of the\" n", "'Bob of the\" n"},
        {"handover / Bob\\ of\\ ", "Bob\\ of\\ "},
        {"a \\\"b c", "c"},
    };
    for (const auto& each : table) {
        EXPECT_EQ(std::string{each.line}.substr(lastWord(each.line)), each.last) << each.line;
    }
}

TEST(Words, NeedTheEndOfAQuote) {
    EXPECT_FALSE(splitWords("set /arm 'name").has_value());
    EXPECT_FALSE(splitWords("\"it's").has_value());
}

}  // namespace
}  // namespace cortex::cli
