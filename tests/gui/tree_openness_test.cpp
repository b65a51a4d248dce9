// SPDX-License-Identifier: Apache-2.0
// Which rows of the tree are open, and the keys of its filter.
#include "gui/made_agent.hpp"
#include "views/system_tree.hpp"

#include <QAbstractItemModelTester>
#include <QApplication>
#include <QJsonArray>
#include <QLineEdit>
#include <QTreeView>
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

MadeAgent agentOf(const std::string& name, const std::vector<std::string>& paths) {
    return {name, [&](SimplexTree& tree) {
                for (const std::string& path : paths) tree.add(path, "Probe");
            }};
}

struct TreeOfKeys {
    TreeOfKeys() {
        for (const auto signal : {&SystemTree::chosen, &SystemTree::entered, &SystemTree::pinned})
            QObject::connect(&tree, signal, [this, signal](const std::string& path) {
                const char* word = signal == &SystemTree::chosen    ? "chosen "
                                   : signal == &SystemTree::entered ? "entered "
                                                                    : "pinned ";
                told.push_back(word + path);
            });
        QObject::connect(&tree, &SystemTree::changed, [this] { ++changes; });
        tree.resize(400, 600);
        tree.show();
        QApplication::setActiveWindow(&tree);
    }
    QTreeView& rows() { return *tree.findChild<QTreeView*>(); }
    QLineEdit& field() { return *tree.findChild<QLineEdit*>(); }
    std::string current() { return tree.model().path(rows().currentIndex()); }
    std::set<std::string> open() {
        std::set<std::string> all;
        addOpen({}, all);
        return all;
    }
    void addOpen(const QModelIndex& above, std::set<std::string>& all) {
        for (int i = 0; i < tree.model().rowCount(above); ++i) {
            const QModelIndex row = tree.model().index(i, 0, above);
            if (tree.model().rowCount(row) == 0) continue;
            if (rows().isExpanded(row)) all.insert(tree.model().path(row));
            addOpen(row, all);
        }
    }
    // As a person does it.
    void press(const std::string& path, Qt::Key key) {
        rows().setCurrentIndex(tree.model().indexOf(path));
        QTest::keyClick(&rows(), key);
    }

    SystemTree tree;
    QAbstractItemModelTester tester{const_cast<SystemModel*>(&tree.model()),
                                    QAbstractItemModelTester::FailureReportingMode::Fatal};
    std::vector<std::string> told;
    int changes = 0;
};

class OpenTree : public TreeOfKeys, public testing::Test {
protected:
    MadeAgent robot = agentOf("robot", {"/control/arm/hold", "/control/arm/inner/deep", "/drive"});
    MadeAgent plant = agentOf("plant", {"/plant/zone/pump/motor", "/plant/valve"});
    MadeAgent more = agentOf("more", {"/control/legs/left", "/drive/brake"});
};

const std::set<std::string> atFirst{"/control", "/control/arm", "/control/legs",
                                    "/drive",   "/plant",       "/plant/zone"};

TEST_F(OpenTree, IsOpenAtFirstToTheSameDepthWhateverComesFirst) {
    std::vector<AgentFrame> all{robot.now(), plant.now(), more.now()};
    std::vector<std::size_t> order{0, 1, 2};
    do {
        TreeOfKeys each;
        std::vector<AgentFrame> heard;
        for (const std::size_t next : order) {
            heard.push_back(all[next]);
            each.tree.refresh(frameOf(heard));
        }
        EXPECT_EQ(each.open(), atFirst) << order[0] << order[1] << order[2];
        EXPECT_EQ(each.changes, 0) << "nobody has opened anything";
    } while (std::ranges::next_permutation(order).found);
}

TEST_F(OpenTree, StaysAsAPersonOpensAndClosesItWhateverComesAndGoes) {
    tree.refresh(frameOf({robot.now(), plant.now()}));
    press("/plant", Qt::Key_Left);
    press("/control/arm/inner", Qt::Key_Right);
    EXPECT_EQ(changes, 2);
    const std::set<std::string> left{"/control", "/control/arm", "/control/arm/inner",
                                     "/plant/zone"};
    ASSERT_EQ(open(), left);
    tree.refresh(frameOf({}));
    tree.refresh(frameOf({robot.now()}));
    tree.refresh(frameOf({robot.now(), plant.now()}));
    EXPECT_EQ(open(), left);
}

