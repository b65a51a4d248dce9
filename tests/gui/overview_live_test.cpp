// SPDX-License-Identifier: Apache-2.0
// The first page of a window, with real agents over DDS: each row opens its place.
#include "gui/controlling.hpp"
#include "gui/rival.hpp"
#include "gui/workspace_fixture.hpp"
#include "views/agent_view.hpp"
#include "views/event_view.hpp"
#include "views/overview_table.hpp"
#include "views/overview_view.hpp"
#include "widgets/link.hpp"

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
    bool shows(const QString& part, const QString& text) {
        return comes([&] { return !table(part).findItems(text, Qt::MatchContains, 0).empty(); });
    }
    // By keys alone.
    void open(const QString& part, const QString& text) {
        window.openKind("overview");
        QApplication::setActiveWindow(&window);
        auto& rows = table(part);
        rows.setFocus(Qt::TabFocusReason);
        const auto found = rows.findItems(text, Qt::MatchContains, 0);
        ASSERT_FALSE(found.empty());
        while (rows.currentItem() != found.front()) {
            const int before = rows.currentIndex().row();
            QTest::keyClick(&rows, Qt::Key_Down);
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
