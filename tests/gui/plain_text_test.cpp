// SPDX-License-Identifier: Apache-2.0
// Texts of agents are shown as they are: no markup in them is rendered.
#include "gui/window_fixture.hpp"
#include "views/command_card.hpp"
#include "widgets/text_label.hpp"

#include <QMessageBox>
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
    auto* question = card.findChild<QMessageBox*>();
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

TEST(PlainText, AnyLabelOfTheProgramRendersNoMarkup) {
    QLabel label{hostile};
    label.ensurePolished();
    EXPECT_FALSE(renders(label));
}

}  // namespace
}  // namespace cortex::test
