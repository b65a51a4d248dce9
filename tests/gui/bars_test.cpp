// SPDX-License-Identifier: Apache-2.0
// The bars at the top and at the bottom: nothing that arrives moves a button of theirs.
#include "gui/made_agent.hpp"
#include "gui/window_fixture.hpp"
#include "model/abnormal.hpp"
#include "style/look.hpp"
#include "widgets/link.hpp"
#include "widgets/text_label.hpp"
#include "window/control_bar.hpp"
#include "window/control_notice.hpp"
#include "window/status_bar.hpp"
#include "window/stop_button.hpp"
#include "window/top_bar.hpp"

#include <QAbstractButton>
#include <QPushButton>
#include <map>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

// Made by hand: what control says, in a bar of its own.
class Bars : public testing::Test {
protected:
    struct Said {
        const char* what;
        std::vector<comms::LeaseClient::Lease> held;
        std::vector<std::string> claims;
        std::string asks, notice;
    };

    void show(const Said& said) {
        const auto frame = frameOf({left.now(), right.now()});
        frame->control.held = said.held;
        frame->control.prefix = said.held.empty() ? "" : said.held.front().prefix;
        frame->control.claims = said.claims;
        frame->control.asks = said.asks;
        frame->control.notice = said.notice;
        control->refresh(frame, "");
        stop->refresh(*frame, {});
        for (int i = 0; i < 3; ++i) QApplication::processEvents();
    }
    void showBar(int width, bool narrow) {
        bar.resize(width, Look::units(11));
        bar.setNarrow(narrow);
        host.resize(bar.size());
        host.show();
    }
    QRect placeOf(const QWidget& widget) {
        return widget.isVisible() ? QRect{widget.mapTo(&bar, QPoint{}), widget.size()} : QRect{};
    }
    QRect controlButton() {
        for (const auto* each : control->findChildren<QPushButton*>()) {
            if (each->text() == "Release" || each->text() == "Take control…") return placeOf(*each);
        }
        return {};
    }

    MadeAgent left{"left", [](SimplexTree& tree) { tree.add("/a", "Probe"); }};
    MadeAgent right{"robotics", [](SimplexTree& tree) { tree.add("/b", "Probe"); }};
    Session session{ownNetwork()};
    ControlBar* control = new ControlBar{session};
    StopButton* stop = new StopButton{session};
    QWidget host;
    TopBar bar{*control, *stop, &host};
};

TEST_F(Bars, KeepTheirButtonsInPlaceWhateverIsSaidOfControl) {
    const std::vector<Said> all{
        {"nothing", {}, {}, {}, {}},
        {"asked", {}, {}, "/a", {}},
        {"everything", {{"left", "/", 1}, {"robotics", "/", 1}}, {"/"}, {}, {}},
        {"a part of it", {{"left", "/", 1}}, {"/"}, {}, "Control of / of robotics was lost."},
        {"two", {{"left", "/a", 1}, {"robotics", "/b", 1}}, {"/a", "/b"}, {}, {}},
        {"lost", {}, {"/"}, {}, "Control of / was lost."},
        {"refused", {}, {}, {}, "Control of /a was not taken."},
    };
    const Said longer{
        "long", {{"left", "/levelling/platform/hydraulics/left_cell/valves", 1}}, {}, {}, {}};
    for (const int width : {800, 1024, 1280, 1920}) {
        showBar(width, width < 1024);
        show(all.front());
        const QRect menu = placeOf(bar.menuButton()), find = placeOf(bar.findButton()),
                    stopAt = placeOf(*stop), button = controlButton();
        ASSERT_FALSE(find.isEmpty()) << width;
        ASSERT_FALSE(button.isEmpty());
        for (const Said& each : all) {
            show(each);
            EXPECT_EQ(placeOf(bar.menuButton()), menu) << width << each.what;
            EXPECT_EQ(placeOf(bar.findButton()), find) << width << each.what;
            EXPECT_EQ(placeOf(*stop), stopAt) << width << each.what;
            EXPECT_EQ(controlButton(), button) << width << each.what;
        }
        show(longer);
        EXPECT_EQ(placeOf(*stop), stopAt) << width;
        EXPECT_EQ(controlButton().right(), button.right()) << width;
    }
}

class Counted : public testing::Test {
protected:
    ~Counted() override { Look::apply(Theme::Light, 1, QStringLiteral("Open Sans")); }
    // With so many of its simplexes in Fault, and so many that are lost.
    void show(int faults, int lost) {
        MadeAgent robot{"robot", fillWith(faults + 1)}, away{"away", fillWith(lost)};
        for (int i = 0; i < faults; ++i) {
            robot.put("/p" + std::to_string(i), "state", std::int64_t{4});
        }
        std::vector<AgentFrame> agents{robot.now()};
        if (lost > 0) agents.push_back(away.now("lost"));
        const auto frame = frameOf(std::move(agents));
        frame->domain = 142;
        Abnormal abnormal;
        abnormal.update(*frame);
        for (int i = 0; i < 3; ++i) {
            bar.refresh(*frame, abnormal);
            QApplication::processEvents();
        }
    }
    static MadeAgent::Fill fillWith(int count) {
        return [count](SimplexTree& tree) {
            for (int i = 0; i < count; ++i) tree.add("/p" + std::to_string(i), "Probe");
        };
    }
    std::map<QWidget*, QRect> counters() {
        std::map<QWidget*, QRect> places;
        for (auto* each : bar.findChildren<QAbstractButton*>()) {
            if (qobject_cast<Link*>(each) == nullptr) places[each] = each->geometry();
        }
        return places;
    }
    QStringList texts() {
        QStringList all;
        for (const auto* each : bar.findChildren<QAbstractButton*>()) all << each->text();
        return all;
    }

    StatusBar bar;
};

TEST_F(Counted, NothingMovesWhenTheirNumbersGetMoreDigits) {
    bar.resize(1280, 30);
    bar.show();
    show(0, 0);
    const auto before = counters();
    ASSERT_EQ(before.size(), 3U);
    for (const int count : {1, 10, 100}) {
        show(count, count);
        EXPECT_TRUE(texts().contains(QString{"%1 lost"}.arg(count)));
        EXPECT_EQ(counters(), before) << count;
    }
}

TEST_F(Counted, WhatHasNoRoomBesideThemIsLeftOutAndNotCut) {
    for (const char* family : {"DejaVu Sans", "Open Sans"}) {
        Look::apply(Theme::Light, 1.5, QLatin1String{family});
        bar.resize(800, 40);
        bar.show();
        for (const int count : {0, 100, 1000}) {
            if (count == 1000) bar.resize(720, 40);
            show(count, count);
            for (const auto* each : bar.findChildren<QWidget*>()) {
                if (!each->isVisible()) continue;
                EXPECT_GE(each->width(), each->sizeHint().width()) << family << count;
                EXPECT_LE(each->geometry().right(), bar.width()) << family << count;
            }
        }
    }
}

}  // namespace
}  // namespace cortex::test
