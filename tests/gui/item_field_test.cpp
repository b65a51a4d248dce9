// SPDX-License-Identifier: Apache-2.0
// The field of an item in the table of data: what is typed stays, whatever comes meanwhile.
#include "gui/made_agent.hpp"
#include "model/item_model.hpp"
#include "widgets/item_table.hpp"

#include <QApplication>
#include <QKeyEvent>
#include <QLineEdit>
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

class ItemField : public testing::Test {
protected:
    ItemField() {
        starts();
        items.show("/worker");
        shows({agent->now()});
        table.show();
    }
    void starts() {
        agent.emplace(
            "robot", [](SimplexTree& tree) { tree.add("/worker", "Worker"); }, "command-types.xml");
    }
    void shows(std::vector<AgentFrame> agents) { items.update(frameOf(std::move(agents))); }
    // Somebody else sets it.
    void comes(double gain) {
        agent->put("/worker", "gain", gain);
        shows({agent->now()});
    }
    QModelIndex cellOf(const QString& item) {
        for (int group = 0; group < items.rowCount(); ++group) {
            const QModelIndex above = items.index(group, 0);
            for (int row = 0; row < items.rowCount(above); ++row) {
                if (items.index(row, ItemModel::Name, above).data() == item)
                    return items.index(row, ItemModel::Value, above);
            }
        }
        return {};
    }
    // The field that is open; null: none.
    QLineEdit* field() {
        const auto fields = table.viewport()->findChildren<QLineEdit*>();
        const auto found =
            std::ranges::find_if(fields, [](const auto* each) { return !each->isHidden(); });
        return found == fields.end() ? nullptr : *found;
    }
    bool opens(const QModelIndex& cell) {
        table.setCurrentIndex(cell);
        QKeyEvent edit{QEvent::KeyPress, Qt::Key_F2, Qt::NoModifier};
        QApplication::sendEvent(&table, &edit);
        return field() != nullptr;
    }
    bool opens() { return opens(cellOf("gain")); }
    void press(Qt::Key key) {
        QTest::keyClick(field(), key);
        QApplication::processEvents();
    }
    // What was entered for an item and is not sent yet.
    std::optional<Value> entered(const std::string& item = "gain") {
        const auto edits = items.edits();
        const auto found = edits.find(item);
        return found != edits.end() ? std::optional{found->second} : std::nullopt;
    }
    static Value one(double value) { return std::vector{value}; }

    std::optional<MadeAgent> agent;
    ItemModel items;
    ItemTable table{items};
};

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
