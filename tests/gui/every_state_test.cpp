// SPDX-License-Identifier: Apache-2.0
// Whatever state a simplex, its agent and control are in: nothing moves, and six rows of data are
// seen, also in the smallest window with the largest text.
#include "gui/made_agent.hpp"
#include "gui/window_fixture.hpp"
#include "model/item_model.hpp"
#include "style/look.hpp"
#include "views/base_view.hpp"
#include "views/edit_bar.hpp"
#include "views/message_area.hpp"
#include "widgets/item_table.hpp"
#include "widgets/link.hpp"
#include "widgets/popover.hpp"
#include "widgets/text_label.hpp"
#include "window/control_bar.hpp"
#include "window/control_notice.hpp"
#include "window/main_window.hpp"

#include <QAbstractButton>
#include <QPushButton>
#include <QTabBar>
#include <QVBoxLayout>
#include <array>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace cortex::gui;

const std::string wordyFault =
    "axis 4 does not follow its demand: it is 0.0524 rad behind, and at most 0.0500 rad are "
    "allowed; its brake is closed";

class EveryState : public testing::Test {
protected:
    EveryState() {
        Look::apply(Theme::Light, 1.5, QStringLiteral("Open Sans"));
        window.resize(800, 600);
        window.show();
        window.open("/drive");
        window.openPart("data");
    }
    ~EveryState() override { Look::apply(Theme::Light, 1, QStringLiteral("Open Sans")); }

    BaseView& page() { return *qobject_cast<BaseView*>(window.current()); }
    ItemTable& table() { return *page().findChild<ItemTable*>(); }
    // No event of a timer is taken, so the window does not look for agents of its own.
    void show(const std::shared_ptr<Frame>& frame) {
        for (int i = 0; i < 3; ++i) {
            page().refresh(frame);
            QCoreApplication::sendPostedEvents();
        }
    }
    std::shared_ptr<Frame> now(const std::string& state = "running") {
        return frameOf({robot.now(state)});
    }
    // Each change is on top of those before it; so all of it is there at the end.
    struct State {
        std::string name;
        std::function<std::shared_ptr<Frame>()> make;
    };
    std::vector<State> states() {
        return {
            {"Standby", [this] { return now(); }},
            {"an entry", [this] { return enters("dampingRatio", "0.75"), now(); }},
            {"Active", [this] { return robot.put("/drive", "state", std::int64_t{2}), now(); }},
            {"a refusal", [this] { return refuse(), now(); }},
            {"what became of a stop", [this] { return stop(), now(); }},
            {"stale", [this] { return robot.degrade("/drive", Quality::Stale, "/hold"), now(); }},
            {"Fault", [this] { return fault(), now(); }},
            {"a standstill", [this] { return standstill(now()); }},
            {"two owners", [this] { return contest(now()); }},
            {"lost", [this] { return contest(now("lost")); }},
        };
    }
    void enters(const QString& item, const QString& text) {
        auto& rows = *table().model();
        for (int row = 0; row < rows.rowCount(rows.index(0, 0)); ++row) {
            const QModelIndex name = rows.index(row, ItemModel::Name, rows.index(0, 0));
            if (name.data() == item) rows.setData(name.siblingAtColumn(ItemModel::Value), text);
        }
    }
    void refuse() {
        window.control().notice().show(
            "Control of / was not taken. robot: colleague@desk.14105-2501a1 holds /drive, and must "
            "release it or hand it over.",
            "Take /drive again");
    }
    void stop() {
        window.control().notice().tell(
            "Stopped: 3 of 4 of /drive in 0.4 s; Not reached: station, 12:00:01 UTC",
            "Start these 3 again");
    }
    void fault() {
        robot.put("/drive", "state", std::int64_t{4});
        robot.put("/drive", "faultCode", std::int64_t{-7});
        robot.put("/drive", "faultText", wordyFault);
    }
    static std::shared_ptr<Frame> standstill(std::shared_ptr<Frame> frame) {
        frame->agents[0].status.standstill = "has stood still for 12 s in stateActive of /drive";
        return frame;
    }
    static std::shared_ptr<Frame> contest(std::shared_ptr<Frame> frame) {
        frame->contested = {{"/drive",
                             {"robot", "station"},
                             "robot",
                             "which was there first",
                             "/drive is claimed by robot and station; robot has it, which was "
                             "there first"}};
        return frame;
    }
    // Those that are whole, with the titles of groups, and not below what lies over them.
    int rowsSeen() {
        const QRect over =
            window.control().notice().isVisible() ? window.control().notice().geometry() : QRect{};
        int count = 0;
        for (QModelIndex row = table().model()->index(0, 0); row.isValid();
             row = table().indexBelow(row)) {
            const QRect box = table().visualRect(row);
            const QRect at{table().viewport()->mapTo(&window, box.topLeft()), box.size()};
            const bool whole = box.height() > 0 && box.bottom() < table().viewport()->height();
            count += whole && !over.intersects(at) ? 1 : 0;
        }
        return count;
    }
    // Of what the mouse can press: buttons, tabs and rows.
    std::string places() {
        std::string all;
        const auto note = [&](const QString& name, const QWidget& each, const QRect& box) {
            const QPoint at = each.mapTo(&window, box.topLeft());
            all += QStringLiteral("%1 at %2,%3 %4x%5\n")
                       .arg(name)
                       .arg(at.x())
                       .arg(at.y())
                       .arg(box.width())
                       .arg(box.height())
                       .toStdString();
        };
        for (auto* each : window.findChildren<QTabBar*>())
            for (int tab = 0; tab < each->count(); ++tab)
                if (each->isVisible()) note(each->tabText(tab), *each, each->tabRect(tab));
        for (auto* each : page().findChildren<QPushButton*>())
            if (each->isVisible() && !page().findChild<EditBar*>()->isAncestorOf(each) &&
                each->text() != "Dismiss")
                note(each->text(), *each, each->rect());
        QModelIndex row = table().model()->index(0, 0);
        for (int i = 0; i < 6; ++i, row = table().indexBelow(row))
            note(row.data().toString(), *table().viewport(), table().visualRect(row));
        return all;
    }

