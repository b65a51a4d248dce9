// SPDX-License-Identifier: Apache-2.0
// What the command line and the window both say: numbers, times, rates, lines for a shell, what
// must be controlled for a command, and where no agent is heard.
#include "common/csv_cell.hpp"
#include "common/kind_meaning.hpp"
#include "common/loop_text.hpp"
#include "common/needed_control.hpp"
#include "common/no_agent.hpp"
#include "common/number_text.hpp"
#include "common/shell_line.hpp"
#include "common/to_its_sender.hpp"
#include "common/utc_text.hpp"
#include "core/model_folder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace cortex::common;

DataItem itemWith(const std::string& format, double resolution) {
    DataItem item;
    item.name = "x";
    item.kind = Kind::Float;
    item.format = format;
    item.resolution = resolution;
    return item;
}

TEST(KindsOfBoth, EachHasASentenceThatStandsInTheManual) {
    const std::string manual = textOf(CORTEX_SOURCE_DIR "/docs/explorer.md");
    for (int i = 0; i <= static_cast<int>(EventKind::ValueChange); ++i) {
        const std::string kind = name(static_cast<EventKind>(i));
        const std::string meaning{kindMeaning(kind)};
        EXPECT_TRUE(meaning.ends_with('.')) << kind;
        EXPECT_LT(std::ranges::count(meaning, ' '), 25) << meaning;
        EXPECT_NE(manual.find("| `" + kind + "` | " + meaning + " |"), std::string::npos) << kind;
    }
    EXPECT_EQ(kindMeaning("of a later build"), "");
}

TEST(NumberOfBoth, FollowsFormatThenResolutionThenSixDigits) {
    const struct {
        double number;
        const char *format, *text;
        double resolution;
    } table[] = {
        {-2.0943951023931953, "", "-2.0944", 0},
        {-2.0943951023931953, "%.2f", "-2.09", 0},
        {12.3456, "", "12.35", 0.01},
        {12.3456, "%.1f", "12.3", 0.001},
        {-0.0001, "", "0.00", 0.01},
        {0, "", "0", 0},
        {-0.0, "", "0", 0},
        {0.00055318000572928685, "", "0.00055318", 0},
        {1234567, "", "1234567", 0},
        {2.5e7, "", "2.5e7", 0},
        {-2.5e-5, "", "-2.5e-5", 0},
        {9.9999999e-5, "", "1e-4", 0},
        {123456789.25, "%.2f", "123456789.25", 0},
        {2e300, "%.2f", "2e300", 0},
        {std::numeric_limits<double>::infinity(), "%.2f", "inf", 0},
        {std::numeric_limits<double>::quiet_NaN(), "", "nan", 0},
    };
    for (const auto& each : table)
        EXPECT_EQ(numberText(itemWith(each.format, each.resolution), each.number), each.text);
}

TEST(NumberOfBoth, IsNeverFurtherOffThanHalfItsLastDigit) {
    std::mt19937_64 random{1};
    std::uniform_real_distribution<double> mantissa{-10, 10};
    std::uniform_int_distribution<int> exponent{-300, 300};
    for (int i = 0; i < 10'000; ++i) {
        const double number = mantissa(random) * std::pow(10.0, exponent(random));
        const std::string text = numberText(itemWith("", 0), number);
        EXPECT_NEAR(std::strtod(text.c_str(), nullptr), number, 1e-5 * std::abs(number)) << text;
    }
}

TEST(TimeOfBoth, IsUtcWithSoManyDigitsOfASecond) {
    EXPECT_EQ(utcText(1'764'255'312'123'456'789), "2025-11-27T14:55:12.123Z");
    EXPECT_EQ(utcText(1'764'255'312'123'456'789, 9), "2025-11-27T14:55:12.123456789Z");
    EXPECT_EQ(utcText(1'764'255'312'999'999'999, 0), "2025-11-27T14:55:12Z");
    EXPECT_EQ(utcText(0), "1970-01-01T00:00:00.000Z");
    EXPECT_EQ(utcText(-1), "1969-12-31T23:59:59.999Z") << "what is below the digits is cut off";
}

