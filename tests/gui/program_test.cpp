// SPDX-License-Identifier: Apache-2.0
// The program `cortex-explorer` as it is started, without a display.
#include "gui/window_fixture.hpp"

#include <QFile>
#include <QImage>
#include <QJsonDocument>
#include <QJsonObject>
#include <cstdlib>
#include <string>

namespace cortex::test {
namespace {

Outcome explorerWith(std::vector<std::string> arguments) {
    // A path may stand behind an interface.
    arguments.insert(arguments.begin(), {"--domain", domain, "--interface", "127.0.0.1"});
    // Qt's offscreen platform leaves parts of its screen behind when it ends.
    const char* const given = std::getenv("ASAN_OPTIONS");
    return runProgram(CORTEX_BINARY_DIR "/bin/cortex-explorer", arguments,
                      {{"ASAN_OPTIONS", std::string{given ? given : ""} +
                                            ":detect_leaks=0:new_delete_type_mismatch=0"}});
}

class Program : public CortexLive {
protected:
    std::string file() const { return (folder.path() / "picture.png").string(); }
};

TEST_F(Program, MakesAPictureOfEveryViewInTheSizeThatWasAskedFor) {
    for (const std::string view : {"simplex", "system", "agents"}) {
        const Outcome made = explorerWith({"/drive", "--view", view, "--size", "900x700", "--theme",
                                           "dark", "--screenshot", file()});
        EXPECT_EQ(made.exit, 0) << made.errors;
        EXPECT_EQ(QImage(QString::fromStdString(file())).size(), QSize(900, 700));
    }
}

TEST_F(Program, MakesAPictureOfAPlotAndMeasuresIt) {
    const Outcome made = explorerWith({"--screenshot", file(), "--timeout", patient, "--plot",
                                       "/drive.position", "/drive.state"});
    EXPECT_EQ(made.exit, 0) << made.errors;
    EXPECT_FALSE(QImage(QString::fromStdString(file())).isNull());
    const Outcome measured =
        explorerWith({"--measure", "1", file(), "--plot", "/drive.position", "/drive.state"});
    EXPECT_EQ(measured.exit, 0) << measured.errors;
    QFile result{QString::fromStdString(file())};
    ASSERT_TRUE(result.open(QIODevice::ReadOnly));
    const QJsonObject found = QJsonDocument::fromJson(result.readAll()).object();
    EXPECT_GT(found["frames"].toInt(), 0);
    EXPECT_GT(found["memory_mb"].toObject()["end"].toDouble(), 1);
    EXPECT_EQ(found["shown"].toObject()["lines"].toInt(), 2);
    EXPECT_EQ(explorerWith({"--plot", "drive"}).exit, 2);
}

TEST_F(Program, SaysThatAPictureCannotBeWritten) {
    const Outcome made = explorerWith({"--screenshot", "/no/such/folder/picture.png"});
    EXPECT_EQ(made.exit, 1);
    EXPECT_TRUE(contains(made.errors, "is its folder there")) << made.errors;
}

TEST_F(Program, SaysThatASimplexIsUnknownInTheWordsOfCortex) {
    const Outcome made = explorerWith({"/drvie", "--screenshot", file()});
    EXPECT_EQ(made.exit, 3);
    EXPECT_TRUE(contains(made.errors, "no agent has a simplex /drvie")) << made.errors;
    EXPECT_TRUE(contains(made.errors, "/drive")) << "the nearest: " << made.errors;
}

TEST(ProgramAlone, SaysThatADomainIsEmptyInTheWordsOfCortex) {
    const ModelFolder folder;
    const Outcome made = explorerWith(
        {"--timeout", "0.2", "--screenshot", (folder.path() / "picture.png").string()});
    EXPECT_EQ(made.exit, 3);
    EXPECT_TRUE(contains(made.errors, "no agent on domain " + domain)) << made.errors;
}

TEST(ProgramAlone, RefusesANameThatNobodyMayTellBeforeAWindowOpens) {
    for (const std::string& name : {std::string(64, 'x'), std::string{"two\nlines"}}) {
        const Outcome named =
            explorerWith({"--name", name, "--screenshot", "/no/such/folder/x.png"});
        EXPECT_EQ(named.exit, 2) << named.errors;
        EXPECT_TRUE(contains(named.errors, "give another one (--name NAME)")) << named.errors;
    }
}

TEST(ProgramAlone, RefusesOptionsThatItDoesNotKnowWithTheValidOnes) {
    const Outcome theme = explorerWith({"--theme", "pink"});
    EXPECT_EQ(theme.exit, 2);
    EXPECT_TRUE(contains(theme.errors, "high-contrast")) << theme.errors;
    const Outcome size = explorerWith({"--size", "10x10"});
    EXPECT_EQ(size.exit, 2);
    EXPECT_TRUE(contains(size.errors, "from 800x600")) << size.errors;
}

}  // namespace
}  // namespace cortex::test
