// SPDX-License-Identifier: Apache-2.0
// Tabs in two panes, what finds everything, and layouts of tabs that come back.
#include "window/workspace.hpp"

#include "gui/workspace_fixture.hpp"
#include "model/plotted_items.hpp"
#include "plots/plot_view.hpp"
#include "views/base_view.hpp"
#include "views/event_list.hpp"
#include "widgets/tab_row.hpp"
#include "widgets/text_label.hpp"
#include "window/find_panel.hpp"
#include "window/layout_keeper.hpp"

#include <QDir>
#include <QJsonArray>
#include <QJsonDocument>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QTabBar>
#include <QTemporaryDir>
#include <QToolButton>
#include <QTreeView>
#include <QTreeWidget>
#include <algorithm>

#include <QtTest/QTest>

namespace cortex::test {
namespace {

TEST_F(Workspaces, APinnedTabKeepsItsSimplexWhileTheFirstFollows) {
    ASSERT_TRUE(everythingComes());
    window.open("/axis/observed");
    window.openTab("/drive");
    EXPECT_EQ(titles(0),
              (QStringList{"Overview", "/axis/observed", "/drive", "System", "Agents", "Events"}));

    window.open("/controller");

    EXPECT_EQ(titles(0),
              (QStringList{"Overview", "/controller", "/drive", "System", "Agents", "Events"}));
}

TEST_F(Workspaces, TabsAreSeenAlsoWhereAViewIsOpenedBeforeTheWindow) {
    MainWindow another{session};
    another.openKind("compare");
    another.show();
    QApplication::processEvents();
    EXPECT_GE(another.workspace().panes()[0]->tabs().height(), Look::units(7));
}

TEST_F(Workspaces, WhatIsOpenedIsGoneToWhereAPinnedTabShowsIt) {
    ASSERT_TRUE(everythingComes());
    window.open("/axis/observed");
    window.openTab("/drive");
    const QStringList before = titles(0);
    window.open("/drive");
    EXPECT_EQ(titles(0), before);
    EXPECT_EQ(window.workspace().path(), "/drive");
    window.open("/controller");
    EXPECT_EQ(titles(0)[1], "/controller") << "the other one follows";
}

TEST_F(Workspaces, TheKeyboardGoesWithTheTabThatIsMovedToTheOtherPane) {
    ASSERT_TRUE(everythingComes());
    window.openTab("/drive");
    press("Ctrl+\\");
    const Pane& right = *window.workspace().panes()[1];
    ASSERT_EQ(titles(1), QStringList{"/drive"});
    ASSERT_NE(QApplication::focusWidget(), nullptr);
    EXPECT_TRUE(right.isAncestorOf(QApplication::focusWidget()));
    press("Ctrl+W");
    EXPECT_EQ(right.count(), 0);
}

class ManyTabs : public Workspaces {
protected:
    ManyTabs() {
        window.resize(800, 600);
        for (const char* each : {"/drive", "/controller", "/axis/observed", "/axis/demanded",
                                 "/drive2", "/controller2", "/axis/observed2"})
            window.openTab(each);
        QApplication::processEvents();
    }
    QStringList seen() {
        QStringList all;
        for (int tab = 0; tab < tabs.count(); ++tab) {
            if (!tabs.isTabVisible(tab)) continue;
            all << tabs.tabText(tab);
            EXPECT_TRUE(tabs.rect().contains(tabs.tabRect(tab))) << all.back().toStdString();
            const QRect& button = tabs.moreButton().geometry();
            EXPECT_FALSE(tabs.moreButton().isVisible() && button.intersects(tabs.tabRect(tab)));
        }
        return all;
    }
    bool seesTheOneInFront() { return tabs.isTabVisible(tabs.currentIndex()); }
    TabRow& tabs = *qobject_cast<TabRow*>(&window.workspace().panes()[0]->tabs());
};

TEST_F(ManyTabs, ThatHaveNoRoomAreBehindAButtonThatSaysHowMany) {
    const auto hidden = tabs.count() - seen().size();
    ASSERT_GT(hidden, 0);
    EXPECT_TRUE(seesTheOneInFront());
    ASSERT_TRUE(tabs.moreButton().isVisible());
    EXPECT_TRUE(tabs.moreButton().text().startsWith(QString::number(hidden) + " more"));
    for (const auto* each : tabs.findChildren<QToolButton*>())
        EXPECT_TRUE(!each->isVisible() || each->arrowType() == Qt::NoArrow);
    tabs.moreButton().click();
    const auto* menu = tabs.findChild<QMenu*>();
    ASSERT_NE(menu, nullptr);
    EXPECT_EQ(menu->actions().size(), hidden);
    menu->actions().back()->trigger();
    EXPECT_TRUE(window.workspace().shows("events"));
    EXPECT_TRUE(seen().contains("Events"));
    window.resize(2400, 800);
    QApplication::processEvents();
    EXPECT_EQ(seen().size(), tabs.count());
    EXPECT_FALSE(tabs.moreButton().isVisible());
}

TEST_F(ManyTabs, AreReachedByKeysWhetherTheyHaveRoomOrNot) {
    tabs.setCurrentIndex(0);
    for (int tab = 1; tab < tabs.count(); ++tab) {
        QTest::keyClick(&tabs, Qt::Key_Right);
        EXPECT_EQ(tabs.currentIndex(), tab);
        EXPECT_TRUE(seesTheOneInFront());
    }
    for (int number = 1; number <= 9; ++number) {
        press(("Ctrl+" + std::to_string(number)).c_str());
        EXPECT_EQ(tabs.currentIndex(), number - 1);
        EXPECT_TRUE(seesTheOneInFront());
    }
}

TEST_F(ManyTabs, KeepTheirPlacesWhenOneThatIsSeenIsChosen) {
    window.openKind("events");
    QApplication::processEvents();
    const QStringList before = seen();
    for (int tab = 0; tab < tabs.count(); ++tab) {
        if (!tabs.isTabVisible(tab)) continue;
        const QRect place = tabs.tabRect(tab);
        tabs.setCurrentIndex(tab);
        EXPECT_EQ(tabs.tabRect(tab), place);
        EXPECT_EQ(seen(), before);
    }
}

TEST_F(Workspaces, ALongPathTakesNoMoreOfTheRowThanOthersAndIsWholeInItsToolTip) {
    const std::string path = "/drive" + std::string(110, 'x');
    window.workspace().openTab(path);
    window.refresh();
    QApplication::processEvents();
    QTabBar& tabs = window.workspace().panes()[0]->tabs();
    const int tab = tabs.currentIndex();
    EXPECT_LE(tabs.tabRect(tab).width(), Look::units(50));
    EXPECT_TRUE(tabs.tabToolTip(tab).contains(QString::fromStdString(path)));
}

TEST_F(Workspaces, ATabThatIsNotOfferedIsNeitherSeenNorBehindTheButton) {
    TabRow row;
    for (const char* each : {"Own", "Data", "Type"}) row.addTab(each);
    row.offer(0, false);
    row.resize(row.sizeHint());
    row.show();
    QApplication::processEvents();
    EXPECT_FALSE(row.isTabVisible(0));
    EXPECT_EQ(row.currentIndex(), 1);
    EXPECT_FALSE(row.moreButton().isVisible());
    row.setCurrentIndex(2);
    QTest::keyClick(&row, Qt::Key_Left);
    QTest::keyClick(&row, Qt::Key_Left);
    EXPECT_EQ(row.currentIndex(), 1);
    row.offer(0, true);
    EXPECT_TRUE(row.moreButton().isVisible() || row.isTabVisible(0));
}

TEST_F(Workspaces, AClosedTabComesBackWithWhatItShowed) {
    ASSERT_TRUE(everythingComes());
    window.openTab("/drive");
    press("Ctrl+W");
    EXPECT_EQ(titles(0), (QStringList{"Overview", "Simplex", "System", "Agents", "Events"}));
    press("Ctrl+2");
    press("Ctrl+W");
    EXPECT_EQ(titles(0), (QStringList{"Overview", "Simplex", "System", "Agents", "Events"}))
        << "that of what is chosen stays";

    press("Ctrl+Shift+W");

    EXPECT_EQ(titles(0),
              (QStringList{"Overview", "Simplex", "/drive", "System", "Agents", "Events"}));
    EXPECT_EQ(window.workspace().path(), "/drive");
}

TEST_F(Workspaces, TwoPanesShowTwoSimplexesSideBySide) {
    ASSERT_TRUE(everythingComes());
    window.open("/axis/observed");
    window.openTab("/drive");
    EXPECT_FALSE(window.workspace().panes()[1]->isVisible());

    press("Ctrl+\\");

    EXPECT_EQ(titles(1), QStringList{"/drive"});
    const auto shown = window.workspace().findChildren<BaseView*>();
    EXPECT_EQ(std::ranges::count_if(shown, [](const auto* each) { return each->isVisible(); }), 2);
    press("Ctrl+W");
    EXPECT_FALSE(window.workspace().panes()[1]->isVisible()) << "an empty pane goes";
}

TEST_F(Workspaces, AViewOfAPlugInForTheWholeSystemHasATab) {
    ASSERT_TRUE(everythingComes());
    window.openKind("view:looks");
    EXPECT_TRUE(comes([this] { return said().startsWith("0.5|") && said().endsWith("later"); }))
        << said().toStdString();
    EXPECT_EQ(titles(0).back(), "Events");
    EXPECT_TRUE(said().contains("|/drive|none|")) << said().toStdString();

    window.tree().choose("/drive");
    Q_EMIT window.tree().chosen("/axis/demanded");

    EXPECT_TRUE(comes([this] { return said().endsWith("/axis/demanded later"); }))
        << "it shows what is chosen itself: " << said().toStdString();
}

TEST_F(Workspaces, FindOpensItemsCommandsAndViewsByAFewLetters) {
    ASSERT_TRUE(everythingComes());
    finds("drive damp");
    EXPECT_EQ(firstFound(), "/drive.dampingRatio");
    QTest::keyClick(&window.findPanel()->field(), Qt::Key_Return);
    EXPECT_EQ(window.workspace().path(), "/drive");
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);

