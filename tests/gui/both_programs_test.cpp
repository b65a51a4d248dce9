// SPDX-License-Identifier: Apache-2.0
// One table of questions that goes through the command line and the window: they answer alike.
#include "gui/window_fixture.hpp"
#include "model/why_text.hpp"

#include <QRegularExpression>
#include <map>
#include <regex>
#include <set>

namespace cortex::test {
namespace {

class BothPrograms : public Window {
protected:
    // The values of its data, by the names of the items, as `cortex show` prints them.
    static std::map<std::string, std::string> shownBy(const Outcome& outcome) {
        std::map<std::string, std::string> values;
        bool inData = false;
        for (const std::string& line : linesOf(outcome.output)) {
            if (!line.starts_with("  ")) inData = line == "data";
            static const std::regex row{R"(^  (\S+)  +(\S.*?)(?:  .*)?$)"};
            std::smatch found;
            if (inData && std::regex_match(line, found, row)) values[found[1]] = found[2];
        }
        return values;
    }
    // As the window shows it, in the letters of the command line, and without the number of a
    // label.
    static std::string plain(QString text) {
        static const QString raised = QStringLiteral("⁰¹²³⁴⁵⁶⁷⁸⁹");
        text.replace(QStringLiteral("×10"), QStringLiteral("e")).replace(QChar{0x207B}, '-');
        for (QChar& each : text) {
            if (raised.contains(each)) each = QChar{'0' + raised.indexOf(each)};
        }
        text.replace(QChar{0x2212}, '-')
            .remove(QRegularExpression{QStringLiteral(R"( \(-?\d+\))")});
        return text.toStdString();
    }
    std::string whyOf(const std::string& path) {
        const auto frame = session.frame();
        return whyText(*frame, *frame->find(path)).toStdString();
    }
};

const std::set<std::string> everChanging{"taskTime", "taskTimeMax", "currentTime", "cycle"};

TEST_F(BothPrograms, ShowTheSameValuesInTheSameBracketsForTheSameReasons) {
    ASSERT_TRUE(everythingComes());
    int compared = 0;
    for (const char* path : {"/axis/demanded", "/controller", "/drive"}) {
        window.open(path);
        window.openPart("data");
        ASSERT_TRUE(comes([&] { return valueOf("position") != "…" || valueOf("state") != "…"; }));
        const Outcome first = live({"show", path}), again = live({"show", path});
        ASSERT_EQ(first.exit, 0) << first.errors;
        const auto values = shownBy(again);
        for (const auto& [item, value] : shownBy(first)) {
            const QString shown = valueOf(QString::fromStdString(item));
            const auto second = values.find(item);
            const bool steady = second != values.end() && second->second == value;
            const bool array = shown.endsWith(QStringLiteral("values"));
            if (!steady || shown.isEmpty() || array || everChanging.contains(item)) continue;
            EXPECT_TRUE(comes([&] {
                return plain(valueOf(QString::fromStdString(item))) == value;
            })) << path
                << '.' << item << ": the window shows " << shown.toStdString()
                << ", the command line " << value;
            ++compared;
        }
        const std::size_t safe = first.output.find("its safe value: ");
        if (safe == std::string::npos) continue;
        const std::string why =
            first.output.substr(safe + 16, first.output.find('\n', safe) - safe - 16);
        EXPECT_NE(whyOf(path).find("Safe values, as " + why + '.'), std::string::npos)
            << whyOf(path) << ", and the command line says: " << why;
        EXPECT_EQ(values.at("position").front() == '[', false) << "a safe demand is live";
    }
    EXPECT_GT(compared, 15);
}

}  // namespace
}  // namespace cortex::test