TEST_F(OpenTree, IsAfterAFilterAsItWasBeforeIt) {
    tree.refresh(frameOf({robot.now(), plant.now()}));
    press("/plant", Qt::Key_Left);
    tree.choose("/drive");
    const auto before = open();
    for (const char* typed : {"m", "motor", "deep", ""}) {
        tree.filter(QString::fromUtf8(typed));
        if (*typed != '\0') EXPECT_TRUE(open().contains("/plant") || open().contains("/control"));
    }
    EXPECT_EQ(open(), before);
    EXPECT_EQ(changes, 1);
    tree.filter("motor");
    tree.choose("/plant/zone/pump/motor");
    tree.filter("");
    auto withCurrent = before;
    withCurrent.insert({"/plant", "/plant/zone", "/plant/zone/pump"});
    EXPECT_EQ(open(), withCurrent) << "and what is above the row that was chosen";
}

TEST_F(OpenTree, IsAtTheNextStartAsAPersonLeftIt) {
    tree.refresh(frameOf({robot.now(), plant.now()}));
    press("/plant", Qt::Key_Left);
    press("/control/arm/inner", Qt::Key_Right);
    TreeOfKeys next;
    next.tree.openness().restore(tree.openness().saved());
    next.tree.refresh(frameOf({plant.now()}));
    next.tree.refresh(frameOf({plant.now(), robot.now()}));
    EXPECT_EQ(next.open(), open());
    next.tree.openness().restore({});
    EXPECT_TRUE(next.open().contains("/plant")) << "as at first";
}

TEST_F(OpenTree, KeepsWhatALayoutSaysWithinBounds) {
    QJsonArray paths{12, "nonsense", QJsonArray{}, QString{10'000, 'x'}};
    for (int i = 0; i < 5'000; ++i) paths.append("/a" + QString::number(i));
    tree.openness().restore({{"open", paths}, {"closed", "/plant"}});
    const QJsonObject saved = tree.openness().saved();
    EXPECT_LE(saved["open"].toArray().size() + saved["closed"].toArray().size(), 1'000);
    tree.refresh(frameOf({plant.now()}));
    EXPECT_EQ(open(), (std::set<std::string>{"/plant", "/plant/zone"}));
}

TEST_F(OpenTree, DownInTheFilterGoesToTheFirstRowAndUpGoesBack) {
    tree.refresh(frameOf({robot.now(), plant.now()}));
    tree.choose("/drive");
    tree.focusFilter();
    QTest::keyClicks(&field(), "valve");
    QTest::keyClick(&field(), Qt::Key_Down);
    EXPECT_TRUE(rows().hasFocus());
    EXPECT_EQ(current(), "/plant");
    QTest::keyClick(&rows(), Qt::Key_Down);
    EXPECT_EQ(told, std::vector<std::string>{"chosen /plant/valve"});
    QTest::keyClick(&rows(), Qt::Key_Up);
    EXPECT_TRUE(rows().hasFocus());
    QTest::keyClick(&rows(), Qt::Key_Up);
    EXPECT_TRUE(field().hasFocus());
    QTest::keyClick(&field(), Qt::Key_Escape);
    EXPECT_EQ(field().text(), "");
}

TEST_F(OpenTree, EnterInTheFilterOpensTheFirstSimplexThatItFinds) {
    tree.refresh(frameOf({robot.now(), plant.now()}));
    tree.focusFilter();
    QTest::keyClicks(&field(), "nothing");
    QTest::keyClick(&field(), Qt::Key_Return);
    QTest::keyClick(&field(), Qt::Key_Down);
    EXPECT_TRUE(told.empty());
    EXPECT_TRUE(field().hasFocus());
    field().setText("plant");
    QTest::keyClick(&field(), Qt::Key_Return);
    QTest::keyClick(&field(), Qt::Key_Return, Qt::ControlModifier);
    EXPECT_EQ(told, (std::vector<std::string>{"entered /plant/valve", "pinned /plant/valve"}));
    EXPECT_EQ(current(), "/plant/valve");
}

}  // namespace
}  // namespace cortex::test