    finds("events");
    EXPECT_EQ(firstFound(), "Events");
    QTest::keyClick(&window.findPanel()->field(), Qt::Key_Return);
    EXPECT_TRUE(window.workspace().shows("events"));
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);

    finds("no such thing");
    EXPECT_EQ(window.findPanel()->list().topLevelItemCount(), 0);
}

TEST_F(Workspaces, FindPlotsAnItemByCtrlEnter) {
    ASSERT_TRUE(everythingComes());
    finds("axis/observed position");
    ASSERT_EQ(firstFound(), "/axis/observed.position");
    QTest::keyClick(&window.findPanel()->field(), Qt::Key_Return, Qt::ControlModifier);
    const auto* plot = qobject_cast<PlotView*>(window.current());
    ASSERT_NE(plot, nullptr);
    EXPECT_TRUE(comes([&] { return plot->drawn().size() == 1; }));
}

TEST_F(Workspaces, ASimplexIsDraggedFromTheTreeAsItsNumbersThatAreNotConstant) {
    ASSERT_TRUE(everythingComes());
    const auto all = plottedItems(*session.frame(), "/axis/observed");
    EXPECT_EQ(std::ranges::count(all, "position", &RecordedItem::item), 1);
    EXPECT_EQ(std::ranges::count(all, "state", &RecordedItem::item), 0);
    const Type& type = session.frame()->type(*session.frame()->find("/axis/observed"));
    for (const RecordedItem& each : all)
        EXPECT_FALSE(type.findData(each.item)->constant) << each.item;
    EXPECT_TRUE(tree().flags(tree().indexOf("/axis/observed")).testFlag(Qt::ItemIsDragEnabled));
}

