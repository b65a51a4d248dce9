// SPDX-License-Identifier: Apache-2.0
// What of an agent survives a restart, and what it takes from a file that `cortex save` wrote.
#include "cli/cortex_process.hpp"
#include "comms/inbox.hpp"
#include "processes/station.hpp"

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <regex>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using Words = std::vector<std::string>;

const std::string counter = "/counter";

class RetainedValues : public testing::Test {
protected:
    RetainedValues() {
        system = plantIn(folder, counter, "Counter",
                         "<data name='count' kind='int' min='0' retain='true'/>"
                         "<data name='gain' kind='float' unit='Hz' min='0' max='10' default='1' "
                         "settable='always' retain='true'/>"
                         "<data name='share' kind='float' min='0' max='1' retain='true'/>"
                         "<data name='offset' kind='float' default='0.5' settable='always'/>"
                         "<data name='title' kind='string' capacity='40' settable='always' "
                         "retain='true'/>");
    }
    std::vector<std::string> options(std::vector<std::string> more = {}) const {
        std::vector<std::string> all{"--plugin", CORTEX_BINARY_DIR "/lib/plugins/counter.so"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    std::filesystem::path retained() const { return folder.path() / "plant.retained.xml"; }
    std::string retainedText() const {
        return std::filesystem::exists(retained()) ? textOf(retained()) : "";
    }
    std::int64_t retainedCount() const {
        const std::string text = retainedText();
        std::smatch found;
        const std::regex value{"data=\"count\" value=\"([0-9]+)\""};
        return std::regex_search(text, found, value) ? std::stoll(found[1]) : -1;
    }
    bool countsBy(std::int64_t cycles) {
        const std::int64_t before = retainedCount();
        return station.waitFor([&] { return retainedCount() >= before + cycles; });
    }
    bool isSet(const std::string& item, double value) {
        return station.waitFor([&] { return station.real(counter, item) == value; });
    }
    static Outcome set(const std::vector<std::string>& items) {
        std::vector<std::string> arguments{"set", counter};
        arguments.insert(arguments.end(), items.begin(), items.end());
        return tool(arguments);
    }
    static Outcome tool(std::vector<std::string> arguments) {
        const comms::NetworkOptions network = comms::loopback();
        arguments.insert(arguments.end(),
                         {"--domain", std::to_string(network.domain), "--interface",
                          network.interfaces.front(), "--timeout", "60"});
        return cortex(arguments);
    }
    std::string write(const std::string& name, const std::string& items) const {
        return folder
            .write(name, "<system name='saved'>\n<simplex path='/counter' type='Counter'>\n" +
                             items + "</simplex>\n</system>\n")
            .string();
    }

    ModelFolder folder;
    std::filesystem::path system;
    Station station;
};

TEST_F(RetainedValues, ComeBackAfterAnOrderlyEndAndOthersDoNot) {
    AgentProcess agent{folder, system, options()};
    ASSERT_TRUE(station.waitFor([&] { return station.number(counter, "count") > 10; }));
    const Outcome done = set({"gain=2.5", "offset=3", "title=two <words>"});
    ASSERT_EQ(done.exit, 0) << done.errors;
    EXPECT_EQ(agent.endInOrder(), 0);
    const std::int64_t last = retainedCount();
    EXPECT_GT(last, 10) << agent.output();

    agent.start();

    ASSERT_TRUE(station.waitFor([&] { return station.number(counter, "count") > last; }));
    EXPECT_EQ(station.real(counter, "gain"), 2.5);
    EXPECT_EQ(station.real(counter, "offset"), 0.5);
    const std::string output = agent.output();
    EXPECT_TRUE(contains(output, "/counter.count 0 -> " + std::to_string(last) + "\n")) << output;
    EXPECT_TRUE(contains(output, "/counter.gain 1 -> 2.5 Hz\n")) << output;
    EXPECT_TRUE(contains(output, "/counter.title \"\" -> \"two <words>\"\n")) << output;
    EXPECT_FALSE(contains(output, "/counter.offset")) << output;
}

TEST_F(RetainedValues, LoseAtMostTheLastSecondWhenTheAgentIsKilled) {
    constexpr std::int64_t secondOfCycles = 100;
    AgentProcess agent{folder, system, options()};
    for (int round = 0; round < 3; ++round) {
        const std::int64_t first = std::max<std::int64_t>(retainedCount(), 0);
        ASSERT_TRUE(station.waitFor([&] {
            return retainedCount() > first + secondOfCycles &&
                   station.number(counter, "count") > retainedCount();
        })) << agent.output();
        const std::int64_t seen = *station.number(counter, "count");
        agent.kill9();

        const std::int64_t kept = retainedCount();
        // One second, and what writing and a busy machine take.
        EXPECT_GE(kept, seen - 2 * secondOfCycles);
        agent.start();
        ASSERT_TRUE(agent.prints("/counter.count 0 -> " + std::to_string(kept) + "\n"));
    }
}

TEST_F(RetainedValues, BelongToTheProcessThatKeepsThem) {
    AgentProcess agent{folder, system, options()};
    ASSERT_TRUE(station.waitFor([&] { return retainedCount() > 0; })) << agent.output();
    const auto trial = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {system.string(), "--offline", "--seconds", "0.3", "--set",
                                   "/counter.gain=5", "--set", "/counter.count=1000000"});
        return runProgram(CORTEX_BINARY_DIR "/bin/cortex-agent", options(more));
    };

