// SPDX-License-Identifier: Apache-2.0
// The order, the cells and the file of a comparison, of agents made by hand.
#include "core/model_folder.hpp"
#include "gui/made_agent.hpp"
#include "model/compare_model.hpp"
#include "style/look.hpp"
#include "views/compare_view.hpp"
#include "widgets/rows.hpp"
#include "widgets/text_label.hpp"

#include <QTreeView>
#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double noNumber = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t mostWhole = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t leastWhole = std::numeric_limits<std::int64_t>::min();

TypeModel comparedTypes() {
    const ModelFolder folder;
    return TypeModel::load(folder.write(
        "compared.xml",
        "<ontology name='compared' version='1.0'><include file='base.xml'/>"
        "<type name='Gap' extends='Concept'>"
        "<data name='y' kind='float' unit='m' min='0' max='1'/></type>"
        "<type name='Tally' extends='Concept'><data name='big' kind='int'"
        " min='-9223372036854775808' max='9223372036854775807'/></type>"
        "<type name='Door' extends='Concept'><data name='open' kind='float' unit='m'/></type>"
        "<type name='Lid' extends='Concept'><data name='open' kind='float' unit='mm'/></type>"
        "<type name='Shop' extends='Concept'><data name='open' kind='float' unit='s'/></type>"
        "<type name='Note' extends='Concept'><data name='text' kind='string'/></type>"
        "</ontology>"));
}

class ComparedOrder : public testing::Test {
protected:
    QStringList sorted(const char* item, int column, Qt::SortOrder order = Qt::AscendingOrder) {
        rows.compare(item, {});
        rows.sort(column, order);
        rows.update(frameOf({agent.now()}), true);
        QStringList paths;
        for (int row = 0; row < rows.rowCount(); ++row)
            paths << rows.row(row).path.section('/', -1);
        return paths;
    }
    const CompareRow& rowOf(const QString& path) {
        int row = 0;
        while (rows.row(row).path != path) ++row;
        return rows.row(row);
    }
    void putGaps() {
        int number = 0;
        for (const double y : {0.5, noNumber, -infinity, 1.5, 0.25, -0.2, noNumber, infinity})
            agent.put("/w/" + std::to_string(++number), "y", y);
    }

    MadeAgent agent{"robot",
                    [](SimplexTree& tree) {
                        for (int i = 1; i < 9; ++i) tree.add("/w/" + std::to_string(i), "Gap");
                        for (int i = 1; i < 5; ++i) tree.add("/p/" + std::to_string(i), "Tally");
                        tree.add("/d/1", "Door");
                        tree.add("/d/2", "Shop");
                        tree.add("/d/3", "Lid");
                        tree.add("/d/4", "Door");
                        tree.add("/n", "Note");
                    },
                    comparedTypes()};
    CompareModel rows;
};

TEST_F(ComparedOrder, WhatIsNoNumberStandsAtTheEndAndInfinitiesBeyondEveryLimit) {
    putGaps();
    EXPECT_EQ(sorted("y", CompareModel::Distance).join(' '), "3 8 4 6 5 1 2 7");
    EXPECT_EQ(sorted("y", CompareModel::Value).join(' '), "3 6 5 1 4 8 2 7");
    EXPECT_EQ(sorted("y", CompareModel::Value, Qt::DescendingOrder).join(' '), "8 4 1 5 6 3 2 7");
    EXPECT_EQ(rowOf("/w/2").distance, "—");
    EXPECT_EQ(rowOf("/w/3").distance, "−∞ lower");
    EXPECT_EQ(rowOf("/w/8").distance, "−∞ upper");
    EXPECT_EQ(rowOf("/w/4").distance, "−50.0 %  −0.5 upper");
    const QStringList lines = QString::fromStdString(rows.csv()).trimmed().split('\n');
    EXPECT_TRUE(lines[1].startsWith("/w/8,inf,m,0,1,-inf,-inf,good,")) << lines[1].toStdString();
    EXPECT_TRUE(lines[7].startsWith("/w/2,nan,m,0,1,,,good,")) << lines[7].toStdString();
}

TEST_F(ComparedOrder, AValueThatIsNoNumberAtTimesMovesNothingWhileTheOrderIsHeld) {
    putGaps();
    const QStringList before = sorted("y", CompareModel::Value);
    agent.put("/w/1", "y", noNumber);
    const auto next = frameOf({agent.now()});
    --next->structures;  // those of the frame before
    rows.update(next, false);
    EXPECT_EQ(rows.row(3).path, "/w/1");
    EXPECT_FALSE(rows.row(3).number);
    EXPECT_EQ(before[3], "1");
}

TEST_F(ComparedOrder, OutsideIsWhatTheFilterAndTheCounterHaveAsOutside) {
    putGaps();
    for (const char* each : {"/w/2", "/w/3", "/w/7", "/w/8"}) agent.degrade(each, Quality::Bad);
    (void)sorted("y", CompareModel::Distance);
    EXPECT_EQ(rowOf("/w/8").remark, "bad");
    EXPECT_EQ(rowOf("/w/4").remark, "above limit");
    EXPECT_EQ(rowOf("/w/6").remark, "below limit");
    const auto frame = frameOf({agent.now()});
    for (int row = 0; row < rows.rowCount(); ++row) {
        const CompareRow& each = rows.row(row);
        EXPECT_EQ(each.outside, Query{"outside"}.matches(*frame, each.place))
            << each.path.toStdString();
    }
}

