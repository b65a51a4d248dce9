// SPDX-License-Identifier: Apache-2.0
// The table of data: what has room in its columns.
#include "widgets/item_table.hpp"

#include "core/model_folder.hpp"
#include "gui/made_agent.hpp"
#include "model/item_model.hpp"
#include "model/plotted_items.hpp"
#include "model/value_text.hpp"
#include "widgets/rows.hpp"

#include <QApplication>
#include <QKeyEvent>
#include <algorithm>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

TypeModel joints() {
    const ModelFolder folder;
    return TypeModel::load(
        folder.write("joints.xml",
                     "<ontology name='joints' version='1.0'><include file='base.xml'/>"
                     "<type name='Joint' extends='Concept'>"
                     "<data name='angle' kind='float' unit='rad' min='-2.0943951' max='170.03125'/>"
                     "<data name='ratio' kind='float' constant='true' default='3'/>"
                     "<data name='label' kind='string'/>"
                     "</type></ontology>"));
}

class Ranges : public testing::Test {
protected:
    Ranges() {
        items.show("/joint");
        items.update(frame);
        table.show();
    }
    const ItemModel::Row& angle() { return items.row(items.index(0, 0, items.index(0, 0))); }
    QStringList limits() {
        return {numberText(angle().asShown(), *angle().min),
                numberText(angle().asShown(), *angle().max)};
    }
    // What the column leaves for both numbers beside the bar.
    int room() { return table.columnWidth(ItemModel::Range) - Look::units(4) - Look::units(20); }
    void makeWide(int units) {
        table.resize(Look::units(units), Look::units(100));
        QApplication::processEvents();
    }

    MadeAgent agent{"robot", [](SimplexTree& tree) { tree.add("/joint", "Joint"); }, joints()};
    std::shared_ptr<Frame> frame = frameOf({agent.now()});
    ItemModel items;
    ItemTable table{items};
};

class Shortcuts : public testing::Test {
protected:
    static TypeModel model() {
        const ModelFolder folder;
        return TypeModel::load(
            folder.write("plates.xml",
                         "<ontology name='plates' version='1.0'><include file='base.xml'/>"
                         "<type name='Plate' extends='Concept'>"
                         "<data name='angle' kind='float' settable='always'/>"
                         "<data name='label' kind='string' settable='always'/>"
                         "<data name='mode' kind='int' settable='always' labels='0:Park,1:Run'/>"
                         "<data name='said' kind='string'/>"
                         "</type></ontology>"));
    }
    // Whether the row of the item takes the letter before a shortcut of the window does.
    bool takes(const char* item, Qt::Key key, const char* text) {
        const QModelIndex group = items.index(0, 0);
        for (int row = 0; row < items.rowCount(group); ++row) {
            const QModelIndex index = items.index(row, ItemModel::Name, group);
            if (index.data() != item) continue;
            table.setCurrentIndex(index);
            QKeyEvent event{QEvent::ShortcutOverride, key, Qt::NoModifier, text};
            event.ignore();
            QApplication::sendEvent(&table, &event);
            return event.isAccepted();
        }
        ADD_FAILURE() << item;
        return false;
    }

    MadeAgent agent{"robot", [](SimplexTree& tree) { tree.add("/plate", "Plate"); }, model()};
    std::shared_ptr<Frame> frame = frameOf({agent.now()});
    ItemModel items;
    ItemTable table{items};
};

TEST_F(Shortcuts, GiveWayToALetterThatBeginsAText) {
    items.show("/plate");
    items.update(frame);
    EXPECT_TRUE(takes("label", Qt::Key_P, "p"));
    EXPECT_TRUE(takes("label", Qt::Key_Slash, "/"));
    EXPECT_TRUE(takes("mode", Qt::Key_P, "p"));
    EXPECT_FALSE(takes("mode", Qt::Key_Slash, "/")) << "no label begins with it";
    EXPECT_FALSE(takes("angle", Qt::Key_P, "p")) << "a number does not";
    EXPECT_FALSE(takes("said", Qt::Key_P, "p")) << "it cannot be set";
}

TEST_F(Ranges, HaveTheirNumbersWholeWhereThereIsRoomAndTheRemarkGivesWay) {
    for (const int width : {210, 260, 300}) {
        makeWide(width);
        for (const QString& each : limits())
            EXPECT_LE(2 * textWidth(each), room()) << width << ' ' << each.toStdString();
        EXPECT_FALSE(table.isColumnHidden(ItemModel::Remark));
    }
}

TEST_F(Ranges, AreWholeInTheToolTip) {
    const QString tip =
        items.index(0, ItemModel::Range, items.index(0, 0)).data(Qt::ToolTipRole).toString();
    EXPECT_TRUE(tip.contains("−2.0943951 to 170.03125 rad")) << tip.toStdString();
}

TEST_F(Ranges, AndNumbersThatAreNotConstantAreWhatIsPlottedOfASimplex) {
    const auto all = plottedItems(*frame, "/joint");
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].item, "angle");
    EXPECT_EQ(plottedItems(*frame, "/joint", "ratio").size(), 1U) << "it was asked for";
    EXPECT_EQ(plottedItems(*frame, "/joint", "label").size(), 1U) << "a lane of words";
    EXPECT_TRUE(plottedItems(*frame, "/nothing").empty());
}

}  // namespace
}  // namespace cortex::test