    const Outcome second = trial({});
    EXPECT_EQ(second.exit, 5) << second.output;
    EXPECT_TRUE(contains(second.errors, retained().string() + ": process " +
                                            std::to_string(agent.pid()) + " (cortex-agent "))
        << second.errors;
    const std::string memory = textOf(folder.path() / "plant.memory");
    const Outcome without = trial({"--no-devices"});
    EXPECT_EQ(without.exit, 0) << without.errors;
    EXPECT_TRUE(contains(without.output, "/counter.count 0 -> ")) << "it reads them";
    EXPECT_EQ(textOf(folder.path() / "plant.memory"), memory);

    EXPECT_EQ(agent.endInOrder(), 0);
    EXPECT_LT(retainedCount(), 1'000'000);
    EXPECT_TRUE(contains(retainedText(), "data=\"gain\" value=\"1\"")) << retainedText();
    EXPECT_EQ(trial({}).exit, 0) << "nobody has them now";
    EXPECT_TRUE(contains(retainedText(), "data=\"gain\" value=\"5\"")) << retainedText();
}

TEST_F(RetainedValues, OfTheFirstStartGoOnInASpareThatWaitedForItsEnd) {
    AgentProcess first{folder, system, options()};
    ASSERT_TRUE(station.waitFor([&] { return retainedCount() > 0; })) << first.output();
    const ModelFolder other;
    AgentProcess spare{other, system, options({"--wait"})};
    ASSERT_TRUE(spare.prints("this one waits until it has ended\n"));
    ASSERT_EQ(set({"gain=2.5"}).exit, 0);
    EXPECT_EQ(first.endInOrder(), 0);
    const std::int64_t last = retainedCount();

    ASSERT_TRUE(spare.prints("/counter.count 0 -> " + std::to_string(last) + "\n"))
        << spare.output();
    ASSERT_TRUE(isSet("gain", 2.5)) << spare.output();
    ASSERT_TRUE(station.waitFor([&] { return station.number(counter, "count") > last; }));
    EXPECT_FALSE(contains(spare.output(), "stands still")) << spare.output();
    EXPECT_EQ(spare.endInOrder(), 0);
    EXPECT_GT(retainedCount(), last);
}

// A spare takes over from one that stands still and has not yet written what was set last.
class RetainedValuesOfTwo : public RetainedValues {
protected:
    void takeOver() {
        ASSERT_TRUE(station.waitFor([&] { return retainedCount() > 0; })) << first.output();
        spare.emplace(other, system, options({"--wait"}));
        ASSERT_TRUE(spare->prints("this one waits until it has ended\n"));
        ASSERT_TRUE(countsBy(200)) << "long after the spare has spoken" << first.output();
        ASSERT_EQ(set({"gain=2"}).exit, 0);
        kill(first.pid(), SIGSTOP);
        ASSERT_TRUE(spare->prints("100 Hz as /plant")) << spare->output();
        ASSERT_TRUE(station.waitFor([] { return set({"gain=3"}).exit == 0; })) << spare->output();
        ASSERT_TRUE(countsBy(500)) << "it has taken over for good" << spare->output();
    }
    void isReadAgain() {
        ASSERT_TRUE(first.prints("it is read again\n")) << first.output();
        EXPECT_TRUE(first.prints("/counter.gain 1 -> 3 Hz\n")) << first.output();
        EXPECT_TRUE(isSet("gain", 3)) << first.output();
        EXPECT_EQ(first.endInOrder(), 0);
        EXPECT_TRUE(keepsGain("3")) << retainedText();
    }
    bool keepsGain(const char* value) const {
        return contains(retainedText(), "data=\"gain\" value=\"" + std::string{value} + "\"");
    }

