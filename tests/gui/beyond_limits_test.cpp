// SPDX-License-Identifier: Apache-2.0
// How the window marks values that cannot be.
#include "cortex/core/image_pool.hpp"
#include "cortex/core/make_structure.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/core/tables.hpp"

#include "model/item_model.hpp"
#include "model/query.hpp"
#include "style/look.hpp"
#include "widgets/item_table.hpp"

#include <QApplication>
#include <memory>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

// /lamp of the agent "robot" has an item `mode`, which is Off or On, as it came.
struct Lamp {
    explicit Lamp(std::int64_t mode) {
        tree.add("/lamp", "Switches").set("mode", mode);
        structure = makeStructure("robot", tree);
        tables = std::make_unique<Tables>(structure);
        images = std::make_unique<ImagePool>(*tables, 4);
        images->publish(1, 0, 0);
        AgentFrame robot;
        robot.status.name = "robot";
        robot.structure = structure;
        robot.image =
            std::make_shared<comms::AgentImage>(nullptr, images->newest(), std::vector<bool>{true});
        frame->structures = 1;
        frame->agents.push_back(std::move(robot));
    }

    SimplexTree tree{TypeModel::load(CORTEX_SOURCE_DIR "/tests/data/cs-rules.xml")};
    std::shared_ptr<const Structure> structure;
    std::unique_ptr<Tables> tables;
    std::unique_ptr<ImagePool> images;
    std::shared_ptr<Frame> frame = std::make_shared<Frame>();
};

TEST(BeyondLimits, ANumberWithoutALabelIsMarkedWithTheLabelsThereAre) {
    const Lamp lamp{7};
    ItemModel items;
    items.show("/lamp");
    items.update(lamp.frame);
    const QModelIndex index = items.index(0, ItemModel::Remark, items.index(0, 0));

    EXPECT_EQ(items.row(index).mark, Shape::NoLabel);
    EXPECT_TRUE(isBeyondLimits(items.row(index).mark));
    EXPECT_EQ(items.data(index).toString(), "no label");
    const QString tip = items.data(index, Qt::ToolTipRole).toString();
    EXPECT_TRUE(tip.contains("labels: 0:Off 1:On")) << tip.toStdString();
}

TEST(BeyondLimits, ANumberWithALabelHasNoMark) {
    const Lamp lamp{1};
    ItemModel items;
    items.show("/lamp");
    items.update(lamp.frame);

    EXPECT_EQ(items.row(items.index(0, 0, items.index(0, 0))).mark, std::nullopt);
}

TEST(BeyondLimits, InANarrowTableTheRangeGivesWayBeforeTheMarkAndItsWord) {
    const Lamp lamp{7};
    ItemModel items;
    items.show("/lamp");
    items.update(lamp.frame);
    ItemTable table{items};
    table.show();
    for (const auto& [width, range, description] :
         {std::tuple{250, true, true}, {165, true, false}, {110, false, false}}) {
        table.resize(Look::units(width), 300);
        QApplication::processEvents();
        EXPECT_FALSE(table.isColumnHidden(ItemModel::Remark)) << width;
        EXPECT_EQ(!table.isColumnHidden(ItemModel::Range), range) << width;
        EXPECT_EQ(!table.isColumnHidden(ItemModel::Description), description) << width;
    }
}

TEST(BeyondLimits, TheFilterFindsWhatIsOutside) {
    EXPECT_TRUE(Query{"outside"}.matches(*Lamp{7}.frame, {0, 0}));
    EXPECT_FALSE(Query{"outside"}.matches(*Lamp{1}.frame, {0, 0}));
}

}  // namespace
}  // namespace cortex::test
