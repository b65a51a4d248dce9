// SPDX-License-Identifier: Apache-2.0
// cortex-agent --memory: the file of what an agent remembers.
#include "memory_file.hpp"

#include "cortex/core/error.hpp"

#include "core/model_folder.hpp"
#include "memory_text.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

namespace fs = std::filesystem;
using cortex::test::contains;
using cortex::test::ModelFolder;
using cortex::test::textOf;

constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min();

KeptEvent fault(std::int64_t time, const std::string& text = "no air", std::int64_t epoch = 1) {
    return {0,
            epoch,
            static_cast<std::uint64_t>(time),
            time / 2,
            time,
            Severity::Error,
            EventKind::Fault,
            "/drive",
            text};
}

std::vector<KeptEvent> withoutPlaces(std::vector<KeptEvent> events) {
    for (KeptEvent& each : events) each.place = 0;
    return events;
}

std::vector<KeptEvent> eventsOf(const EventMemory& memory) {
    return withoutPlaces(memory.page(0, lowest).events);
}

class MemoryTextTest : public testing::Test {
protected:
    MemoryRead readText(const std::string& text) {
        events.clear();
        const OpenFile file{folder.write("memory", text), O_RDONLY};
        return readMemory(file, 777, [this](KeptEvent each) { events.push_back(std::move(each)); });
    }
    std::int64_t upTo(std::int64_t most) {
        return std::uniform_int_distribution<std::int64_t>{0, most}(random);
    }
    std::string octets(std::int64_t most) {
        std::string text(static_cast<std::size_t>(upTo(most)), ' ');
        for (char& each : text) each = static_cast<char>(upTo(255));
        return text;
    }

    ModelFolder folder;
    std::mt19937_64 random{20261129};
    std::vector<KeptEvent> events;
    const std::string header = memoryHeader("plant");
};