    const ModelFolder other;
    AgentProcess first{folder, system, options({"--wait"})};
    std::optional<AgentProcess> spare;
};

TEST_F(RetainedValuesOfTwo, AreThoseOfTheSpareThatTookOverAlsoWhenTheFirstIsBack) {
    takeOver();
    kill(first.pid(), SIGCONT);
    ASSERT_TRUE(first.prints("took over while this one stood still")) << first.output();

    ASSERT_TRUE(countsBy(200));
    EXPECT_TRUE(keepsGain("3")) << retainedText();

    EXPECT_EQ(spare->endInOrder(), 0) << spare->output();
    isReadAgain();
}

TEST_F(RetainedValuesOfTwo, AndItsPastAreThoseOfTheSpareAlsoWhenItEndedBeforeTheFirstWentOn) {
    takeOver();
    EXPECT_EQ(spare->endInOrder(), 0) << spare->output();
    EXPECT_TRUE(keepsGain("3")) << retainedText();

    kill(first.pid(), SIGCONT);
    isReadAgain();
    const std::string past = textOf(folder.path() / "plant.memory");
    for (const char* set : {"set(gain=2): Done", "set(gain=3): Done"}) {
        const std::size_t found = past.find(set);
        EXPECT_NE(found, std::string::npos) << set << "\n" << past;
        EXPECT_EQ(past.find(set, found + 1), std::string::npos) << set << "\n" << past;
    }
}

TEST_F(RetainedValues, KeepTheirLastGoodValueWhereTheNewOneIsNoNumber) {
    AgentProcess agent{folder, system, options()};
    const std::string good = "data=\"share\" value=\"0.25\"";
    ASSERT_TRUE(station.waitFor([&] { return contains(retainedText(), good); }));
    ASSERT_EQ(set({"gain=6"}).exit, 0);
    EXPECT_EQ(agent.endInOrder(), 0);
    EXPECT_TRUE(contains(retainedText(), "data=\"gain\" value=\"6\"")) << retainedText();
    EXPECT_TRUE(contains(retainedText(), good)) << retainedText();

    agent.start();
    ASSERT_TRUE(agent.prints("/counter.share 0 -> 0.25\n"));
    EXPECT_EQ(agent.endInOrder(), 0) << agent.output();
    EXPECT_TRUE(contains(retainedText(), good)) << "it was good before the restart";
}

TEST_F(RetainedValues, AndSavedOnesKeepATextWithControlCharacters) {
    const std::string saved = (folder.path() / "saved.xml").string();
    const std::string inFile = R"(value="a\x01b\\x02\x0a" escaped="true"/>)";
    AgentProcess agent{folder, system, options()};
    ASSERT_EQ(set({"title=a\x01"
                   "b\\x02\n"})
                  .exit,
              0);
    ASSERT_EQ(tool({"save", saved, counter}).exit, 0);
    EXPECT_TRUE(contains(textOf(saved), inFile)) << textOf(saved);
    EXPECT_EQ(agent.endInOrder(), 0);
    EXPECT_TRUE(contains(retainedText(), inFile)) << retainedText();

    agent.start();
    ASSERT_EQ(set({"title=other"}).exit, 0) << agent.output();
    EXPECT_TRUE(contains(agent.output(), R"(/counter.title "" -> "a\x01b\x02\x0a")"))
        << agent.output();
    const Outcome restored = tool({"restore", saved});
    EXPECT_EQ(restored.exit, 0) << restored.errors;
    EXPECT_EQ(agent.endInOrder(), 0);
    EXPECT_TRUE(contains(retainedText(), inFile)) << retainedText();
}

TEST_F(RetainedValues, TakeNoTextThatIsTooLongOrNoUtf8) {
    AgentProcess agent{folder, system, options()};
    const Outcome tooLong = set({"title=" + std::string(41, 'x')});
    EXPECT_EQ(tooLong.exit, 2);
    EXPECT_TRUE(contains(tooLong.errors, "title: takes 40 bytes, and 41 are given"))
        << tooLong.errors;
    const Outcome noText = set({"title=\xff"});
    EXPECT_EQ(noText.exit, 2);
    EXPECT_TRUE(contains(noText.errors, "title: the text is not UTF-8")) << noText.errors;
}

