// SPDX-License-Identifier: Apache-2.0
// No row moves under the mouse when the window has something to say.
#include "gui/audit.hpp"
#include "gui/controlling.hpp"

#include <QAbstractItemView>
#include <QPushButton>
#include <QTabBar>
#include <array>
#include <map>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

constexpr std::array windowSizes{QSize{800, 600}, QSize{1280, 800}};

class Steady : public Controlling {
protected:
    void showAt(QSize size) {
        window.resize(size);
        window.open("/drive");
        window.openPart("data");
    }
    // Of every tree, table and list, and of every row of tabs, that is seen.
    std::map<QWidget*, QRect> places() {
        window.refresh();
        for (int i = 0; i < 3; ++i) QApplication::processEvents();
        std::map<QWidget*, QRect> all;
        for (auto* each : window.findChildren<QWidget*>()) {
            const bool hasRows = qobject_cast<QAbstractItemView*>(each) != nullptr ||
                                 qobject_cast<QTabBar*>(each) != nullptr;
            if (hasRows && each->isVisible())
                all[each] = {each->mapTo(&window, QPoint{}), each->size()};
        }
        return all;
    }
    std::string findings() { return unreadableIn(window).join('\n').toStdString(); }
};

TEST_F(Steady, NoRowMovesWhenControlIsRefusedAndWhenThatIsClosed) {
    ASSERT_TRUE(everythingComes());
    showAt(windowSizes.front());
    Colleague other;
    ASSERT_TRUE(comes([&] { return other.sees("/drive"); }));
    other.control();
    other.session.takeControl("/drive");
    ASSERT_TRUE(comes([&] { return !other.control().prefix.empty() && says("held by "); }));
    ControlNotice& notice = window.control().notice();
    const auto isRefused = [&] {
        window.control().choose();
        window.control().panel()->choose("/");
        window.control().panel()->takeButton().click();
        return comes([&] { return !other.control().prefix.empty() && !notice.text().isEmpty(); });
    };
    for (const QSize size : windowSizes) {
        showAt(size);
        const auto before = places();
        ASSERT_GE(before.size(), 3U);
        ASSERT_TRUE(isRefused());
        EXPECT_EQ(places(), before) << size.width();
        EXPECT_EQ(findings(), "");
        Q_EMIT notice.closed();
        EXPECT_EQ(notice.text(), "");
        EXPECT_EQ(places(), before) << size.width();
    }
    ASSERT_TRUE(isRefused());
    EXPECT_EQ(unreadableInEverySize(window, [&] { other.control(), window.refresh(); }), "")
        << "who holds it is never cut";
}

TEST_F(Steady, NoRowMovesWhenACommandOfTheLifeCycleIsAnswered) {
    ASSERT_TRUE(everythingComes());
    showAt(windowSizes.front());
    ASSERT_TRUE(takes("/drive"));
    for (const QSize size : windowSizes) {
        showAt(size);
        const auto before = places();
        ASSERT_GE(before.size(), 2U);
        const bool starts = size == windowSizes.front();
        button(starts ? "Startup" : "Shutdown").click();
        EXPECT_EQ(places(), before) << size.width();
        ASSERT_TRUE(comes([&] { return says(starts ? "Startup: Done" : "Shutdown: Done"); }));
        EXPECT_EQ(places(), before) << size.width();
        EXPECT_EQ(findings(), "");
        window.resize(QSize{1280, 800});
        window.open("/controller");
        window.refresh();
    }
}

}  // namespace
}  // namespace cortex::test