    MadeAgent robot{"robot",
                    [](SimplexTree& tree) {
                        Simplex& drive = tree.add("/drive", "SimulatedAxis");
                        Simplex& hold = tree.add("/hold", "HoldAxisController");
                        Simplex& demand = tree.add("/demand", "RotaryAxisConcept");
                        Simplex& seen = tree.add("/seen", "RotaryAxisConcept");
                        tree.relate(drive, "demand", demand);
                        tree.relate(drive, "observation", seen);
                        tree.relate(hold, "axes", seen);
                        tree.relate(hold, "demands", demand);
                    },
                    TypeModel::load(CORTEX_SOURCE_DIR "/ontology/robotics-morphology.xml")};
    Session session{ownNetwork()};
    MainWindow window{session};
};

TEST_F(EveryState, SixRowsAreSeenAndNothingMoves) {
    for (const char* family : {"Open Sans", "DejaVu Sans"}) {
        Look::apply(Theme::Light, 1.5, QLatin1String{family});
        robot.put("/drive", "state", std::int64_t{0});
        window.control().notice().show({}, {});
        window.control().notice().tell({});
        show(now());
        const auto before = places();
        for (const State& each : states()) {
            show(each.make());
            EXPECT_GE(rowsSeen(), 7)
                << family << ": " << each.name << ", with the title of a group";
            EXPECT_EQ(places(), before) << family << ": " << each.name;
            EXPECT_FALSE(table().isColumnHidden(ItemModel::Remark)) << "marks stand in it";
        }
    }
}

TEST_F(EveryState, NothingMovesInALargeWindow) {
    for (const QSize size : {QSize{1280, 800}, QSize{1024, 768}, QSize{1920, 1080}}) {
        Look::apply(Theme::Light, 1, QStringLiteral("DejaVu Sans"));
        window.resize(size);
        robot.put("/drive", "state", std::int64_t{0});
        show(now());
        const auto before = places();
        for (const State& each : states()) {
            show(each.make());
            EXPECT_EQ(places(), before) << size.width() << ": " << each.name;
        }
    }
}

TEST_F(EveryState, AWindowThatWasSmallHasItsPlacesAgain) {
    const auto is = [this](QSize size, double scale) {
        Look::apply(Theme::Light, scale, QStringLiteral("Open Sans"));
        window.resize(size);
        show(now());
        return places();
    };
    const std::string large = is({1280, 800}, 1), small = is({800, 600}, 1.5);
    EXPECT_EQ(is({1280, 800}, 1), large);
    EXPECT_EQ(is({800, 600}, 1.5), small);
}

TEST_F(EveryState, TheReasonsOfOneAreNotSaidOfAnother) {
    show(now());
    const auto says = [this](const char* text) {
        for (const auto* each : page().findChildren<TextLabel*>())
            if (each->isVisible() && each->text().contains(text)) return true;
        return false;
    };
    ASSERT_TRUE(says("Startup: "));
    window.open("/demand");
    show(now());
    EXPECT_FALSE(says("Startup: "));
}