TEST_F(Workspaces, APressInTheTreeMayBeginADragAndChoosesNothingBeforeItsEnd) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    auto* rows = window.tree().findChild<QTreeView*>();
    rows->expandAll();
    const QPoint at = rows->visualRect(tree().indexOf("/axis/observed")).center();
    QTest::mousePress(rows->viewport(), Qt::LeftButton, Qt::NoModifier, at);
    EXPECT_EQ(window.workspace().path(), "/drive");
    QTest::mouseRelease(rows->viewport(), Qt::LeftButton, Qt::NoModifier, at);
    EXPECT_EQ(window.workspace().path(), "/axis/observed");
}

class KeptLayouts : public Workspaces {
protected:
    LayoutKeeper keeper() {
        return {Layouts{folder.path()},
                {[this] { return window.workspace().saved(); },
                 [this](const QJsonObject& each) { window.workspace().restore(each); }}};
    }
    QStringList files() { return QDir{folder.path()}.entryList(QDir::Files); }
    QTemporaryDir folder;
};

TEST_F(KeptLayouts, AreRestoredBeforeAnythingHasCome) {
    ASSERT_TRUE(everythingComes());
    {
        auto first = keeper();
        first.begin(7);
        window.openTab("/drive");
        window.openKind("view:looks");
        press("Ctrl+\\");
        first.noteChange();
        ASSERT_TRUE(comes([&] {
            first.refresh(*session.frame());
            return session.frame()->complete;
        }));
        first.save();
    }
    ASSERT_EQ(files().size(), 1);
    const QStringList left = titles(0), right = titles(1);
    Session elsewhere{ownNetwork()};
    MainWindow another{elsewhere};
    LayoutKeeper second{Layouts{folder.path()},
                        {[&] { return another.workspace().saved(); },
                         [&](const QJsonObject& each) { another.workspace().restore(each); }}};

    second.begin(7);

    EXPECT_EQ(another.workspace().panes()[0]->count(), left.size());
    EXPECT_EQ(another.workspace().panes()[1]->title(0), right.front());
    EXPECT_EQ(another.workspace().panes()[0]->title(2), "/drive");
}

