// SPDX-License-Identifier: Apache-2.0
// A window that takes control and holds down the button of the first axis until it is killed, and
// does so again where a busy machine has ended it. It changes the speed all the time, so that each
// jog can be told from the one before:
//     jogging-window DOMAIN CONTROLLER
#include "motion/axis_rows.hpp"
#include "motion/motion_bar.hpp"
#include "window/control_bar.hpp"
#include "window/main_window.hpp"

#include <QApplication>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QTimer>
#include <algorithm>
#include <string>

#include <QtTest/QTest>

using namespace cortex::gui;
using cortex::explorer::AxisRows;
using cortex::explorer::MotionBar;

namespace {

// The view says why, where the window hung, or the agent did not answer.
bool hasEnded(const QWidget& view) {
    const auto labels = view.findChildren<QLabel*>();
    return std::any_of(labels.begin(), labels.end(), [](const QLabel* each) {
        return each->isVisible() && each->text().contains("Ended: ");
    });
}

}  // namespace

int main(int count, char** words) {
    if (count != 3) return 2;
    qputenv("QT_QPA_PLATFORM", "offscreen");
    QApplication application{count, words};
    cortex::comms::NetworkOptions options;
    options.domain = std::stoi(words[1]);
    options.interfaces = {"127.0.0.1"};
    Session session{options};
    MainWindow window{session};
    window.show();
    window.open(words[2]);
    bool takes = false, holds = false;
    QTimer timer;
    QObject::connect(&timer, &QTimer::timeout, [&] {
        auto* rows = window.current()->findChild<AxisRows*>();
        if (!window.ready() || rows == nullptr || rows->count() == 0) return;
        QApplication::setActiveWindow(&window);
        QPushButton& button = rows->row(0).button(1);
        ControlBar& control = window.control();
        if (!takes) {
            control.choose();
            control.panel()->choose("/");
            control.panel()->takeButton().click();
            takes = true;
        } else if (!control.missing().empty()) {  // the machine held it up
            control.takeAgain();
        } else if (holds && hasEnded(*window.current())) {
            QTest::mouseRelease(&button, Qt::LeftButton);
            holds = false;
        } else if (holds) {
            QSlider& speed = window.current()->findChild<MotionBar*>()->slider();
            speed.setValue(10 + (speed.value() * 7) % 83);
        } else if (button.isEnabled()) {
            QTest::mousePress(&button, Qt::LeftButton);
            holds = true;
        }
    });
    timer.start(20);
    return QApplication::exec();
}