TEST_F(RetainedValues, ReplaceNothingThatIsNoRegularFile) {
    const std::filesystem::path kept = folder.write("kept.txt", "kept");
    for (const std::filesystem::path& other : {folder.path() / "link", folder.path()}) {
        if (other != folder.path()) std::filesystem::create_symlink(kept, other);
        AgentProcess agent{folder, system, options({"--retain", other.string()})};
        EXPECT_EQ(agent.waitForEnd(), 2);
        EXPECT_TRUE(contains(agent.output(), "--retain: " + other.string() + " is a "))
            << agent.output();
        EXPECT_TRUE(std::filesystem::exists(other));
    }
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link"));
    EXPECT_EQ(textOf(kept), "kept");
}

TEST_F(RetainedValues, ReplaceNoModelAndNoFileOfSettings) {
    const std::string settings = write("settings.xml", "<set data='gain' value='7'/>\n");
    const std::string other =
        folder.write("other.xml", "<system name='other'>\n</system>\n").string();
    const std::string types = (folder.path() / "types.xml").string();
    for (const auto& [words, file, told] :
         {std::tuple{Words{"--retain", system.string()}, system.string(),
                     "it is read by this agent"},
          {{"--retain", settings, "--settings", settings}, settings, "it is read by this agent"},
          {{"--log", system.string()}, system.string(), "it is read by this agent"},
          {{"--log", types}, types, "it is read by this agent"},
          {{"--retain", other}, other, "is the system file of 'other'"}}) {
        const std::string before = textOf(file);
        AgentProcess agent{folder, system, options(words)};
        EXPECT_EQ(agent.waitForEnd(), 2) << words[0];
        EXPECT_TRUE(contains(agent.output(), told)) << agent.output();
        EXPECT_EQ(textOf(file), before) << words[0];
        EXPECT_FALSE(std::filesystem::exists(file + ".broken"));
    }
}

TEST_F(RetainedValues, AreKeptWhereAClassWouldReplaceThemAsTheStartIsRefused) {
    std::filesystem::rename(
        write("values.xml", "<set data='count' value='77'/>\n<set data='title' value='reset'/>\n"),
        retained());
    const std::string before = retainedText();

    AgentProcess agent{folder, system, options({"--seconds", "0.3"})};
    EXPECT_NE(agent.waitForEnd(), 0);

    EXPECT_TRUE(contains(agent.output(),
                         "/counter: populate() writes 55 over count, which is "
                         "given as 77 ["))
        << agent.output();
    EXPECT_EQ(retainedText(), before);
}

TEST_F(RetainedValues, StartWithoutABrokenFileWhichIsToldAndSetAside) {
    folder.write("plant.retained.xml", "<system name='retained'>\n<simplex path='/coun");

    AgentProcess agent{folder, system, options({"--seconds", "0.3"})};
    EXPECT_EQ(agent.waitForEnd(), 0);

    const std::string output = agent.output();
    EXPECT_TRUE(contains(output, "plant.retained.xml:")) << output;
    EXPECT_TRUE(contains(output, "it was set aside as ")) << output;
    EXPECT_TRUE(contains(textOf(retained().string() + ".broken"), "/coun"));
    EXPECT_GT(retainedCount(), 0) << "a new one was written";

    folder.write("plant.retained.xml", "no XML");
    AgentProcess again{folder, system, options({"--seconds", "0.3"})};
    EXPECT_EQ(again.waitForEnd(), 0);
    EXPECT_TRUE(contains(textOf(retained().string() + ".broken"), "/coun")) << "as it was";
    EXPECT_EQ(textOf(retained().string() + ".broken-2"), "no XML");
}

TEST_F(RetainedValues, TakeWhatIsGoodOfAFileAndTellAllThatIsNot) {
    std::filesystem::rename(
        write("values.xml",
              "<set data='gain' value='99'/>\n<set data='count' value='many'/>\n"
              "<set data='offset' value='1'/>\n<set data='gian' value='1'/>\n"
              "<set data='title' value='kept'/>\n"),
        retained());

    AgentProcess agent{folder, system, options({"--seconds", "0.3"})};
    EXPECT_EQ(agent.waitForEnd(), 0);

    const std::string output = agent.output();
    for (const char* told :
         {"'gain': 99 is out of the range 0 to 10 [", "'count': ", "does not retain 'offset' [",
          "has no item 'gian' [", "plant.retained.xml:6]; nearest of: gain",
          "and 1 good values of it count", "/counter.title \"\" -> \"kept\""}) {
        EXPECT_TRUE(contains(output, told)) << told << " in\n" << output;
    }
}

