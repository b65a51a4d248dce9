// SPDX-License-Identifier: Apache-2.0
// Names that people gave, as both programs say them.
#include "common/person_name.hpp"

#include "cortex/core/error.hpp"

#include <cstddef>
#include <string>

#include <pwd.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace cortex::common;

TEST(PersonName, IsWhatWasGivenAndOtherwiseTheUserAndHisMachine) {
    EXPECT_EQ(personName("alice"), "alice");
    EXPECT_EQ(personName("Zoë of the night shift"), "Zoë of the night shift");

    const std::string name = personName("");
    const passwd* user = getpwuid(geteuid());
    char host[256] = {};
    gethostname(host, sizeof host - 1);
    const std::string whole =
        (user == nullptr ? std::string{"somebody"} : std::string{user->pw_name}) + "@" + host;
    EXPECT_EQ(name, whole.substr(0, 63));
    EXPECT_EQ(personName(name), name) << "it can be given";
}

TEST(PersonName, IsRefusedWithARemedyWhereNoToolMayTellItOfItself) {
    EXPECT_EQ(personName(std::string(63, 'x')), std::string(63, 'x'));
    for (const std::string& wrong :
         {std::string(64, 'x'), std::string(10'000, 'x'), std::string{"a\nb"},
          std::string{"\x1b[m"}, std::string{"\x7f"}, std::string{"a\0b", 3}, std::string{"\xff"},
          std::string{"\xc3\xbc\xc3"}, std::string{"\xc2\x9b"}, std::string{" "},
          std::string{"alice "}, std::string{"alice (cortex@desk.1-2)"}}) {
        try {
            personName(wrong);
            ADD_FAILURE() << "it was taken: " << wrong;
        } catch (const Error& error) {
            EXPECT_NE(std::string{error.what()}.find("--name"), std::string::npos) << error.what();
            EXPECT_LT(std::string{error.what()}.size(), 200U) << "without the name itself";
        }
    }
}

TEST(PersonName, IsShortenedToWhatACommandHasForItWithTheUserWholeWhereHeFits) {
    const std::string cloud = "@ip-10-0-0-1.eu-central-1.compute.internal";
    const struct {
        std::string person, said;
    } table[] = {
        {"alice", "alice"},
        {"alice@desk", "alice@desk"},
        {std::string(31, 'x'), std::string(31, 'x')},
        {std::string(29, 'x') + "@d", std::string(29, 'x') + "@d"},
        {std::string(30, 'x') + "@d", std::string(30, 'x')},
        {std::string(31, 'x') + "@d", std::string(31, 'x')},
        {std::string(32, 'x') + "@d", std::string(31, 'x')},
        {"ubuntu" + cloud, "ubuntu"},
        {"alice@home" + cloud, "alice"},
        {cloud, cloud.substr(0, 31)},
        {"Zoë of the night shift at the desk", "Zoë of the night shift at the"},
        {std::string(30, 'x') + "ë", std::string(30, 'x')},
        {std::string(29, 'x') + "ëë", std::string(29, 'x') + "ë"},
        {std::string(29, 'x') + "€", std::string(29, 'x')},
    };
    for (const auto& each : table) EXPECT_EQ(nameInCommand(each.person), each.said) << each.person;
    EXPECT_LE(nameInCommand(personName("")).size(), longestInCommand);
}

TEST(PersonName, StandsBesideTheNameOfTheToolOfWhichItIsTold) {
    EXPECT_EQ(whoText("cortex@desk.4711-5e1f0a", "alice"), "alice (cortex@desk.4711-5e1f0a)");
    EXPECT_EQ(whoText("mixer", ""), "mixer");
}

TEST(PersonName, CannotTurnWhatStandsBehindItNorCommandATerminal) {
    EXPECT_EQ(whoText("cortex@desk", "al\u202eice\u2066"), "al\\u202eice\\u2066 (cortex@desk)");
    EXPECT_EQ(whoText("\u202ecortex", "\x1b[31m"), "\\x1b[31m (\\u202ecortex)");
    EXPECT_EQ(shownName("al\u200bice"), "al\\u200bice") << "it is not alice";
    EXPECT_EQ(shownName("<b>سارة</b> Zoë"), "<b>سارة</b> Zoë") << "as told";
}

TEST(PersonName, OfAHolderIsKnownOfToolsThatSayIt) {
    comms::ToolStatus window, shell;
    window.name = "cortex-explorer@desk.1-a";
    window.person = "alice";
    shell.name = "cortex@desk.2-b";
    shell.person = "alice";
    EXPECT_EQ(personOf({window, shell}, shell.name), "alice");
    EXPECT_EQ(personOf({window}, shell.name), "");
    EXPECT_EQ(personOf({}, ""), "");
}

}  // namespace
}  // namespace cortex::test
