// SPDX-License-Identifier: Apache-2.0
// The field of an item in the table of data: what is typed stays, whatever comes meanwhile.
#include "gui/item_field.hpp"

#include "widgets/choice_list.hpp"
#include "widgets/entry_hint.hpp"

#include <QApplication>
#include <QKeyEvent>
#include <QLineEdit>
#include <QWheelEvent>
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {
namespace {

TEST_F(ItemField, KeepsItsTextAndSelectionWhateverComes) {
    ASSERT_TRUE(opens());
    ASSERT_EQ(field()->selectedText(), "1");
    agent->degrade("/worker", Quality::Stale);
    shows({agent->now()});
    agent->degrade("/worker", Quality::Good);
    comes(3);
    shows({agent->now("lost")});
    shows({agent->now()});
    ASSERT_NE(field(), nullptr);
    EXPECT_EQ(field()->selectedText(), "1");
    QTest::keyClicks(field(), "5");
    comes(4);
    EXPECT_EQ(field()->text(), "5");
    press(Qt::Key_Return);
    EXPECT_EQ(entered(), one(5));
}

TEST_F(ItemField, OverAPendingEntryKeepsWhatIsTypedWhereTheAgentIsLost) {
    ASSERT_TRUE(opens());
    field()->setText("0.95");
    press(Qt::Key_Tab);
    ASSERT_EQ(entered(), one(0.95));
    if (field() != nullptr) press(Qt::Key_Escape);
    ASSERT_TRUE(opens());
    field()->selectAll();
    QTest::keyClicks(field(), "0.96");
    shows({agent->now("lost")});
    EXPECT_EQ(field()->text(), "0.96");
    press(Qt::Key_Return);
    EXPECT_EQ(entered(), one(0.96));
}

TEST_F(ItemField, LeftAsItWasEntersNothingThoughSomebodyElseHasSetTheItem) {
    ASSERT_TRUE(opens());
    comes(3);
    press(Qt::Key_Return);
    EXPECT_FALSE(entered());
    ASSERT_TRUE(opens());
    EXPECT_EQ(field()->text(), "3");
    press(Qt::Key_Escape);
}

TEST_F(ItemField, ShowsASignForWhatTurnsTextsAndKeepsIt) {
    const std::string turned = "\u202e\u200eb";
    const auto opensTitle = [&] { return opens(cellOf("title")); };
    agent->put("/worker", "title", turned);
    shows({agent->now()});
    ASSERT_TRUE(opensTitle());
    EXPECT_EQ(field()->text(), "\uFFFD\uFFFDb");
    press(Qt::Key_Return);
    EXPECT_FALSE(entered("title")) << "it was left as it was";
    ASSERT_TRUE(opensTitle());
    QTest::keyClick(field(), Qt::Key_Home);
    QTest::keyClicks(field(), "c");
    press(Qt::Key_Return);
    EXPECT_EQ(entered("title"), (Value{std::vector<std::string>{"c" + turned}}));
}

TEST_F(ItemField, StaysOpenWithItsTextWhereTheAgentStartsAnew) {
    ASSERT_TRUE(opens());
    QTest::keyClicks(field(), "57");
    QTest::keyClick(field(), Qt::Key_Left);
    starts();
    shows({agent->now()});
    ASSERT_NE(field(), nullptr);
    EXPECT_EQ(field()->text(), "57");
    QTest::keyClicks(field(), ".");
    press(Qt::Key_Return);
    EXPECT_EQ(entered(), one(5.7));
}

TEST_F(ItemField, ComesBackWithItsTextOnceItsSimplexDoes) {
    ASSERT_TRUE(opens());
    QTest::keyClicks(field(), "7");
    shows({});
    EXPECT_EQ(field(), nullptr);
    starts();
    shows({agent->now()});
    ASSERT_NE(field(), nullptr);
    EXPECT_EQ(field()->text(), "7");
    press(Qt::Key_Escape);
    shows({});
    shows({agent->now()});
    EXPECT_EQ(field(), nullptr) << "it was given up";
}

TEST_F(ItemField, OfAnElementStaysOpenWhereTheAgentStartsAnew) {
    const QModelIndex whole = cellOf("weights").siblingAtColumn(0);
    table.expand(whole);
    ASSERT_TRUE(opens(items.index(1, ItemModel::Value, whole)));
    QTest::keyClicks(field(), "0.5");
    starts();
    shows({agent->now()});
    ASSERT_NE(field(), nullptr);
    EXPECT_EQ(field()->text(), "0.5");
    press(Qt::Key_Return);
    EXPECT_EQ(entered("weights"), (Value{std::vector<double>{0, 0.5, 0}}));
}

TEST_F(ItemField, WhatIsEnteredIsThereWhenItsSimplexIsShownAgain) {
    ASSERT_TRUE(opens());
    QTest::keyClicks(field(), "7");
    press(Qt::Key_Tab);
    if (field() != nullptr) press(Qt::Key_Escape);
    ASSERT_EQ(entered(), one(7));
    items.show("/other");
    EXPECT_FALSE(entered()) << "that is another simplex";
    EXPECT_EQ(items.kept().size(), 1U);
    items.show("/worker");
    shows({agent->now()});
    EXPECT_EQ(entered(), one(7));
    EXPECT_EQ(cellOf("gain").data(), "7");
    items.show("/other");
    items.clearEdits("/worker", {{"gain", one(7)}}, ItemEdits::count());  // it was sent meanwhile
    items.show("/worker");
    EXPECT_FALSE(entered());
    EXPECT_EQ(items.kept().size(), 0U);
}

// Where labels are chosen.
class LabelField : public ItemField {
protected:
    LabelField() {
        table.resize(900, 700);
        table.activateWindow();
        QApplication::processEvents();
    }
    // The list that is open; null: none.
    ChoiceList* list() {
        const auto lists = table.findChildren<ChoiceList*>();
        const auto found =
            std::ranges::find_if(lists, [](const auto* each) { return each->isVisible(); });
        return found == lists.end() ? nullptr : *found;
    }
    bool opens(const QString& item) { return ItemField::opens(cellOf(item)) && list() != nullptr; }
    QStringList rows() {
        QStringList texts;
        for (int i = 0; i < list()->count(); ++i) texts << list()->item(i)->text();
        return texts;
    }
    static Value number(std::int64_t value) { return std::vector<std::int64_t>{value}; }
};

TEST_F(LabelField, ListsAllLabelsAndThePresentOneIsChosen) {
    agent->put("/worker", "mode", std::int64_t{2});
    shows({agent->now()});
    ASSERT_TRUE(opens("mode"));
    EXPECT_EQ(rows(), (QStringList{"Idle (0)", "Jog (1)", "Hold (2)"}));
    EXPECT_EQ(list()->currentRow(), 2);
    press(Qt::Key_Escape);
    EXPECT_EQ(list(), nullptr);
    EXPECT_FALSE(entered("mode"));
    ASSERT_TRUE(opens("on"));
    EXPECT_EQ(rows(), (QStringList{"false", "true"}));
    EXPECT_EQ(list()->currentRow(), 0);
    press(Qt::Key_Escape);
    ASSERT_TRUE(ItemField::opens(cellOf("gain")));
    EXPECT_EQ(list(), nullptr) << "it has no labels";
}

TEST_F(LabelField, IsChosenFromByArrowsAndEnter) {
    ASSERT_TRUE(opens("mode"));
    press(Qt::Key_Down);
    press(Qt::Key_Down);
    press(Qt::Key_Down);
    press(Qt::Key_Up);
    EXPECT_EQ(list()->currentRow(), 1);
    press(Qt::Key_Return);
    EXPECT_EQ(entered("mode"), number(1));
    EXPECT_EQ(list(), nullptr);
    EXPECT_EQ(field(), nullptr);
}

TEST_F(LabelField, IsChosenFromByItsFirstLetters) {
    ASSERT_TRUE(opens("mode"));
    QTest::keyClicks(field(), "ho");
    ASSERT_NE(list(), nullptr);
    EXPECT_EQ(list()->currentRow(), 2);
    press(Qt::Key_Tab);
    if (field() != nullptr) press(Qt::Key_Escape);
    EXPECT_EQ(entered("mode"), number(2));
    ASSERT_TRUE(opens("on"));
    QTest::keyClicks(field(), "T");
    press(Qt::Key_Return);
    EXPECT_EQ(entered("on"), Value{std::vector<bool>{true}});
}

TEST_F(LabelField, SaysTheLabelsWhereNoneBeginsLikeThat) {
    ASSERT_TRUE(opens("mode"));
    QTest::keyClicks(field(), "o");  // as two of them have it
    EXPECT_EQ(list(), nullptr);
    EXPECT_EQ(table.findChild<EntryHint*>()->text(), "'o' is no label; try Idle, Jog or Hold");
    QString refused;
    QObject::connect(&items, &ItemModel::refused, [&](const QString& why) { refused = why; });
    press(Qt::Key_Return);
    EXPECT_EQ(refused, "mode: 'o' is no label; try Idle, Jog or Hold");
    EXPECT_FALSE(entered("mode"));
    ASSERT_NE(field(), nullptr);
    field()->selectAll();
    QTest::keyClicks(field(), "J");
    EXPECT_NE(list(), nullptr);
    press(Qt::Key_Return);
    EXPECT_EQ(entered("mode"), number(1));
}

TEST_F(LabelField, IsChosenFromWithTheMouseAndTheWheelChangesNothing) {
    ASSERT_TRUE(opens("mode"));
    const QPoint third = list()->visualItemRect(list()->item(2)).center();
    for (const int turned : {-120, 120}) {  // down first, as the first is chosen
        QWheelEvent wheel{third, list()->mapToGlobal(third), {0, 0}, {0, turned}, Qt::NoButton,
                          {},    Qt::NoScrollPhase,          false};
        QApplication::sendEvent(list()->viewport(), &wheel);
        EXPECT_EQ(field()->text(), "Idle");
        EXPECT_EQ(list()->currentRow(), 0);
    }
    QTest::mouseClick(list()->viewport(), Qt::LeftButton, {}, third);
    EXPECT_EQ(entered("mode"), number(2));
    EXPECT_EQ(field(), nullptr);
}

TEST_F(LabelField, IsChosenAgainWhereSomebodyElseHasSetAnotherOne) {
    ASSERT_TRUE(opens("mode"));
    agent->put("/worker", "mode", std::int64_t{2});
    shows({agent->now()});
    EXPECT_EQ(list()->currentRow(), 0) << "what is chosen stays";
    press(Qt::Key_Down);
    press(Qt::Key_Up);
    press(Qt::Key_Return);
    EXPECT_EQ(entered("mode"), number(0));
}

TEST_F(LabelField, StaysOpenWithWhatIsChosenWhereTheAgentStartsAnew) {
    ASSERT_TRUE(opens("mode"));
    press(Qt::Key_Down);
    starts();
    shows({agent->now()});
    ASSERT_NE(field(), nullptr);
    EXPECT_EQ(field()->text(), "Jog");
    ASSERT_NE(list(), nullptr);
    EXPECT_EQ(list()->currentRow(), 1);
    press(Qt::Key_Return);
    EXPECT_EQ(entered("mode"), number(1));
}

TEST_F(LabelField, ShowsAValueWithoutALabelAsItsNumber) {
    agent->put("/worker", "mode", std::int64_t{7});
    shows({agent->now()});
    ASSERT_TRUE(opens("mode"));
    EXPECT_EQ(field()->text(), "7");
    EXPECT_EQ(list()->currentRow(), -1);
    press(Qt::Key_Return);
    EXPECT_FALSE(entered("mode")) << "it is left as it was";
}

TEST(ChoiceListOfAnOpenEnumeration, LetsANumberBeTyped) {
    QWidget window;
    QLineEdit typed{&window};
    ChoiceList choices{{{1, "Slow"}, {2, "12V"}}, true, typed};
    EXPECT_TRUE(choices.follow("2", true));
    EXPECT_EQ(choices.currentRow(), 1);
    EXPECT_FALSE(choices.follow("12", true)) << "it is a value by itself";
    EXPECT_EQ(choices.currentRow(), -1);
    EXPECT_TRUE(choices.follow("12", false));
    EXPECT_EQ(choices.chosen(), "12V");
}

TEST_F(ItemField, IsNotOpenedInTheTableOfAnotherSimplex) {
    ASSERT_TRUE(opens());
    QTest::keyClicks(field(), "7");
    shows({});
    items.show("/other");
    items.show("/worker");
    shows({agent->now()});
    EXPECT_EQ(field(), nullptr);
}

}  // namespace
}  // namespace cortex::test
