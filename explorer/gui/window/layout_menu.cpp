// SPDX-License-Identifier: Apache-2.0
#include "window/layout_menu.hpp"

#include "window/find_actions.hpp"
#include "window/layout_keeper.hpp"

#include <QAction>
#include <QCoreApplication>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>

namespace cortex::gui {

namespace {

QString layoutEntry(const char* text) { return QCoreApplication::translate("LayoutMenu", text); }

QFileDialog& askForLayout(QMenu& menu, const LayoutKeeper& layout, const QString& title) {
    auto* dialog = new QFileDialog{menu.parentWidget(), title, layout.folder(),
                                   layoutEntry("Layouts (*.json)")};
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setDefaultSuffix(QStringLiteral("json"));
    dialog->open();
    return *dialog;
}

void askWhereToSave(QMenu& menu, LayoutKeeper& layout) {
    QFileDialog& dialog = askForLayout(menu, layout, layoutEntry("Save the layout"));
    dialog.setAcceptMode(QFileDialog::AcceptSave);
    QObject::connect(&dialog, &QFileDialog::fileSelected, &layout, &LayoutKeeper::saveAs);
}

void askWhatToOpen(QMenu& menu, LayoutKeeper& layout) {
    QFileDialog& dialog = askForLayout(menu, layout, layoutEntry("Open a layout"));
    dialog.setFileMode(QFileDialog::ExistingFile);
    QObject::connect(&dialog, &QFileDialog::fileSelected, &layout, &LayoutKeeper::open);
}

// As the menu opens, what was saved since is there, too.
void showNamed(QMenu& menu, LayoutKeeper& layout, int fixed) {
    for (QAction* each : menu.actions().mid(fixed)) {
        menu.removeAction(each);
        each->deleteLater();
    }
    const QStringList files = layout.named();
    if (!files.isEmpty()) menu.addSeparator();
    for (const QString& file : files) {
        QString name = QFileInfo{file}.completeBaseName();
        menu.addAction(name.replace('&', QLatin1String{"&&"}), &layout,
                       [&layout, file] { layout.open(file); });
    }
}

}  // namespace

void addLayout(QMenu& menu, LayoutKeeper& layout) {
    QAction* reset = menu.addAction(layoutEntry("Reset"), &layout, &LayoutKeeper::reset);
    QAction* back = menu.addAction(layoutEntry("Back to the layout before this one"), &layout,
                                   &LayoutKeeper::goBack);
    for (QAction* each : {reset, back}) each->setProperty(discardsSomething, true);
    menu.addAction(layoutEntry("Save as…"), &layout,
                   [&menu, &layout] { askWhereToSave(menu, layout); });
    menu.addAction(layoutEntry("Open…"), &layout,
                   [&menu, &layout] { askWhatToOpen(menu, layout); });
    const auto fixed = static_cast<int>(menu.actions().size());
    QObject::connect(&menu, &QMenu::aboutToShow, back, [&menu, &layout, back, fixed] {
        back->setEnabled(layout.canGoBack());
        showNamed(menu, layout, fixed);
    });
}

}  // namespace cortex::gui