// All texts of labels that are seen and have them whole.
QStringList wholeTexts(const QWidget& parent) {
    QStringList all;
    for (const auto* each : parent.findChildren<TextLabel*>())
        if (each->isVisible() && each->height() >= each->heightForWidth(each->width()))
            all << each->text();
    return all;
}

TEST_F(EveryState, WhatHasNoRoomIsCountedAndOpensWhole) {
    for (const State& each : states()) show(each.make());
    fault();
    show(standstill(now()));
    auto& area = *page().findChild<MessageArea*>();
    QList<Link*> links;
    for (auto* each : area.findChildren<Link*>())
        if (!each->text().isEmpty()) links << each;  // the other one lies over the first message
    ASSERT_EQ(links.size(), 1);
    ASSERT_TRUE(links[0]->isVisible());
    EXPECT_TRUE(links[0]->text().endsWith(" more"));
    links[0]->click();
    const auto* popover = area.findChild<Popover*>();
    ASSERT_NE(popover, nullptr);
    const QString all = wholeTexts(*popover).join('\n');
    EXPECT_TRUE(all.contains("does not follow its demand")) << all.toStdString();
    EXPECT_TRUE(all.contains("has stood still for 12 s")) << all.toStdString();
    EXPECT_TRUE(all.contains("Startup: needs Standby")) << all.toStdString();
}

TEST(Notice, ItsButtonsStayWhateverIsSaidAndWhatWasClosedStaysClosed) {
    QWidget window;
    auto* rows = new QVBoxLayout{&window};
    auto* notice = new ControlNotice;
    rows->addWidget(&notice->place());
    rows->addStretch(1);
    notice->setParent(&window);
    window.resize(800, 900);
    window.show();
    const auto button = [&](const char* text) {
        for (auto* each : notice->findChildren<QPushButton*>())
            if (each->text() == text) return each;
        return static_cast<QPushButton*>(nullptr);
    };
    const auto place = [&] {
        QCoreApplication::sendPostedEvents();
        return button("Close")->mapTo(&window, QPoint{});
    };
    notice->show("Control was lost.", {});
    const QPoint close = place();
    notice->show(QString{40, 'x'} + QString{" and much more"}.repeated(20), "Take /drive again");
    EXPECT_EQ(place(), close);
    notice->tell("Stopped: 3 of 4; Not reached: station");
    EXPECT_EQ(place(), close);
    button("Close")->click();
    notice->show({}, {});
    EXPECT_TRUE(notice->isHidden());
    notice->show("Control was lost.", {});
    button("Close")->click();
    notice->tell("Stopped: 3 of 4; Not reached: station");  // as in each frame
    notice->show({}, {});
    EXPECT_TRUE(notice->isHidden()) << "it was closed before";
}

// In a window that keeps a place for it, or in a low one.
struct Noticing : testing::Test {
    void showAt(int height) {
        auto* rows = new QVBoxLayout{&window};
        rows->addWidget(&notice->place());
        rows->addStretch(1);
        rows->setContentsMargins(0, 0, 0, 0);
        notice->setParent(&window);
        window.resize(800, height);
        window.show();
        settle();
    }
    static void settle() {
        for (int i = 0; i < 3; ++i) QCoreApplication::sendPostedEvents();
    }
    std::vector<QWidget*> parts() {
        std::vector<QWidget*> seen;
        for (auto* each : notice->findChildren<QWidget*>())
            if (!each->isHidden()) seen.push_back(each);
        return seen;
    }
    QPushButton* close() {
        for (auto* each : notice->findChildren<QPushButton*>())
            if (each->text() == "Close") return each;
        return nullptr;
    }
    bool isHit(const QWidget& widget) {
        return window.childAt(widget.mapTo(&window, widget.rect().center())) == &widget;
    }

    QWidget window;
    ControlNotice* notice = new ControlNotice;
};

TEST_F(Noticing, AllThatStandsInItIsInsideAndNothingLiesOverAnother) {
    showAt(900);
    const QString path = "/levelling/platform/hydraulics/left_cell/valves/proportional/second";
    for (const int height : {900, 300}) {
        window.resize(800, height);
        for (const char* refusal : {"", "Refuse"}) {
            notice->show("colleague@desk.14105-2501a1 holds " + path, "Take " + path, refusal);
            notice->tell("1 of 3 Active again; " + path + " did not start", "Start these 2 again");
            settle();
            const auto seen = parts();
            ASSERT_EQ(seen.size(), 5U);
            for (const auto* each : seen) {
                EXPECT_TRUE(notice->rect().contains(each->geometry()));
                EXPECT_GE(each->width(), 60);
                EXPECT_EQ(
                    std::ranges::count_if(seen,
                                          [&](const auto* other) {
                                              return other->geometry().intersects(each->geometry());
                                          }),
                    1);
            }
        }
    }
    EXPECT_TRUE(notice->remedy().toolTip().contains(path)) << "it is cut";
}

