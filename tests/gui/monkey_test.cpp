// SPDX-License-Identifier: Apache-2.0
// Random keys and clicks while the agent that is looked at dies and comes back.
#include "gui/window_fixture.hpp"
#include "style/look.hpp"

#include <QAbstractItemView>
#include <QApplication>
#include <QMenu>
#include <QTimer>
#include <array>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <map>
#include <memory>
#include <random>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace cortex::gui;

constexpr std::array keys{
    Qt::Key_Tab,    Qt::Key_Backtab, Qt::Key_Up,    Qt::Key_Down,     Qt::Key_Left, Qt::Key_Right,
    Qt::Key_Return, Qt::Key_Escape,  Qt::Key_Space, Qt::Key_PageDown, Qt::Key_Home, Qt::Key_End,
    Qt::Key_A,      Qt::Key_Period,  Qt::Key_Slash, Qt::Key_1,        Qt::Key_F2,   Qt::Key_F6,
    Qt::Key_F8,     Qt::Key_F1,      Qt::Key_F12,   Qt::Key_Delete,   Qt::Key_Minus};
// With Ctrl; not Ctrl+Q or the like, as the window is to stay.
constexpr std::array ctrlKeys{Qt::Key_F, Qt::Key_B,      Qt::Key_E,   Qt::Key_W, Qt::Key_T,
                              Qt::Key_1, Qt::Key_2,      Qt::Key_3,   Qt::Key_4, Qt::Key_0,
                              Qt::Key_Z, Qt::Key_Return, Qt::Key_Plus};

int numberFrom(const char* variable, int otherwise) {
    const char* given = std::getenv(variable);
    return given != nullptr ? std::atoi(given) : otherwise;
}

class Monkey : public Window {
protected:
    // Its keys change the size of texts of all windows.
    ~Monkey() override { Look::apply(Theme::Light, 1, QStringLiteral("Open Sans")); }
    template <class Choices>
    auto any(const Choices& choices) {
        return choices[random() % choices.size()];
    }
    // Whatever would get the next key: a popover, a menu, a question, the window.
    QWidget& target() {
        if (QWidget* popup = QApplication::activePopupWidget()) return *popup;
        if (QWidget* modal = QApplication::activeModalWidget()) return *modal;
        return window;
    }
    void press() {
        QWidget* focus = QApplication::focusWidget();
        QWidget& to = focus != nullptr && target().isAncestorOf(focus) ? *focus : target();
        if (random() % 4 == 0)
            QTest::keyClick(&to, any(ctrlKeys), Qt::ControlModifier);
        else
            QTest::keyClick(&to, any(keys));
    }
    void click() {
        QWidget& area = target();
        const QPoint place{static_cast<int>(random() % static_cast<unsigned>(area.width())),
                           static_cast<int>(random() % static_cast<unsigned>(area.height()))};
        QWidget* hit = area.childAt(place);
        if (hit == nullptr) hit = &area;
        QTest::mouseClick(hit, Qt::LeftButton, Qt::NoModifier, hit->mapFrom(&area, place));
    }
    // Every model of ours that a view shows holds what Qt asks of models, from when it is first
    // seen. That of a QTreeWidget, which is Qt's own, does not.
    void watchModels() {
        for (auto* view : window.findChildren<QAbstractItemView*>()) {
            QAbstractItemModel* model = view->model();
            if (model == nullptr || testers_.contains(model)) continue;
            if (QByteArray{model->metaObject()->className()}.startsWith('Q')) continue;
            connectEnd(model);
            testers_[model] = std::make_unique<QAbstractItemModelTester>(
                model, QAbstractItemModelTester::FailureReportingMode::Fatal);
        }
    }
    void connectEnd(QAbstractItemModel* model) {
        QObject::connect(model, &QObject::destroyed, &watching_,
                         [this, model] { testers_.erase(model); });
    }

    // The same at each run, unless another is given.
    const unsigned seed = static_cast<unsigned>(numberFrom("CORTEX_SEED", 1));
    std::mt19937 random{seed};
    std::map<QAbstractItemModel*, std::unique_ptr<QAbstractItemModelTester>> testers_;
    QObject watching_;  // ends before them
};

TEST_F(Monkey, LeavesTheWindowWorking) {
    ASSERT_TRUE(everythingComes());
    std::cout << "seed " << seed << '\n';
    const int steps = numberFrom("CORTEX_MONKEY_STEPS", 1000), life = steps / 10;
    // What waits for an answer, such as a menu or the choice of a file, gets none.
    QTimer dismiss;
    QObject::connect(&dismiss, &QTimer::timeout, [this] {
        QWidget* modal = QApplication::activeModalWidget();
        if (modal != nullptr && modal != &window) modal->close();
        if (auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget())) menu->close();
    });
    dismiss.start(20);
    QApplication::setActiveWindow(&window);
    window.open("/drive");
    bool there = true;
    for (int i = 0; i < steps; ++i) {
        if (i % life == life - 1) {
            if (there) agent->end(i % (2 * life) == life - 1 ? SIGKILL : SIGTERM);
            if (!there) start();
            there = !there;
        }
        random() % 3 == 0 ? click() : press();
        if (i % 10 == 0) watchModels();
        QApplication::processEvents();
        if (!window.isVisible()) window.show();  // its question was answered with Quit
    }
    if (!there) start();
    EXPECT_TRUE(everythingComes());
    window.tree().filter({});
    window.open("/drive");
    EXPECT_TRUE(comes([this] {
        return wordOf("/drive").contains("Standby") || wordOf("/drive").contains("Active");
    })) << wordOf("/drive").toStdString();
    EXPECT_FALSE(window.grab().isNull());
}

}  // namespace
}  // namespace cortex::test