TEST_F(ComparedOrder, WholeNumbersKeepTheirLastDigit) {
    agent.put("/p/1", "big", std::int64_t{9007199254740993});
    agent.put("/p/2", "big", std::int64_t{9007199254740992});
    agent.put("/p/3", "big", mostWhole - 1);
    agent.put("/p/4", "big", leastWhole);
    EXPECT_EQ(sorted("big", CompareModel::Value).join(' '), "4 2 1 3");
    EXPECT_EQ(sorted("big", CompareModel::Value, Qt::DescendingOrder).join(' '), "3 1 2 4");
    EXPECT_EQ(sorted("big", CompareModel::Distance).join(' '), "4 3 1 2");
    EXPECT_EQ(rowOf("/p/3").distance, "0.0 %  1 upper");
    EXPECT_EQ(limitText(rowOf("/p/3")),
              "Limits: −9223372036854775808 to 9223372036854775807. "
              "1 below the upper one.");
    const QString csv = QString::fromStdString(rows.csv());
    const QString limits = ",,-9223372036854775808,9223372036854775807,";
    EXPECT_TRUE(csv.contains("/p/1,9007199254740993" + limits + "9214364837600034814,"))
        << csv.toStdString();
    EXPECT_TRUE(csv.contains("/p/2,9007199254740992" + limits + "9214364837600034815,"));
    EXPECT_TRUE(csv.contains("/p/4,-9223372036854775808" + limits + "0,0,"));
}

TEST(ExactNumber, ComparesWholeNumbersWithOthersAndSubtractsAcrossTheWholeRange) {
    const ExactNumber one{std::int64_t{9007199254740993}}, near{9007199254740992.0};
    EXPECT_TRUE(near < one);
    EXPECT_FALSE(one < near);
    EXPECT_TRUE(ExactNumber{mostWhole} < ExactNumber{0x1p63});
    EXPECT_TRUE(ExactNumber{leastWhole} == ExactNumber{-0x1p63});
    EXPECT_EQ((ExactNumber{mostWhole} - ExactNumber{leastWhole}).text(), "18446744073709551615");
    EXPECT_EQ((ExactNumber{leastWhole} - ExactNumber{mostWhole}).text(), "-18446744073709551615");
    EXPECT_TRUE(ExactNumber{mostWhole} - ExactNumber{leastWhole} < ExactNumber{0x1p64});
    EXPECT_EQ((one - one).text(), "0");
    EXPECT_EQ(ExactNumber{0.1}.text(), "0.1");
}

TEST_F(ComparedOrder, AConditionOfAFilterSeesTheLastDigit) {
    agent.put("/p/1", "big", std::int64_t{9007199254740993});
    agent.put("/p/2", "big", std::int64_t{9007199254740992});
    const auto frame = frameOf({agent.now()});
    const Query query{"big=9007199254740993"};
    EXPECT_TRUE(query.matches(*frame, {0, agent.at("/p/1")}));
    EXPECT_FALSE(query.matches(*frame, {0, agent.at("/p/2")}));
}

TEST_F(ComparedOrder, OneDimensionIsComparedInOneUnitAndAnotherStandsBehind) {
    agent.put("/d/1", "open", 1.5);
    agent.put("/d/2", "open", 3.0);
    agent.put("/d/3", "open", 1200.0);
    agent.put("/d/4", "open", 0.7);
    EXPECT_EQ(sorted("open", CompareModel::Value).join(' '), "4 3 1 2");
    EXPECT_EQ(sorted("open", CompareModel::Value, Qt::DescendingOrder).join(' '), "1 3 4 2");
}

TEST_F(ComparedOrder, ATextKeepsItsLineBreakInTheFile) {
    agent.put("/n", "text", std::string{"two\nlines"});
    (void)sorted("text", CompareModel::Path);
    EXPECT_NE(rows.csv().find("\n/n,\"two\nlines\","), std::string::npos) << rows.csv();
}

TEST_F(ComparedOrder, ANumberIsNeverCutByItsColumn) {
    for (int i = 1; i < 5; ++i) agent.put("/p/" + std::to_string(i), "big", leastWhole + i);
    CompareView view;
    view.resize(Look::units(200), Look::units(100));
    view.show();
    view.compare("big");
    view.refresh(frameOf({agent.now()}));
    for (const int column : {CompareModel::Value, CompareModel::Distance}) {
        const QString text = view.rows().index(0, column).data().toString();
        EXPECT_GE(view.table().columnWidth(column), textWidth(text) + Look::units(4))
            << text.toStdString();
    }
}

TEST_F(ComparedOrder, NothingIsSaidToBeLackingWhileNobodyIsHeard) {
    CompareView view;
    view.show();
    const auto says = [&](const QString& text) {
        const auto labels = view.findChildren<TextLabel*>();
        return std::ranges::any_of(labels,
                                   [&](const auto* each) { return each->text().contains(text); });
    };
    view.compare("nothing", "in:/w");
    view.refresh(frameOf({}));
    EXPECT_TRUE(says("Nothing is heard yet."));
    view.refresh(frameOf({agent.now()}));
    EXPECT_TRUE(says("Nothing that matches \"in:/w\" has nothing."));
}

}  // namespace
}  // namespace cortex::test