TEST_F(KeptLayouts, ThatAreBrokenAreSetAsideWithWords) {
    for (const char* text : {"{", "[]", "{\"version\": 99}", "{\"version\":1,\"layout\":3}"}) {
        QFile file{folder.path() + "/domain-7-0123456789ab.json"};
        ASSERT_TRUE(file.open(QIODevice::WriteOnly));
        file.write(text);
        file.close();
        auto broken = keeper();
        QString told;
        QObject::connect(&broken, &LayoutKeeper::told, [&](const QString& each) { told = each; });

        broken.begin(7);

        EXPECT_TRUE(told.contains("It was set aside as ")) << told.toStdString();
        EXPECT_FALSE(QFile::exists(file.fileName()));
        EXPECT_EQ(titles(0), (QStringList{"Overview", "Simplex", "System", "Agents", "Events"}));
    }
    EXPECT_EQ(files().size(), 4) << "nothing is lost";
}

TEST_F(KeptLayouts, OfSomebodyElseKeepThePlaceOfAViewThatIsNotInstalled) {
    const QJsonObject state{{"zoom", 3}};
    const QJsonArray tabs{QJsonObject{{"kind", "view:boom-overview"}, {"state", state}},
                          QJsonObject{{"kind", 12}}, "nonsense"};
    window.workspace().restore({{"panes", QJsonArray{QJsonObject{{"tabs", tabs}}}}});

    EXPECT_TRUE(titles(0).contains("boom-overview"));
    const QByteArray kept = QJsonDocument{window.workspace().saved()}.toJson();
    EXPECT_TRUE(kept.contains("\"zoom\": 3")) << kept.toStdString();
}

TEST_F(KeptLayouts, OfEarlierBuildsGetTheFirstPageOnceAndKeepTheirTabInFront) {
    const auto tab = [](const char* kind) { return QJsonObject{{"kind", kind}}; };
    const QJsonArray tabs{tab("simplex"), tab("system"), tab("agents"), tab("events")};
    window.workspace().restore({{"panes", QJsonArray{QJsonObject{{"tabs", tabs}, {"front", 2}}}}});
    EXPECT_EQ(titles(0), (QStringList{"Overview", "Simplex", "System", "Agents", "Events"}));
    EXPECT_TRUE(window.workspace().shows("agents"));

    window.openKind("overview");
    press("Ctrl+W");
    const QJsonObject saved = window.workspace().saved();
    window.workspace().restore(saved);
    EXPECT_EQ(titles(0), (QStringList{"Simplex", "System", "Agents", "Events"})) << "it was closed";
    window.openKind("overview");  // as the menu does
    EXPECT_TRUE(window.workspace().shows("overview"));
    EXPECT_EQ(titles(0).front(), "Overview");
}

TEST_F(KeptLayouts, HaveTheFirstPageAndTheSimplexWhereTheyStood) {
    window.workspace().panes()[0]->tabs().moveTab(0, 2);
    const QStringList before = titles(0);
    ASSERT_EQ(before, (QStringList{"Simplex", "System", "Overview", "Agents", "Events"}));
    window.workspace().panes()[0]->tabs().moveTab(0, 1);
    const QStringList moved = titles(0);
    const QJsonObject saved = window.workspace().saved();
    window.workspace().restore(saved);
    EXPECT_EQ(titles(0), moved);
    window.workspace().panes()[0]->choose(1);
    press("Ctrl+W");
    EXPECT_EQ(titles(0), moved) << "the tab of the simplex stays";
}

TEST_F(KeptLayouts, AreResetAndComeBack) {
    ASSERT_TRUE(everythingComes());
    auto layout = keeper();
    layout.begin(7);
    window.openTab("/drive");
    layout.reset();
    EXPECT_FALSE(titles(0).contains("/drive"));
    layout.goBack();
    EXPECT_TRUE(titles(0).contains("/drive"));
}

}  // namespace
}  // namespace cortex::test
