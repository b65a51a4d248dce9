// SPDX-License-Identifier: Apache-2.0
#include "program/screenshot.hpp"

#include "views/system_tree.hpp"
#include "window/main_window.hpp"

#include <QApplication>
#include <QElapsedTimer>
#include <QPixmap>
#include <iostream>

namespace cortex::explorer {

int writeScreenshot(MainWindow& window, const std::string& file, double limit) {
    QElapsedTimer timer;
    timer.start();
    bool ready = false;
    while (!ready && static_cast<double>(timer.elapsed()) < limit * 1000) {
        QApplication::processEvents(QEventLoop::WaitForMoreEvents);
        ready = window.ready();
    }
    window.refresh();
    QApplication::processEvents();
    if (!window.grab().save(QString::fromStdString(file))) {
        std::cerr << "error: " << file << " cannot be written: is its folder there, and does its "
                  << "name end with .png?\n";
        return 1;
    }
    if (!ready) std::cerr << "warning: not everything had come within " << limit << " s\n";
    return 0;
}

}  // namespace cortex::explorer
