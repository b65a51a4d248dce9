// SPDX-License-Identifier: Apache-2.0
#include "plugin/plugins.hpp"
#include "program/options.hpp"
#include "program/screenshot.hpp"
#include "style/look.hpp"
#include "style/plurals.hpp"
#include "views/system_tree.hpp"
#include "window/main_window.hpp"

#include <QApplication>
#include <iostream>

using namespace cortex::explorer;

int main(int argc, char** argv) {
    int exit = 0;
    const auto options = parseOptions(argc, argv, exit);
    if (!options) return exit;
    const bool picture = !options->screenshot.empty();
    if (picture) qputenv("QT_QPA_PLATFORM", "offscreen");
    QCoreApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
    QCoreApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
    QCoreApplication::setApplicationName(QStringLiteral("cortex-explorer"));
    QApplication application{argc, argv};
    Plurals texts;
    QCoreApplication::installTranslator(&texts);
    // Pictures are alike on every machine, as far as the font is installed.
    Look::apply(options->theme, options->scale, picture ? QStringLiteral("Open Sans") : QString{});

    for (const QString& problem : Plugins::all().problems()) {
        std::cerr << "warning: " << problem.toStdString() << '\n';
    }

    Session session{options->network};
    session.setRate(options->rate);
    MainWindow window{session};
    window.resize(options->size);
    if (!options->filter.empty()) window.tree().filter(QString::fromStdString(options->filter));
    for (const std::string& path : options->paths) {
        path == options->paths.front() ? window.open(path) : window.openTab(path);
    }
    window.openPart(options->view);
    if (options->view == "agents") window.openAgents();
    if (options->view == "system") window.openGraph();
    if (options->view == "events") window.openEvents();
    window.show();
    return picture ? writeScreenshot(window, session, *options) : QApplication::exec();
}
