// SPDX-License-Identifier: Apache-2.0
// Texts of agents are shown as they are: no markup in them is rendered.
#include "gui/window_fixture.hpp"
#include "views/command_card.hpp"
#include "widgets/question.hpp"
#include "widgets/rows.hpp"
#include "widgets/text_label.hpp"

#include <QTextDocument>
#include <QToolTip>

namespace cortex::test {
namespace {

const QString hostile = QStringLiteral(
    "<h1>SAFE: all axes at rest</h1> a & b -> c <a href=\"file:///\">go on</a> <img src=\"x\"> and "
    "more, so that it is longer than a line");

bool renders(const QLabel& label) {
    return label.textFormat() == Qt::RichText ||
           (label.textFormat() == Qt::AutoText && Qt::mightBeRichText(label.text()));
}

// The text of a label whose lines were broken to fit.
QString textOf(const QLabel& label) { return label.text().replace('\n', ' '); }

const QLabel* toolTip() {
    for (const QWidget* each : QApplication::topLevelWidgets()) {
        if (each->inherits("QTipLabel")) return qobject_cast<const QLabel*>(each);
    }
    return nullptr;
}

TEST(PlainText, TheQuestionBeforeACommandRendersNoMarkup) {
    Session session{ownNetwork()};
    Commands commands{session};
    Command command;
    command.name = "zero";
    command.description = hostile.toStdString();
    command.confirm = true;
    CommandCard card{commands, "/drive", command};
    card.show();
    card.run();
    auto* question = card.findChild<Question*>();
    ASSERT_NE(question, nullptr);
    bool shown = false;
    for (const auto* label : question->findChildren<QLabel*>()) {
        EXPECT_FALSE(renders(*label)) << label->text().toStdString();
        shown = shown || textOf(*label).contains(hostile);
    }
    EXPECT_TRUE(shown);
}

TEST(PlainText, ATextThatDoesNotFitIsWholeInATooltipThatRendersNoMarkup) {
    TextLabel label;
    label.show(hostile);
    label.resize(40, 20);
    label.grab();
    QToolTip::showText({}, label.toolTip(), &label);
    const QLabel* tip = toolTip();
    ASSERT_NE(tip, nullptr);
    EXPECT_FALSE(renders(*tip)) << tip->text().toStdString();
    EXPECT_EQ(textOf(*tip), hostile);
    EXPECT_TRUE(tip->text().contains('\n')) << "long lines are broken";
}

TEST(PlainText, ACellThatIsCutIsAsItIsInItsTooltip) {
    QTreeWidget tree;
    auto* row = new QTreeWidgetItem{&tree, {QString{}}};
    setCell(*row, 0, QStringLiteral("a < b & c"));
    EXPECT_EQ(row->toolTip(0), "a < b & c");
}

TEST(PlainText, AnyLabelOfTheProgramRendersNoMarkup) {
    QLabel label{hostile};
    label.ensurePolished();
    EXPECT_FALSE(renders(label));
}

// A simplex whose type says hostile things, in a system of its own.
class HostileTexts : public Window {
protected:
    HostileTexts() {
        const std::string text = hostile.toHtmlEscaped().toStdString();
        folder.write("hostile.xml",
                     "<ontology name=\"hostile\" version=\"1.0\"><include file=\"base.xml\"/>"
                     "<type name=\"Note\" extends=\"Concept\" description=\"" +
                         text +
                         "\"><data name=\"level\" kind=\"int\" labels=\"0:Low 1:High\" safe=\"0\" "
                         "settable=\"always\" description=\"" +
                         text + "\"/></type></ontology>");
        std::string system = folder.read("mixer.xml");
        const std::string end = "</system>";
        system.replace(system.find(end), end.size(),
                       "<simplex path=\"/note\" type=\"Note\"/>" + end);
        const std::string types = "<morphology file=\"cortex-morphology.xml\"/>";
        system.replace(system.find(types), types.size(),
                       types + "<ontology file=\"hostile.xml\"/>");
        agent.reset();
        folder.write("mixer.xml", system);
        start();
    }
};

TEST_F(HostileTexts, AreShownInAllPartsOfTheWindowAsTheyAre) {
    ASSERT_TRUE(comes([this] { return session.frame()->find("/note").has_value(); }));
    window.open("/note");
    const auto shown = [this] {
        window.refresh();
        const auto labels = window.findChildren<QLabel*>();
        return std::ranges::any_of(
            labels, [](const auto* each) { return textOf(*each).contains(hostile); });
    };
    EXPECT_TRUE(comes(shown));
    for (const char* part : {"data", "relationships", "commands", "type"}) {
        window.openPart(part);
        window.refresh();
        window.grab();
        for (const auto* label : window.findChildren<QLabel*>()) {
            EXPECT_FALSE(renders(*label)) << label->text().toStdString();
        }
    }
    const auto& rows = *window.current()->findChild<ItemTable*>()->model();
    const QModelIndex level = rows.index(0, 0, rows.index(0, 0));
    ASSERT_EQ(level.data(), "level");
    EXPECT_TRUE(level.data(Qt::ToolTipRole).toString().replace('\n', ' ').contains(hostile));
}

}  // namespace
}  // namespace cortex::test
