// SPDX-License-Identifier: Apache-2.0
#include "plugin/plugins.hpp"
#include "program/key_repeat.hpp"
#include "program/measure.hpp"
#include "program/options.hpp"
#include "program/screenshot.hpp"
#include "style/look.hpp"
#include "style/plurals.hpp"
#include "views/system_tree.hpp"
#include "window/layout_keeper.hpp"
#include "window/main_window.hpp"
#include "window/pages.hpp"
#include "window/window_size.hpp"

#include <QApplication>
#include <algorithm>
#include <iostream>
#include <vector>

using namespace cortex::gui;

int main(int argc, char** argv) {
    int exit = 0;
    const auto options = parseOptions(argc, argv, exit);
    if (!options) return exit;
    const bool picture = !options->screenshot.empty();
    const bool measured = !options->measureFile.empty();
    if (picture || measured) qputenv("QT_QPA_PLATFORM", "offscreen");
    QCoreApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
    QCoreApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
    QCoreApplication::setApplicationName(QStringLiteral("cortex-explorer"));
    QApplication application{argc, argv};
    Plurals texts;
    QCoreApplication::installTranslator(&texts);
    const KeyRepeat keyRepeat{application};
    // Pictures are alike on every machine, as far as the font is installed.
    Look::apply(options->theme, options->scale,
                picture || measured ? QStringLiteral("Open Sans") : QString{});

    for (const QString& problem : Plugins::all().problems()) {
        std::cerr << "warning: " << problem.toStdString() << '\n';
    }

    Session session{options->network, options->person};
    session.setRate(options->rate);
    MainWindow window{session};
    window.resize(options->size);
    if (!options->filter.empty()) window.tree().filter(QString::fromStdString(options->filter));
    if (picture || measured || options->sized) window.layouts().keepSize();
    const QString layout = QString::fromStdString(options->layout);
    if (!picture || !layout.isEmpty()) window.layouts().begin(options->network.domain, layout);
    if (!picture && !measured && !options->sized && !window.isMaximized()) fitToScreen(window);
    for (const std::string& path : options->paths) {
        path == options->paths.front() ? window.open(path) : window.openTab(path);
    }
    const std::vector<PageKind> kinds = pageKinds();
    const auto view = QString::fromStdString(options->view);
    const bool isKind =
        view.startsWith("view:") || std::ranges::find(kinds, view, &PageKind::kind) != kinds.end();
    if (isKind) {
        window.openKind(view);
    } else if (!view.isEmpty()) {
        window.openPart(options->view);  // of the simplex that is shown
    }
    std::vector<RecordedItem> plotted;
    for (const std::string& each : options->plot) plotted.push_back(*recordedItem(each));
    if (!plotted.empty()) window.openPlot(plotted);
    window.setAttribute(Qt::WA_ShowWithoutActivating, picture);  // nothing in it is chosen
    window.show();
    if (measured) return measure(window, *options);
    return picture ? writeScreenshot(window, session, *options) : QApplication::exec();
}
