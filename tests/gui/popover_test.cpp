// SPDX-License-Identifier: Apache-2.0
// Popovers, at the smallest window with the largest text, on a screen of the same size.
#include "gui/made_agent.hpp"
#include "gui/window_fixture.hpp"
#include "style/look.hpp"
#include "window/control_bar.hpp"
#include "window/find_panel.hpp"
#include "window/stop_button.hpp"

#include <QBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScreen>
#include <QScrollBar>
#include <memory>
#include <sstream>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

class PopoverOnASmallScreen : public testing::Test {
protected:
    static void SetUpTestSuite() { session = std::make_unique<Session>(ownNetwork()); }
    static void TearDownTestSuite() { session.reset(); }
    PopoverOnASmallScreen() : window{*session} {
        Look::apply(Theme::Light, 1.5, QStringLiteral("DejaVu Sans"));
        window.resize(800, 600);
        window.show();
        screen = window.screen()->availableGeometry();
    }
    ~PopoverOnASmallScreen() override { Look::apply(Theme::Light, 1, QStringLiteral("Open Sans")); }
    // Partly outside of it, too.
    std::vector<QPoint> corners() const {
        const int right = screen.width() / 2, down = screen.height() / 2;
        return {screen.topLeft(), screen.topLeft() + QPoint{right, 0},
                screen.topLeft() + QPoint{0, down}, screen.topLeft() + QPoint{right, down},
                screen.topLeft() - QPoint{right, down}};
    }
    // Of an agent with a long path, by every agent of so many.
    static std::shared_ptr<Frame> frameOfMany(int count) {
        std::vector<AgentFrame> agents;
        for (int i = 0; i < count; ++i) {
            MadeAgent made{"levelling" + std::to_string(i),
                           [](SimplexTree& tree) { tree.add("/probe", "Probe"); }};
            agents.push_back(made.now());
        }
        return frameOf(std::move(agents));
    }
    // Where it does not lie whole in the screen; empty: it does.
    std::string outside(const QWidget* popover) const {
        if (popover == nullptr || !popover->isVisible()) return "not there";
        const QRect at = popover->frameGeometry();
        if (screen.contains(at)) return {};
        std::ostringstream said;
        said << at.left() << ", " << at.top() << " to " << at.right() << ", " << at.bottom();
        return said.str();
    }
    static bool scrolls(const Popover& popover) {
        const auto bars = popover.findChildren<QScrollBar*>();
        return std::ranges::any_of(bars, [](const QScrollBar* each) {
            return each->orientation() == Qt::Vertical && each->maximum() > 0;
        });
    }

    static inline std::unique_ptr<Session> session;
    MainWindow window;
    QRect screen;
};

TEST_F(PopoverOnASmallScreen, LiesInsideOfItWhereverTheWindowIs) {
    for (const QPoint corner : corners()) {
        window.move(corner);
        QApplication::processEvents();
        window.control().choose("/levelling/platform/hydraulics/left_cell");
        EXPECT_EQ(outside(window.control().panel()), "") << corner.x() << ", " << corner.y();
        delete window.control().panel();
        window.find();
        EXPECT_EQ(outside(window.findPanel()), "") << corner.x() << ", " << corner.y();
        delete window.findPanel();
        auto* handOver = new HandOverPanel{frameOfMany(1), &window};
        handOver->openBelow(window.stopButton());
        EXPECT_EQ(outside(handOver), "") << corner.x() << ", " << corner.y();
        delete handOver;
    }
}

TEST_F(PopoverOnASmallScreen, StaysInsideAndKeepsItsButtonsInSightWhenItsContentGrows) {
    window.move(screen.topLeft());
    auto* panel = new Popover{"Growing", &window};
    auto* content = new QLabel{"one line"};
    auto* button = new QPushButton{"Close"};
    panel->rows().addWidget(content);
    panel->buttons().addWidget(button);
    panel->openBelow(window.control());
    const int before = panel->height();
    for (const int lines : {3, 100}) {
        content->setText(QString{"line\n"}.repeated(lines));
        for (int i = 0; i < 3; ++i) QCoreApplication::sendPostedEvents();
        EXPECT_EQ(outside(panel), "") << lines;
        EXPECT_GT(panel->height(), before) << lines;
        EXPECT_TRUE(panel->rect().contains({button->mapTo(panel, QPoint{}), button->size()}));
    }
    EXPECT_EQ(panel->height(), screen.height());
    EXPECT_TRUE(scrolls(*panel));
    delete panel;
}

TEST_F(PopoverOnASmallScreen, HasASizeOfItsOwnForTakingControlHoweverManyAgentsCome) {
    window.move(screen.topLeft());
    auto* panel = new ControlPanel{frameOfMany(1), "/probe", &window};
    panel->openBelow(window.control());
    const QRect before = panel->geometry();
    EXPECT_EQ(outside(panel), "");
    for (const int agents : {2, 40}) {
        panel->refresh(frameOfMany(agents));
        for (int i = 0; i < 3; ++i) QCoreApplication::sendPostedEvents();
        EXPECT_EQ(panel->geometry(), before) << agents;
    }
    EXPECT_TRUE(scrolls(*panel));
    delete panel;
}

TEST_F(PopoverOnASmallScreen, OpensAboveWhatHasNoRoomBelow) {
    QPushButton low{"low"};
    low.setGeometry(screen.left() + 50, screen.bottom() - 40, 100, 30);
    low.show();
    QApplication::processEvents();
    auto* panel = new ControlPanel{frameOfMany(1), "", &low};
    panel->openBelow(low);
    EXPECT_EQ(panel->geometry().bottom() + 1, low.geometry().top());
    low.move(low.x(), screen.top());
    QApplication::processEvents();
    panel->openBelow(low);
    EXPECT_EQ(panel->geometry().top(), low.geometry().bottom() + 1);
    delete panel;
}

}  // namespace
}  // namespace cortex::test
