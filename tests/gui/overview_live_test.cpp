// SPDX-License-Identifier: Apache-2.0
// The first page of a window, with real agents over DDS: each row opens its place.
#include "gui/controlling.hpp"
#include "gui/rival.hpp"
#include "gui/workspace_fixture.hpp"
#include "views/agent_view.hpp"
#include "views/event_panel.hpp"
#include "views/event_table.hpp"
#include "views/event_view.hpp"
#include "views/overview_table.hpp"
#include "views/overview_view.hpp"
#include "widgets/link.hpp"
#include "widgets/text_label.hpp"

#include <QLineEdit>
#include <algorithm>
#include <csignal>

namespace cortex::test {
namespace {

class FirstPageLive : public Workspaces {
protected:
    OverviewTable& table(const QString& name) {
        for (auto* each : window.findChildren<OverviewTable*>())
            if (each->accessibleName() == name) return *each;
        throw std::runtime_error{"no such part"};
    }
    bool shows(const QString& part, const QString& text, int column = 0) {
        return comes(
            [&] { return !table(part).findItems(text, Qt::MatchContains, column).empty(); });
    }
    // By keys alone.
    void open(const QString& part, const QString& text, int column = 0) {
        window.openKind("overview");
        QApplication::setActiveWindow(&window);
        auto& rows = table(part);
        rows.setFocus(Qt::TabFocusReason);
        const auto found = rows.findItems(text, Qt::MatchContains, column);
        ASSERT_FALSE(found.empty());
        const auto key = column == 0 ? Qt::Key_Down : Qt::Key_Up;
        while (rows.currentItem() != found.front()) {
            const int before = rows.currentIndex().row();
            QTest::keyClick(&rows, key);
            ASSERT_NE(rows.currentIndex().row(), before);
        }
        QTest::keyClick(&rows, Qt::Key_Return);
    }
};

TEST_F(FirstPageLive, IsInFrontAtTheStartAndEachRowOpensItsPlace) {
    EXPECT_NE(qobject_cast<OverviewView*>(window.current()), nullptr);
    ASSERT_TRUE(everythingComes());
    ASSERT_TRUE(shows("Agents", "mixer"));
    open("Agents", "mixer");
    ASSERT_NE(qobject_cast<AgentView*>(window.current()), nullptr);
    window.openKind("overview");

    const Rival rival{ownNetwork(), true};
    ASSERT_TRUE(shows("What is wrong", "/drive"));
    open("What is wrong", "/drive");
    EXPECT_EQ(window.workspace().path(), "/drive");

    window.openKind("overview");
    session.takeControl("/axis");
    ASSERT_TRUE(shows("Who controls what", "/axis"));
    open("Who controls what", "/axis");
    EXPECT_TRUE(window.workspace().path().starts_with("/axis/"))
        << "the first one below: " << window.workspace().path();
    session.releaseControl();

    window.openKind("overview");  // what is not in sight does not change
    const QString last = "Last commands and losses";
    ASSERT_TRUE(shows(last, "takeControl", 2));
    open(last, "takeControl", 2);
    auto* events = window.current()->findChild<EventTable*>();
    ASSERT_NE(events, nullptr);
    EXPECT_TRUE(comes([&] {  // where many events come at once, it is scrolled again
        const QRect place = events->visualRect(events->currentIndex());
        return events->viewport()->rect().contains(place.topLeft() + QPoint{0, place.height()});
    }));
    EXPECT_TRUE(events->hasFocus());
    const QModelIndex row = events->currentIndex();
    EXPECT_TRUE(row.siblingAtColumn(EventModel::Text).data().toString().contains("takeControl"));
    const auto details = window.current()->findChild<EventPanel*>()->findChildren<TextLabel*>();
    EXPECT_TRUE(std::ranges::any_of(
        details, [](const auto* each) { return each->text().contains("takeControl"); }));
    window.current()->findChild<QLineEdit*>()->setText("no such event");
    open(last, "takeControl", 2);
    EXPECT_EQ(window.current()->findChild<EventTable*>(), nullptr) << "it is hidden there";

    window.openKind("overview");
    agent->end(SIGKILL);
    ASSERT_TRUE(shows("What is wrong", "/mixer"));
    open("What is wrong", "/mixer");
    EXPECT_EQ(window.workspace().path(), "/mixer");
    window.openKind("overview");
    auto* all = window.current()->findChild<Link*>();
    QTest::keyClick(all, Qt::Key_Return);
    EXPECT_NE(qobject_cast<EventView*>(window.current()), nullptr);
}

}  // namespace
}  // namespace cortex::test