TEST(RateOfBoth, SaysWhatIsReachedWhereThatIsNotWhatIsWanted) {
    const auto rate = [](double hertz, std::int64_t period) {
        comms::AgentStatus agent;
        agent.rate = hertz;
        agent.period = period;
        return rateText(agent);
    };
    EXPECT_EQ(rate(938.27, 1'000'000), "938.3 of 1000 Hz");
    EXPECT_EQ(rate(990, 1'000'000), "1000 Hz");
    EXPECT_EQ(rate(0, 1'000'000), "1000 Hz") << "it has not said what it reaches";
    EXPECT_EQ(rate(9.14, 10'000'000), "9.14 of 100 Hz");
    EXPECT_EQ(rate(0.25, 4'000'000'000), "0.25 Hz");
    EXPECT_EQ(rate(12'345, 50'000), "12345 of 20000 Hz");
    EXPECT_EQ(rate(100, 0), "");
}

TEST(LineForAShell, HasTheNetworkAsItWasChosenAndQuotesWhatAShellWouldTake) {
    comms::NetworkOptions network;
    network.domain = 7;
    network.interfaces = {"eth0"};
    network.peers = {"10.0.0.7:7410", "robot"};
    network.discoveryServer = "station;spare";
    network.security = "/etc/it's mine";
    EXPECT_EQ(shellLine({"events", "/drive x", "--severity", "warning"}, network),
              "cortex events '/drive x' --severity warning --domain 7 --interface eth0 "
              "--peer 10.0.0.7:7410 --peer robot --discovery-server 'station;spare' "
              "--security '/etc/it'\\''s mine'");
    network = {};
    network.domain = 0;
    network.interfaces.clear();
    network.discoveryServer.clear();
    network.security.clear();
    EXPECT_EQ(shellLine({"list", ""}, network), "cortex list ''");
}

TEST(ControlForACommand, IsOfTheSimplexOrOfWhatAnAgentIsToldToDo) {
    DataItem prefix;
    prefix.name = "prefix";
    prefix.kind = Kind::String;
    prefix.initial = std::vector<std::string>{"/"};
    const auto of = [](const std::string& text) {
        return comms::Mirror::Arguments{{"prefix", std::vector<std::string>{text}}};
    };
    const struct {
        const char *path, *command;
        bool ofAgent;
        const DataItem* prefix;
        comms::Mirror::Arguments arguments;
        std::optional<std::string> needed;
    } table[] = {
        {"/arm/axis", "moveTo", false, nullptr, {}, "/arm/axis"},
        {"/arm/axis", "moveTo", false, &prefix, of("/x"), "/arm/axis"},
        {"/robot", "startup", true, &prefix, of("/arm/"), "/arm"},
        {"/robot", "startup", true, &prefix, {}, "/"},
        {"/robot", "startup", true, &prefix, of(""), "/"},
        {"/robot", "set", true, nullptr, {}, "/robot"},
        {"/robot", "shutdown", true, &prefix, of("/arm"), std::nullopt},
        {"/arm/axis", "cancel", false, nullptr, {}, std::nullopt},
        {"/robot", "takeControl", true, &prefix, of("/arm"), std::nullopt},
    };
    for (const auto& each : table) {
        EXPECT_EQ(neededControl(each.path, each.ofAgent, each.command, each.prefix, each.arguments),
                  each.needed)
            << each.path << ' ' << each.command;
    }
}

TEST(CsvCell, HasTheBytesOfItsTextInQuotesWhereTheyCouldEndIt) {
    EXPECT_EQ(csvCell("/arm/1.x"), "/arm/1.x");
    EXPECT_EQ(csvCell(""), "");
    EXPECT_EQ(csvCell("1 2"), "\"1 2\"");
    EXPECT_EQ(csvCell("a,b"), "\"a,b\"");
    EXPECT_EQ(csvCell("he said \"no\""), "\"he said \"\"no\"\"\"");
    EXPECT_EQ(csvCell("two\r\nlines"), "\"two\r\nlines\"");
    EXPECT_EQ(csvCell("\x1b[31m\x7f"), "\"\x1b[31m\x7f\"");
    EXPECT_EQ(csvCell("\xc3\xbc\xff"), "\xc3\xbc\xff");
}

TEST(CsvCell, OfFourCharactersIsNotThatOfAControlCharacter) {
    EXPECT_EQ(csvCell("\\x0d"), "\\x0d");
    EXPECT_EQ(csvCell("\r"), "\"\r\"");
}

TEST(WhyOfAnAgent, IsToldToItsSenderAsHisOwnDoing) {
    EXPECT_EQ(toItsSender("withdrawn by a later shutdown of its sender"),
              "withdrawn by your shutdown");
    for (const char* other : {"", "its time was over before its turn", "withdrawn by a later ",
                              "withdrawn by a later  of its sender"})
        EXPECT_EQ(toItsSender(other), other);
}

TEST(NoAgent, IsSaidWithItsDomainAndTheServerThatWasAskedAndWhatToTryThen) {
    EXPECT_EQ(noAgent(7, ""), "no agent on domain 7");
    const std::string server = "10.0.0.2:11811";
    EXPECT_EQ(noAgent(0, server),
              "no agent on domain 0 by way of the Discovery Server 10.0.0.2:11811");
    EXPECT_EQ(serverRemedy(server),
              "see that the server runs at 10.0.0.2:11811 (fast-discovery-server -i 0) and that "
              "the agents name it too, or leave --discovery-server (CORTEX_DISCOVERY_SERVER) out: "
              "the agents may be found without it");
}

}  // namespace
}  // namespace cortex::test
