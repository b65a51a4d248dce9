// SPDX-License-Identifier: Apache-2.0
#include "window/arrangement.hpp"

#include "style/look.hpp"

#include <QCoreApplication>
#include <QPushButton>
#include <QSplitter>

namespace cortex::explorer {

namespace {

// 1024×700 at 100 %.
bool isTooSmall(QSize window) {
    return window.width() < Look::units(256) || window.height() < Look::units(175);
}

}  // namespace

Arrangement::Arrangement(QSplitter& across, QSplitter& down)
    : across_{across},
      down_{down},
      treeButton_{new QPushButton{QCoreApplication::translate("Arrangement", "Tree ▸")}} {
    treeButton_->setToolTip(QCoreApplication::translate("Arrangement", "All simplexes (Ctrl+B)"));
    treeButton_->hide();
    QObject::connect(treeButton_, &QPushButton::clicked, treeButton_, [this] { toggleTree(); });
}

QWidget& Arrangement::tree() const { return *across_.widget(0); }

bool Arrangement::fit(QSize window) {
    const bool narrow = isTooSmall(window);
    if (fitted_ && narrow == narrow_) return false;
    narrow_ = narrow;
    fitted_ = true;
    treeButton_->setVisible(narrow);
    tree().setVisible(!narrow);
    down_.show();
    if (!narrow) share(window);
    return true;
}

void Arrangement::share(QSize window) {
    across_.setSizes({Look::units(76), window.width() - Look::units(76)});
    down_.setSizes({window.height() - Look::units(42), Look::units(25)});
}

void Arrangement::toggleTree() {
    const bool shows = tree().isHidden();
    tree().setVisible(shows);
    down_.setVisible(!narrow_ || !shows);
}

void Arrangement::showTree() {
    if (tree().isHidden()) toggleTree();
}

void Arrangement::leaveTree() {
    if (narrow_ && !tree().isHidden()) toggleTree();
}

}  // namespace cortex::explorer