TEST_F(RetainedValues, CannotBeWrittenWhichIsToldOnceWhileTheAgentGoesOn) {
    AgentProcess agent{
        folder, system,
        options({"--retain", (folder.path() / "none" / "r.xml").string(), "--seconds", "2.5"})};
    EXPECT_EQ(agent.waitForEnd(), 0);

    const std::string output = agent.output();
    const std::string told = "retained items are not written: ";
    ASSERT_TRUE(contains(output, told)) << output;
    EXPECT_EQ(output.find(told), output.rfind(told)) << output;
    EXPECT_TRUE(contains(output, "is missing: mkdir -p " + (folder.path() / "none").string()));
}

TEST_F(RetainedValues, AreWrittenOnceTheirFolderIsThereWhichIsTold) {
    const std::filesystem::path late = folder.path() / "late";
    AgentProcess agent{folder, system, options({"--retain", (late / "r.xml").string()})};
    for (const char* what : {"retained items are", "what the agent remembers is"}) {
        ASSERT_TRUE(agent.prints(what + (" not written: the folder " + late.string()) +
                                 " is missing: mkdir -p "));
    }

    std::filesystem::create_directory(late);

    EXPECT_TRUE(agent.prints("retained items are written again: "));
    EXPECT_TRUE(agent.prints("what the agent remembers is written again: "));
    EXPECT_TRUE(std::filesystem::exists(late / "r.xml"));
    EXPECT_TRUE(contains(textOf(late / "r.memory"), "cortex-agent memory\t1\tplant\n"));
}

TEST_F(RetainedValues, SettingsThatWereSavedAreStartValuesAndEveryDifferenceIsShown) {
    const std::string saved = (folder.path() / "tuned.xml").string();
    {
        AgentProcess agent{folder, system, options()};
        ASSERT_TRUE(isSet("gain", 1));
        ASSERT_EQ(set({"gain=4", "offset=2"}).exit, 0);
        ASSERT_TRUE(isSet("gain", 4));
        const Outcome done = tool({"save", saved, counter});
        ASSERT_EQ(done.exit, 0) << done.errors;
    }
    AgentProcess agent{folder, system,
                       options({"--settings", saved, "--set", "/counter.offset=7", "--retain",
                                (folder.path() / "fresh.xml").string(), "--seconds", "0.3"})};
    EXPECT_EQ(agent.waitForEnd(), 0);

    const std::string output = agent.output();
    EXPECT_TRUE(contains(output, "tuned.xml: 3 items, 2 of them other than before\n")) << output;
    EXPECT_TRUE(contains(output, "/counter.gain 1 -> 4 Hz\n")) << output;
    EXPECT_TRUE(contains(output, "/counter.offset 0.5 -> 2\n")) << output;
    EXPECT_TRUE(contains(textOf(folder.path() / "fresh.xml"), "data=\"gain\" value=\"4\""));
}

TEST_F(RetainedValues, SettingsWithErrorsAreRefusedWithAllOfThem) {
    const std::string wrong =
        write("wrong.xml",
              "<set data='gain' value='99'/>\n<set data='count' value='1'/>\n"
              "<set data='ofset' value='1'/>\n<set data='offset' value='x'/>\n</simplex>\n"
              "<simplex path='/conter' type='Counter'>\n</simplex>\n"
              "<simplex path='/output' type='Counter'>\n");

    AgentProcess agent{folder, system, options({"--settings", wrong})};
    EXPECT_EQ(agent.waitForEnd(), 1);

    const std::string output = agent.output();
    for (const char* told :
         {"/counter: 'gain': 99 is out of the range 0 to 10 [", "wrong.xml:3]",
          "Counter lets nobody set 'count' [", "Counter has no item 'ofset' [",
          "wrong.xml:5]; nearest of: offset",
          "'offset': ", "/conter: the system has no such simplex [", "nearest of: /counter",
          "the values are of the type Counter, the simplex is a DigitalIoConcept ["}) {
        EXPECT_TRUE(contains(output, told)) << told << " in\n" << output;
    }
    EXPECT_FALSE(std::filesystem::exists(retained()));
}

}  // namespace
}  // namespace cortex::test