TEST_F(MemoryTextTest, GivesEveryEntryBackAsItWas) {
    constexpr std::int64_t highest = std::numeric_limits<std::int64_t>::max();
    std::vector<KeptEvent> written{
        {0, highest, std::numeric_limits<std::uint64_t>::max(), lowest, highest, Severity::Info,
         EventKind::Control, "", ""},
        fault(lowest + 2, "tab\t, end\n, \\x09 \\ \r \x7f <b>\xe2\x80\xae\xff\xc2\x9b"),
        fault(3, std::string("\0 zero \0", 8)),
        fault(4, std::string(200'000, '\n'))};
    for (int i = 0; i < 400; ++i) {
        KeptEvent each = fault(static_cast<std::int64_t>(random()), octets(i % 40 ? 300 : 50'000));
        each.epoch = static_cast<std::int64_t>(random());
        each.severity = static_cast<Severity>(upTo(2));
        each.kind = static_cast<EventKind>(upTo(static_cast<std::int64_t>(EventKind::ValueChange)));
        each.path = octets(100);
        written.push_back(std::move(each));
    }
    std::string text = header;
    for (const KeptEvent& each : written) text += lineOf(each);

    const MemoryRead read = readText(text);

    EXPECT_EQ(events, written);
    EXPECT_EQ(read.unreadable, 0U);
    EXPECT_FALSE(read.torn);
    EXPECT_EQ(read.bytes, text.size());
    EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(text, '\n')), written.size() + 1);
    EXPECT_TRUE(std::ranges::none_of(text, [](char c) {
        return (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n') || c == 0x7f;
    }));
}

TEST_F(MemoryTextTest, SaysOfEachKindTheLatestTimeOfTheFile) {
    const MemoryRead read =
        readText(header + sinceLine(EventKind::Fault, 5) + lineOf(fault(9)) +
                 sinceLine(EventKind::Loss, -3) + sinceLine(EventKind::Fault, 7) +
                 sinceLine(EventKind::Fault, 6));

    EXPECT_EQ(read.since,
              (EventMemory::Times{7, lowest, lowest, lowest, lowest, -3, lowest, lowest}));
    EXPECT_EQ(events, std::vector{fault(9)});
}

TEST_F(MemoryTextTest, LosesNothingButTheLineInWhichItWasCut) {
    const std::string first = lineOf(fault(1)), second = lineOf(fault(2, "a\\b"));
    const std::string whole = header + first + second;
    for (std::size_t size = 0; size <= whole.size(); ++size) {
        const MemoryRead read = readText(whole.substr(0, size));
        const std::size_t count =
            (size >= header.size() + first.size() ? 1U : 0U) + (size == whole.size() ? 1U : 0U);
        ASSERT_EQ(events.size(), count) << size;
        ASSERT_EQ(read.unreadable, 0U) << size;
        ASSERT_EQ(read.torn, size != 0 && whole[size - 1] != '\n') << size;
        ASSERT_EQ(read.since[0], lowest) << "a crash loses what was just written, and no more";
    }
}

TEST_F(MemoryTextTest, LeavesOutLinesThatCannotBeRead) {
    for (const std::string& wrong :
         {std::string{""}, std::string{"1"}, std::string(2'000'000, 'x'), std::string(100, '\0'),
          std::string{"1\t2\t3\t4\terror\tfault\t/a"},
          std::string{"1\t2\t3\t4\terror\tfault\t/a\ttext\tmore"},
          std::string{"1\t-2\t3\t4\terror\tfault\t/a\ttext"},
          std::string{"1\t2\t3\t99999999999999999999\terror\tfault\t/a\ttext"},
          std::string{"1\t2\t3\t4 \terror\tfault\t/a\ttext"},
          std::string{"1\t2\t3\t4\tworse\tfault\t/a\ttext"},
          std::string{"1\t2\t3\t4\terror\tfaults\t/a\ttext"},
          std::string{"1\t2\t3\t4\terror\tfault\t/a\ttext\\"},
          std::string{"1\t2\t3\t4\terror\tfault\t/a\\x0\ttext"}, std::string{"since\tfault\tnow"},
          std::string{"since\tfaults\t3"}, std::string{"since\tlimit\t3"},
          memoryHeader("plant").substr(0, 10)}) {
        const MemoryRead read =
            readText(header + lineOf(fault(10)) + wrong + "\n" + lineOf(fault(8)));
        EXPECT_EQ(events, (std::vector{fault(10), fault(8)})) << wrong.substr(0, 50);
        EXPECT_EQ(read.unreadable, 1U) << wrong.substr(0, 50);
        for (const std::int64_t each : read.since) {
            EXPECT_EQ(each, 11) << "of any kind, between the two";
        }
        EXPECT_EQ(readText(header + wrong + "\n").since[0], 777) << "before this start";
    }
}

TEST_F(MemoryTextTest, TakesAnyMutatedFile) {
    std::string text = header + sinceLine(EventKind::Fault, 5);
    for (std::int64_t i = 1; i < 20; ++i) text += lineOf(fault(i, octets(50)));
    for (int round = 0; round < 500; ++round) {
        std::string mutated = text;
        for (std::int64_t i = upTo(5); i >= 0; --i) {
            const auto at =
                static_cast<std::size_t>(upTo(static_cast<std::int64_t>(text.size()) - 1));
            if (upTo(3) == 0)
                mutated.erase(std::min(at, mutated.size()), 10);
            else if (at < mutated.size())
                mutated[at] = static_cast<char>(upTo(255));
        }
        const MemoryRead read = readText(mutated);
        EXPECT_EQ(read.bytes, mutated.size());
        EXPECT_GE(events.size(), 1U);
    }
}

class MemoryFileTest : public testing::Test {
protected:
    // A start of the agent, to its end.
    struct Start {
        explicit Start(const fs::path& path, std::size_t entries = 1000, std::int64_t begin = 500)
            : memory{std::make_shared<EventMemory>(entries, begin)}, file{path, "plant", memory} {}
        std::shared_ptr<EventMemory> memory;
        MemoryFile file;
    };
    void runOnce(const std::vector<KeptEvent>& events, std::size_t entries = 1000) {
        Start start{path, entries};
        start.file.load();
        start.file.keep();
        for (const KeptEvent& each : events) start.memory->keep(each);
        start.file.finish();
    }
    std::string whyNot(const fs::path& file) {
        try {
            Start{file}.file.load();
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }

    ModelFolder folder;
    const fs::path path = folder.path() / "plant.memory";
};

TEST_F(MemoryFileTest, SaysWhatMayBeMissingAfterAnEndWithoutAWord) {
    runOnce({fault(510)});
    const std::string text = textOf(path), end = endLine();
    ASSERT_TRUE(text.ends_with('\n' + end));
    folder.write("plant.memory", text.substr(0, text.size() - end.size()));

    Start start{path};
    start.file.load();

    const auto events = eventsOf(*start.memory);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[1].kind, EventKind::Loss);
    EXPECT_EQ(events[1].epoch, 1);
    EXPECT_TRUE(contains(events[1].text, "may be missing"));
}

TEST_F(MemoryFileTest, KeepsWhatHappenedOverRestarts) {
    runOnce({fault(510), fault(520, "tab\t\xff")});
    runOnce({fault(530, "third", 2)});

    Start start{path, 1000, 5000};
    const std::string told = start.file.load();

    EXPECT_EQ(eventsOf(*start.memory),
              (std::vector{fault(510), fault(520, "tab\t\xff"), fault(530, "third", 2)}));
    for (const std::int64_t each : start.memory->since()) EXPECT_EQ(each, 500);
    EXPECT_EQ(told, path.string() +
                        ": all that happened since 1970-01-01T00:00:00Z is "
                        "remembered\n");
    EXPECT_FALSE(fs::exists(path.string() + ".new"));
}

TEST_F(MemoryFileTest, WritesNothingBeforeItIsToKeep) {
    EXPECT_EQ(Start{path}.file.load(),
              path.string() + ": keeps what happens from now on over restarts\n");
    EXPECT_FALSE(fs::exists(path));
}

TEST_F(MemoryFileTest, SaysWhatWasDroppedBeforeTheRestart) {
    std::vector<KeptEvent> flood;
    for (std::int64_t i = 1; i <= 40; ++i) flood.push_back(fault(1000 + i));
    runOnce(flood, 100);

    Start larger{path, 1000};
    larger.file.load();

    EXPECT_EQ(larger.memory->since()[0], 1031);
    EXPECT_EQ(larger.memory->since()[1], 500);
}

TEST_F(MemoryFileTest, StaysWithinTwiceTheMemoryHoweverOftenItStarts) {
    std::vector<KeptEvent> flood;
    for (std::int64_t i = 1; i <= 3000; ++i) flood.push_back(fault(i, std::string(100, 't')));
    for (int round = 0; round < 6; ++round) {
        runOnce(flood, 1000);
        const std::size_t most = 2 * 100 * EventMemory::bytesOfEntry + 65'536;
        EXPECT_LE(fs::file_size(path), most) << round;
    }
    const std::string hostile(150, '\n');  // four octets each in the file
    for (int round = 0; round < 6; ++round) {
        runOnce(std::vector<KeptEvent>(500, fault(round, hostile)), 1000);
        EXPECT_LE(fs::file_size(path), 2 * 100 * (4 * 150 + 100) + 65'536) << round;
    }
}

TEST_F(MemoryFileTest, IsWrittenAnewWithoutLinesThatCannotBeReadWhichIsTold) {
    const std::string good = memoryHeader("plant") + lineOf(fault(510));
    folder.write("plant.memory", good + "x\ny\n" + lineOf(fault(520)) + "1\t2\t3");
    testing::internal::CaptureStderr();
    runOnce({});
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              path.string() + ": 2 lines that cannot be read are left out\n");

    EXPECT_TRUE(contains(textOf(path), lineOf(fault(510)))) << textOf(path);
    EXPECT_TRUE(contains(textOf(path), lineOf(fault(520)))) << textOf(path);
    EXPECT_FALSE(contains(textOf(path), "x\ny\n"));
    testing::internal::CaptureStderr();
    Start start{path};
    start.file.load();
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "once";
    EXPECT_EQ(start.memory->since()[3], 521) << "a refusal before may be lost";
}

TEST_F(MemoryFileTest, IsLeftToAnotherStartUntilThatHasEnded) {
    runOnce({fault(510)});
    Start second{path};
    {
        Start first{path};
        first.file.load();
        EXPECT_EQ(second.file.load(), "");
        EXPECT_TRUE(eventsOf(*second.memory).empty());
        const std::string before = textOf(path);
        second.memory->keep(fault(700, "second", 2));
        second.file.keep();
        second.file.finish();
        EXPECT_EQ(textOf(path), before + lineOf(fault(700, "second", 2)) + endLine());
        first.file.keep();
        first.memory->keep(fault(600));
        first.file.finish();
        EXPECT_EQ(eventsOf(*first.memory),
                  (std::vector{fault(510), fault(600), fault(700, "second", 2)}));
    }

    second.file.keep();
    second.file.finish();

    EXPECT_EQ(eventsOf(*second.memory),
              (std::vector{fault(700, "second", 2), fault(510), fault(600)}));
    second.file.giveWay(true);
    second.file.keep();
    second.file.finish();
    Start third{path};
    third.file.load();
    EXPECT_EQ(eventsOf(*third.memory), eventsOf(*second.memory));
}

TEST_F(MemoryFileTest, OfAnotherStartIsToldOnceWhereThatDoesNotEndSoon) {
    runOnce({});
    Start first{path}, second{path};
    first.file.load();
    testing::internal::CaptureStderr();
    second.file.keep();
    second.file.finish();
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "it may be about to end";

    testing::internal::CaptureStderr();
    for (int round = 0; round < 4; ++round) {
        second.file.keep();
        second.file.finish();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "what the agent remembers is not written: " + path.string() +
                  " is another agent's that runs: end that one, or name another file with "
                  "--memory\n");
}

TEST_F(MemoryFileTest, IsGivenToAnotherStartAndComesBackWithWhatThatWrote) {
    Start first{path}, other{path};
    const auto write = [](Start& start) {
        start.file.keep();
        start.file.finish();
    };
    first.memory->keep(fault(510));
    write(first);
    EXPECT_EQ(other.file.load(), "") << "the new file that took the place of the empty one";
    first.memory->keep(fault(511));
    first.file.giveWay(true);
    write(first);
    first.memory->keep(fault(515));
    write(first);

    other.file.load();
    EXPECT_EQ(eventsOf(*other.memory), (std::vector{fault(510), fault(511), fault(515)}));
    other.memory->keep(fault(520, "other", 2));
    write(other);
    other.file.giveWay(true);
    write(other);
    first.file.giveWay(false);
    write(first);

    EXPECT_EQ(eventsOf(*first.memory),
              (std::vector{fault(510), fault(511), fault(515), fault(520, "other", 2)}));
    first.file.giveWay(true);
    write(first);
    Start third{path};
    third.file.load();
    EXPECT_EQ(eventsOf(*third.memory), eventsOf(*first.memory));
}

TEST_F(MemoryFileTest, IsWholeAgainWhereSomebodyDeletedCutOrChangedIt) {
    const std::vector<std::string> others{"", memoryHeader("plant"), memoryHeader("plant") + "x\n"};
    for (std::size_t i = 0; i <= others.size(); ++i) {
        fs::remove(path);
        runOnce({fault(510)});
        Start start{path};
        start.file.load();
        if (i == others.size())
            fs::remove(path);
        else
            folder.write("plant.memory", others[i]);
        start.memory->keep(fault(600));
        start.file.keep();
        start.file.finish();

        EXPECT_TRUE(contains(textOf(path), lineOf(fault(510)) + lineOf(fault(600)))) << i;
        EXPECT_EQ(eventsOf(*start.memory), (std::vector{fault(510), fault(600)})) << i;
    }
}

TEST_F(MemoryFileTest, TakesThePlaceOfNothingElse) {
    const fs::path kept = folder.write("kept.xml", "<system name='plant'/>\n");
    const fs::path other = folder.write("other", memoryHeader("mixer") + lineOf(fault(1)));
    const fs::path later = folder.write("later", "cortex-agent memory\t2\tplant\n");
    const fs::path link = folder.path() / "link", pipe = folder.path() / "pipe";
    fs::create_symlink(other, link);
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    for (const auto& [file, told] : std::vector<std::pair<fs::path, std::string>>{
             {kept, "is no file of what an agent remembers, and would be written over: name"},
             {other, "is what the agent mixer remembers, and would be written over: name"},
             {later, "is of another version of cortex-agent, and would be written over: name"},
             {link, "is a symbolic link"},
             {pipe, "is no regular file"},
             {folder.path(), "is a folder"}}) {
        const std::string why = whyNot(file);
        EXPECT_TRUE(contains(why, "--memory: " + file.string() + " " + told)) << why;
    }

    for (const fs::path& file : {kept, other, later, link, pipe}) {
        const std::string before = file == pipe ? "" : textOf(file);
        testing::internal::CaptureStderr();
        Start start{file};
        start.file.keep();
        start.memory->keep(fault(1));
        start.file.finish();
        EXPECT_TRUE(contains(testing::internal::GetCapturedStderr(),
                             "what the agent remembers is not written: "));
        EXPECT_EQ(file == pipe ? "" : textOf(file), before);
    }
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_TRUE(fs::is_fifo(pipe));
}

}  // namespace
}  // namespace cortex::toolkit::test