TEST_F(Noticing, BothTextsHaveTheWholeWidthWhereTheyDoNotFitBesideOneAnother) {
    showAt(900);
    window.resize(1280, 900);
    const QString outcome{"22 of 25 in Standby, 10.4 s; Not reached: operator, 12:05:20 UTC; "};
    const QString loss{"operator is not heard: control of it was lost, and nothing stops it; "};
    notice->show(loss, "Take again");
    notice->tell("All 3 in Standby", "Start these 3 again");
    settle();
    EXPECT_EQ(notice->height(), notice->place().height()) << "both are short";
    notice->show(loss.chopped(2), "Take again");
    notice->tell(outcome.chopped(2), "Start these 22 again");
    settle();
    EXPECT_EQ(notice->height(), notice->place().height()) << "a line each";
    notice->show(loss.repeated(2), "Take again");
    notice->tell(outcome.repeated(2), "Start these 22 again");
    for (const int width : {800, 900, 1024, 1280}) {
        window.resize(width, 900);
        settle();
        EXPECT_LE(notice->height(), 2 * notice->place().height()) << width;
    }
}

TEST_F(Noticing, NoOtherButtonEverStandsInThePlaceOfClose) {
    showAt(900);
    notice->show("alice asks for /drive.", "Hand over");
    ASSERT_FALSE(close()->isHidden());
    const int left = close()->geometry().left();
    notice->show("alice asks for /drive.", "Hand over", "Refuse");
    EXPECT_TRUE(close()->isHidden());
    EXPECT_LT(notice->refuse().geometry().right(), left);
    notice->tell("All 3 in Standby", "Start these 3 again");
    EXPECT_LT(notice->againButton().geometry().right(), left);
    notice->tell({});
    notice->show({}, {});
    EXPECT_TRUE(notice->isHidden());
}

TEST_F(Noticing, WhatIsOfferedBesideAnOutcomeGoesWithIt) {
    showAt(900);
    notice->tell("All 3 in Standby", "Start these 3 again");
    EXPECT_FALSE(notice->againButton().isHidden());
    close()->click();
    notice->tell("All 3 in Standby", "Start these 3 again");  // as in each frame
    EXPECT_TRUE(notice->againButton().isHidden());
    notice->tell("2 in Standby", "Start these 2 again");
    EXPECT_FALSE(notice->againButton().isHidden());
    notice->tell("All 2 Active again");
    EXPECT_TRUE(notice->againButton().isHidden());
}

TEST_F(Noticing, LetsTheMouseThroughAgainWhenAButtonChangesButNotWhenATextDoes) {
    showAt(900);
    notice->tell("All 3 in Standby", "Start these 3 again");
    ASSERT_TRUE(comes([this] { return isHit(notice->againButton()); }));
    notice->show("Control was lost.", {});
    EXPECT_TRUE(isHit(notice->againButton())) << "no button has changed";
    notice->tell("All 3 in Standby", "Start these 2 again");
    EXPECT_FALSE(isHit(notice->againButton()));
    ASSERT_TRUE(comes([this] { return isHit(notice->againButton()); }));
    notice->show("Control was lost.", "Take / again");
    EXPECT_FALSE(isHit(notice->remedy()));
}

TEST(Notice, LetsTheMouseThroughToWhatItLiesOverUntilItWasSeen) {
    QWidget window;
    auto* rows = new QVBoxLayout{&window};
    auto* notice = new ControlNotice;
    auto* below = new QPushButton{"below"};
    rows->addWidget(&notice->place());
    rows->addWidget(below);
    rows->addStretch(1);
    notice->setParent(&window);
    rows->setContentsMargins(0, 0, 0, 0);
    window.resize(800, 300);  // a low one keeps no place
    window.show();
    QCoreApplication::sendPostedEvents();
    const auto hit = [&] { return window.childAt(below->geometry().center()); };
    notice->show("It was refused.", "Take / again");
    ASSERT_TRUE(notice->geometry().contains(below->geometry().center()));
    EXPECT_EQ(hit(), below);
    EXPECT_TRUE(comes([&] { return hit() != below; }));
    notice->show({}, {});
    EXPECT_EQ(hit(), below);
}

}  // namespace
}  // namespace cortex::test
