// SPDX-License-Identifier: Apache-2.0
// How a whole window comes back as it was: what is hidden, its size, and layouts with a name.
#include "window/layouts.hpp"

#include "gui/workspace_fixture.hpp"
#include "style/look.hpp"
#include "views/event_list.hpp"
#include "widgets/text_label.hpp"
#include "window/control_bar.hpp"
#include "window/control_notice.hpp"
#include "window/layout_keeper.hpp"
#include "window/layout_menu.hpp"
#include "window/window_size.hpp"

#include <QAction>
#include <QDir>
#include <QFileDialog>
#include <QJsonArray>
#include <QJsonDocument>
#include <QMenu>
#include <QPushButton>
#include <QScreen>
#include <QSplitter>
#include <QTemporaryDir>
#include <QTreeView>
#include <algorithm>

namespace cortex::test {
namespace {

// Layouts are kept in a folder of the test while it lives.
struct OwnFolder {
    OwnFolder() { qputenv("XDG_CONFIG_HOME", folder.path().toUtf8()); }
    ~OwnFolder() {
        configHome.isNull() ? qunsetenv("XDG_CONFIG_HOME") : qputenv("XDG_CONFIG_HOME", configHome);
    }
    QTemporaryDir folder;
    QByteArray configHome = qgetenv("XDG_CONFIG_HOME");
};

// The layouts of a whole window.
class KeptWindows : private OwnFolder, public Workspaces {
protected:
    KeptWindows() {
        layouts().begin(7);
        QApplication::processEvents();
    }
    LayoutKeeper& layouts() { return window.layouts(); }
    // What the program has saved by itself.
    QJsonObject saved() {
        EXPECT_TRUE(comes([this] {
            layouts().refresh(*session.frame());
            layouts().save();
            return !own().isEmpty();
        }));
        QFile file{QDir{layouts().folder()}.filePath(own().value(0))};
        EXPECT_TRUE(file.open(QIODevice::ReadOnly));
        return QJsonDocument::fromJson(file.readAll()).object()["layout"].toObject();
    }
    QStringList own() { return QDir{layouts().folder(), "domain-7-*.json"}.entryList(QDir::Files); }
    void put(const QString& name, const QJsonObject& layout) {
        ASSERT_EQ(Layouts::write(layouts().folder() + '/' + name, 7, {}, layout), QString{});
    }
    QStringList menuEntries() {
        QMenu menu;
        addLayout(menu, layouts());
        Q_EMIT menu.aboutToShow();
        QStringList all;
        for (const QAction* each : menu.actions()) all << each->text();
        return all;
    }
    static int usualTree() { return Look::units(76); }
};

TEST_F(KeptWindows, SayInTheWindowThatOneIsBrokenAndWhereItIsNow) {
    QFile file{layouts().folder() + "/domain-7-0123456789ab.json"};
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write("{broken");
    file.close();
    MainWindow another{session};
    another.layouts().begin(7);
    another.show();
    ASSERT_TRUE(comes([&] { return another.ready(); }));
    another.refresh();
    auto& notice = another.control().notice();
    const auto says = [&](const QString& text) {
        const auto labels = notice.findChildren<TextLabel*>();
        return notice.isVisible() && std::ranges::any_of(labels, [&](const auto* each) {
                   return each->isVisible() && each->text().contains(text);
               });
    };
    EXPECT_TRUE(says("It was set aside as " + file.fileName() + ".broken."));
    for (auto* each : notice.findChildren<QPushButton*>())
        if (each->text() == "Close") each->click();
    another.refresh();
    EXPECT_FALSE(notice.isVisible()) << "it was read";
    EXPECT_EQ(another.workspace().panes()[0]->count(), 5) << "and the window is as it begins";
}

TEST_F(KeptWindows, KnowThatTheTreeAndTheEventsAreHidden) {
    ASSERT_TRUE(everythingComes());
    press("Ctrl+B");
    press("Ctrl+E");
    const QJsonObject layout = saved();
    EXPECT_FALSE(layout["window"].toObject()["tree"].toBool(true));
    EXPECT_FALSE(layout["events"].toBool(true));
}

TEST_F(KeptWindows, KnowWhichRowsOfTheTreeAreOpen) {
    ASSERT_TRUE(everythingComes());
    auto& rows = *window.tree().findChild<QTreeView*>();
    rows.setCurrentIndex(tree().indexOf("/axis"));
    QTest::keyClick(&rows, Qt::Key_Left);
    EXPECT_EQ(saved()["rows"].toObject()["closed"].toArray(), QJsonArray{"/axis"});
    layouts().reset();
    EXPECT_TRUE(rows.isExpanded(tree().indexOf("/axis")));
}

TEST_F(KeptWindows, ShowHiddenEventsHiddenAfterAStart) {
    put("hidden.json", {{"window", QJsonObject{{"down", QJsonArray{698, 0}}}}, {"events", false}});
    MainWindow another{session};
    another.layouts().begin(7, layouts().folder() + "/hidden.json");
    another.show();
    QApplication::processEvents();
    QApplication::setActiveWindow(&another);
    auto& strip = *another.findChild<EventList*>();
    EXPECT_FALSE(strip.isVisible());

    QTest::keySequence(&another, QKeySequence{"Ctrl+E"});

    EXPECT_TRUE(strip.isVisible());
    EXPECT_GE(strip.height(), Look::units(20)) << "it has its usual height";
}

TEST_F(KeptWindows, BringAHiddenTreeBackWithItsUsualWidth) {
    put("hidden.json", {{"window", QJsonObject{{"across", QJsonArray{0, 1280}}, {"tree", false}}}});
    MainWindow another{session};
    another.layouts().begin(7, layouts().folder() + "/hidden.json");
    another.show();
    QApplication::processEvents();
    QApplication::setActiveWindow(&another);
    EXPECT_FALSE(another.tree().isVisible());

    QTest::keySequence(&another, QKeySequence{"Ctrl+B"});

    EXPECT_TRUE(another.tree().isVisible());
    EXPECT_EQ(another.tree().width(), usualTree());
}

TEST_F(KeptWindows, GiveTheTreeItsUsualWidthWhenTheyAreReset) {
    auto& across = *window.findChild<QSplitter*>();
    across.setSizes({usualTree() + 100, 900});
    press("Ctrl+B");
    press("Ctrl+B");
    EXPECT_EQ(window.tree().width(), usualTree() + 100) << "it has its last width";

    layouts().reset();

    EXPECT_EQ(window.tree().width(), usualTree());
}

TEST_F(KeptWindows, AreNoLargerThanTheScreenAtTheStart) {
    window.resize(99'999, 99'999);
    fitToScreen(window);
    EXPECT_EQ(window.size(), window.screen()->availableSize().expandedTo(window.minimumSize()));
}

TEST_F(KeptWindows, KeepTheSizeWithinTheScreenAndNotTooSmall) {
    window.resize(1100, 720);
    const QSize size = window.size();
    EXPECT_EQ(saved()["size"].toObject()["width"].toInt(), 1100);
    const auto sizeWith = [&](int width, int height) {
        put("size.json", {{"size", QJsonObject{{"width", width}, {"height", height}}}});
        layouts().open(layouts().folder() + "/size.json");
        return window.size();
    };
    EXPECT_EQ(sizeWith(10, 10), window.minimumSize());
    EXPECT_EQ(sizeWith(99'999, 700).width(),
              std::max(window.screen()->availableSize().width(), window.minimumWidth()));
    layouts().goBack();
    layouts().keepSize();
    const QSize before = window.size();
    sizeWith(size.width() - 50, size.height());
    EXPECT_EQ(window.size(), before) << "the command line said it";
}

TEST_F(KeptWindows, AreOpenedAgainMaximised) {
    put("large.json",
        {{"size", QJsonObject{{"width", 900}, {"height", 700}, {"maximised", true}}}});
    layouts().open(layouts().folder() + "/large.json");
    EXPECT_TRUE(window.isMaximized());
    put("small.json", {{"size", QJsonObject{{"width", 900}, {"height", 700}}}});
    layouts().open(layouts().folder() + "/small.json");
    EXPECT_FALSE(window.isMaximized());
}

TEST_F(KeptWindows, ThatHaveANameAreInTheMenu) {
    ASSERT_TRUE(everythingComes());
    EXPECT_EQ(menuEntries().last(), "Open…");
    layouts().saveAs(layouts().folder() + "/my layout");
    window.openTab("/drive");
    saved();

    EXPECT_EQ(menuEntries().last(), "my layout");
    EXPECT_EQ(menuEntries().count("my layout"), 1);
    EXPECT_FALSE(menuEntries().join(' ').contains("domain-7")) << "these are no names";

    QMenu menu;
    addLayout(menu, layouts());
    Q_EMIT menu.aboutToShow();
    menu.actions().last()->trigger();
    EXPECT_FALSE(titles(0).contains("/drive"));
}

TEST_F(KeptWindows, AreSavedAndOpenedInTheirFolderAsJson) {
    QWidget parent;
    auto* menu = new QMenu{&parent};
    addLayout(*menu, layouts());
    for (const char* name : {"Save as…", "Open…"}) {
        for (QAction* each : menu->actions()) {
            if (each->text() == QString{name}) each->trigger();
        }
        auto* dialog = parent.findChild<QFileDialog*>();
        ASSERT_NE(dialog, nullptr) << name;
        EXPECT_EQ(QDir{dialog->directory()}, QDir{layouts().folder()}) << name;
        EXPECT_EQ(dialog->defaultSuffix(), "json") << name;
        delete dialog;
    }
}

}  // namespace
}  // namespace cortex::test
