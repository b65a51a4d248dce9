// SPDX-License-Identifier: Apache-2.0
// What was entered for items and not sent: it is neither lost nor sent as something else.
#include "core/model_folder.hpp"
#include "gui/item_field.hpp"

#include <memory>

namespace cortex::test {
namespace {

TEST_F(ItemField, WhatWasEnteredBeforeItsSimplexWasLeftIsNotSentByEnterInAnotherField) {
    items.setData(cellOf("gain"), "7");
    items.show("/other");
    items.show("/worker");
    shows({agent->now()});
    EXPECT_TRUE(items.freshEdits().empty());
    items.setData(cellOf("weights"), "0 0 1");
    items.setData(cellOf("on"), "true");
    EXPECT_EQ(items.freshEdits().size(), 2U);
    EXPECT_FALSE(items.freshEdits().contains("gain"));
    EXPECT_EQ(items.edits().size(), 3U) << "it stays";
    items.setData(cellOf("gain"), "7");
    EXPECT_TRUE(items.freshEdits().contains("gain")) << "Enter was in its own field";
}

TEST_F(ItemField, WhatIsEnteredIsThereAgainInTheNextTableWhereItsOwnIsClosed) {
    const auto kept = std::make_shared<KeptEdits>();
    {
        ItemModel closed;
        closed.keepIn(kept);
        closed.show("/worker");
        closed.update(frameOf({agent->now()}));
        const QModelIndex group = closed.index(0, 0);
        for (int i = 0; i < closed.rowCount(group); ++i) {
            const QModelIndex cell = closed.index(i, ItemModel::Value, group);
            if (closed.row(cell).item->name == "gain") closed.setData(cell, "7");
        }
        ASSERT_EQ(closed.edits().size(), 1U);
    }
    EXPECT_EQ(kept->size(), 1U);
    items.show("/other");
    items.keepIn(kept);
    items.show("/worker");
    EXPECT_EQ(entered(), one(7));
    EXPECT_EQ(kept->size(), 0U);
}

// The agent starts again with other types.
class ChangedType : public ItemField {
protected:
    ChangedType() {
        QObject::connect(&items, &ItemModel::setAside,
                         [this](const std::string& path, const QStringList& each) {
                             EXPECT_EQ(path, "/worker");
                             aside << each;
                         });
    }
    void startsWith(const std::string& data) {
        const ModelFolder folder;
        const auto file = folder.write(
            "types.xml", R"(<ontology name="other" version="1.0"><include file="base.xml"/>
                         <type name="Worker" extends="Concept">)" +
                             data + "</type></ontology>");
        agent.emplace(
            "robot", [](SimplexTree& tree) { tree.add("/worker", "Worker"); },
            TypeModel::load(file));
        shows({agent->now()});
    }
    QStringList aside;
};

const std::string sameGain =
    R"(<data name="gain" kind="float" unit="m" safe="0" settable="always"/>)";

TEST_F(ChangedType, SetsAsideWhatWouldMeanSomethingElse) {
    items.setData(cellOf("gain"), "7");
    items.setData(cellOf("mode"), "Hold");
    items.setData(cellOf("weights"), "0 0 1");
    items.setData(cellOf("on"), "true");
    startsWith(sameGain +
               R"(<data name="mode" kind="int" labels="0:Idle 2:Fast" safe="0" settable="always"/>
               <data name="weights" kind="float" length="4" safe="0 0 0 0" settable="always"/>)");
    EXPECT_EQ(aside, (QStringList{"mode", "weights"}));
    EXPECT_EQ(entered(), one(7)) << "it means the same";
    startsWith(R"(<data name="gain" kind="float" unit="mm" safe="0" settable="always"/>
               <data name="on" kind="int" safe="0" settable="always"/>)");
    EXPECT_EQ(aside, (QStringList{"mode", "weights", "gain", "on"}));
    EXPECT_TRUE(items.edits().empty());
}

TEST_F(ChangedType, SetsAsideWhatWasEnteredBeforeAnotherSimplexWasShown) {
    items.setData(cellOf("gain"), "7");
    items.show("/other");
    startsWith(R"(<data name="gain" kind="float" unit="mm" safe="0" settable="always"/>)");
    EXPECT_EQ(aside, QStringList{});
    items.show("/worker");
    EXPECT_EQ(aside, QStringList{"gain"});
    EXPECT_TRUE(items.edits().empty());
}

TEST_F(ChangedType, ClosesAFieldWhoseTextWouldMeanSomethingElse) {
    ASSERT_TRUE(opens());
    QTest::keyClicks(field(), "5");
    startsWith(R"(<data name="gain" kind="float" unit="mm" safe="0" settable="always"/>)");
    EXPECT_EQ(field(), nullptr);
    EXPECT_EQ(aside, QStringList{"gain"});
    startsWith(sameGain);
    EXPECT_EQ(field(), nullptr);
}

}  // namespace
}  // namespace cortex::test
