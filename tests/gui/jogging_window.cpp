// SPDX-License-Identifier: Apache-2.0
// A window that takes control and holds down the button of the first axis until it is killed. It
// changes the speed all the time, so that each jog can be told from the one before:
//     jogging-window DOMAIN CONTROLLER
#include "motion/axis_rows.hpp"
#include "motion/motion_bar.hpp"
#include "window/control_bar.hpp"
#include "window/main_window.hpp"

#include <QApplication>
#include <QPushButton>
#include <QSlider>
#include <QTimer>
#include <string>

#include <QtTest/QTest>

using namespace cortex::gui;
using cortex::explorer::AxisRows;
using cortex::explorer::MotionBar;

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
        if (holds) {
            QSlider& speed = window.current()->findChild<MotionBar*>()->slider();
            speed.setValue(10 + (speed.value() * 7) % 83);
        }
        if (holds || !window.ready() || rows == nullptr || rows->count() == 0) return;
        QApplication::setActiveWindow(&window);
        if (!takes) {
            window.control().choose();
            window.control().panel()->choose("/");
            window.control().panel()->takeButton().click();
            takes = true;
        } else if (rows->row(0).button(1).isEnabled()) {
            QTest::mousePress(&rows->row(0).button(1), Qt::LeftButton);
            holds = true;
        }
    });
    timer.start(20);
    return QApplication::exec();
}
