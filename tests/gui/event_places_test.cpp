// SPDX-License-Identifier: Apache-2.0
// Nothing moves in the views of events when something comes.
#include "gui/event_views.hpp"

#include <QMenu>
#include <QToolButton>
#include <map>

namespace cortex::test {
namespace {

TEST_F(Events, NoButtonOfTheStripMovesWhenAnotherComes) {
    events.add(changes(1, 200));
    ASSERT_TRUE(isAtTheEnd(rows()));
    shown.search("in:/drives");
    QApplication::processEvents();
    const auto* all = buttonIn(list, "Show all");
    ASSERT_NE(all, nullptr);
    const QRect place = all->geometry();
    scrollUp(rows());
    events.add(changes(201, 3));
    events.add({eventOf(204, "fault", "/a", "broken", Severity::Error)});
    QApplication::processEvents();
    EXPECT_EQ(all->geometry(), place);
    const auto* fresh = buttonIn(list, "3 new");
    ASSERT_NE(fresh, nullptr);
    const QPoint end = fresh->geometry().topRight();
    events.add(changes(205, 3'000));
    shown.search({});
    QApplication::processEvents();
    EXPECT_FALSE(all->isVisible());
    EXPECT_EQ(fresh->geometry().topRight(), end) << "its place is kept free";
}

// One of each kind that the program knows, and some of others.
std::vector<comms::AgentEvent> allKinds(std::uint64_t first) {
    std::vector<comms::AgentEvent> all;
    for (int kind = 0; kind <= static_cast<int>(EventKind::ValueChange); ++kind)
        all.push_back(eventOf(first++, name(static_cast<EventKind>(kind)), "/a", "something"));
    for (const char* kind : {"agent lost", "agent heard", "of a later program"})
        all.push_back(eventOf(first++, kind, "/a", "something"));
    return all;
}

TEST_F(EventTab, NoRowAndNoChipMovesWhenKindsComeAndCountsGrow) {
    const auto placesOfChips = [this] {
        for (int i = 0; i < 3; ++i)
            QApplication::processEvents();  // what is laid out lays out more
        std::map<Chip*, QRect> all;
        for (auto* each : view.findChildren<Chip*>())
            if (each->isVisible()) all[each] = each->geometry();
        return all;
    };
    events.add(changes(1, 3));
    view.refresh();
    for (const QSize size : {QSize{1000, 600}, QSize{700, 300}}) {
        view.resize(size);
        const auto chips = placesOfChips();
        const QRect place = table().geometry();
        ASSERT_GE(chips.size(), 3U);
        events.add(allKinds(1'000));
        events.add(changes(2'000, 200));
        view.refresh();
        const auto later = placesOfChips();
        EXPECT_EQ(table().geometry(), place) << size.width();
        for (const auto& [each, before] : chips)
            EXPECT_EQ(later.count(each) ? later.at(each) : QRect{}, before)
                << each->accessibleName().toStdString();
    }
}

TEST_F(EventTab, AChipSaysWhatItsKindTells) {
    view.resize(1600, 600);
    events.add(allKinds(1));
    view.refresh();
    std::map<QString, QString> tips;
    for (const auto* each : view.findChildren<Chip*>())
        tips[each->accessibleName().section(' ', 0, 0)] = each->toolTip().replace('\n', ' ');
    EXPECT_EQ(tips["limit"],
              "A value was beyond its limits. A demand was cut to them. Hides these");
    EXPECT_TRUE(tips["overflow"].startsWith("The loop of an agent did not keep its time"));
    EXPECT_TRUE(tips["watchdog"].startsWith("The loop of an agent stands still"));
    EXPECT_EQ(tips["of"], "Hides these") << "of a later program nothing is known";
}

TEST_F(EventTab, NoChipBecomesWiderUnderThePointer) {
    events.add(changes(1, 3));
    view.refresh();
    auto* chips = chip("info 3")->parentWidget();
    const QRect place = chip("state change 3")->geometry();
    QEvent enter{QEvent::Enter}, leave{QEvent::Leave};
    QApplication::sendEvent(chips, &enter);
    chips->setAttribute(Qt::WA_UnderMouse);
    events.add(changes(4, 1'500));
    view.refresh();
    EXPECT_EQ(chip("state change 1,503")->geometry(), place);
    chips->setAttribute(Qt::WA_UnderMouse, false);
    view.refresh();
    EXPECT_GT(chip("state change 1,503")->width(), place.width());
}

TEST_F(EventTab, AKindWithoutRoomIsBehindAButtonAndSwitchedThere) {
    view.resize(500, 300);
    events.add(allKinds(1));
    view.refresh();
    auto* more = view.findChild<QToolButton*>();
    ASSERT_TRUE(more->isVisible());
    EXPECT_TRUE(more->text().contains("more")) << more->text().toStdString();
    more->click();
    const auto* menu = more->parentWidget()->findChild<QMenu*>();
    ASSERT_NE(menu, nullptr);
    QAction* last = menu->actions().back();
    EXPECT_EQ(last->text(), "of a later program 1");
    last->trigger();
    view.refresh();
    EXPECT_FALSE(shown.shows(std::string{"of a later program"}));
}

TEST_F(EventTab, NoRowMovesWhenTheFilterIsWrongOrDetailsCome) {
    comms::AgentEvent windows = eventOf(0, "agent lost", "", "robot is not heard");
    events.add({windows});
    events.add(changes(1, 100));
    view.refresh();
    ASSERT_TRUE(isAtTheEnd(table()));
    const QRect place = table().geometry();
    type("nonsense:1");
    QApplication::processEvents();
    EXPECT_EQ(table().geometry(), place);
    EXPECT_TRUE(says(view, "\"nonsense:\" is no field."));
    type("");
    for (const int row : {50, 0}) {  // 0: without a path
        table().setCurrentIndex(table().model()->index(row, 0));
        view.refresh();
        QApplication::processEvents();
        EXPECT_EQ(table().geometry(), place) << row;
    }
}

}  // namespace
}  // namespace cortex::test
