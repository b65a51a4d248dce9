// SPDX-License-Identifier: Apache-2.0
// Tests of the graphical program, with a real window that no display shows.
#include "style/look.hpp"
#include "style/plurals.hpp"

#include <QApplication>

#include <gtest/gtest.h>

#ifndef CORTEX_TEST_VIEWS
#define CORTEX_TEST_VIEWS "views"
#endif

int main(int count, char** words) {
    qputenv("QT_QPA_PLATFORM", "offscreen");
    qputenv("CORTEX_EXPLORER_PLUGINS", CORTEX_BINARY_DIR "/lib/" CORTEX_TEST_VIEWS);
    // Not destroyed: Qt's offscreen platform leaves parts of its screen behind when it ends.
    static auto* const application = new QApplication{count, words};
    static cortex::gui::Plurals plurals;
    QCoreApplication::installTranslator(&plurals);
    application->setQuitOnLastWindowClosed(false);
    cortex::gui::Look::apply(cortex::gui::Theme::Light, 1, QStringLiteral("Open Sans"));
    testing::InitGoogleTest(&count, words);
    return RUN_ALL_TESTS();
}
