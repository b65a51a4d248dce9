// SPDX-License-Identifier: Apache-2.0
#include "window/top_bar.hpp"

#include "style/glyphs.hpp"
#include "style/look.hpp"
#include "widgets/low_buttons.hpp"
#include "widgets/text_label.hpp"
#include "window/control_bar.hpp"
#include "window/stop_button.hpp"

#include <QEvent>
#include <QHBoxLayout>
#include <QMenu>
#include <QPushButton>
#include <algorithm>

namespace cortex::gui {

namespace {

// Units that are kept for control: "You control everything since 12:05 UTC", two buttons; where it
// is narrow "You control all but robotics", one button.
constexpr double controlUsual = 138, controlNarrow = 84;

}  // namespace

TopBar::TopBar(ControlBar& control, StopButton& stop, QWidget* parent)
    : QWidget{parent},
      control_{control},
      stop_{stop},
      row_{new QHBoxLayout{this}},
      menu_{new QPushButton{tr("Menu")}},
      find_{new QPushButton{tr("Find…  Ctrl+K")}},
      title_{new TextLabel{TextSize::Value, true}} {
    menu_->setAccessibleName(tr("Menu"));
    menu_->setFocusPolicy(Qt::TabFocus);  // the mouse leaves the keyboard where it was
    row_->addWidget(menu_);
    find_->setAccessibleName(tr("Find a simplex, item, command or view"));
    find_->setFocusPolicy(Qt::TabFocus);
    connect(find_, &QPushButton::clicked, this, &TopBar::findWanted);
    row_->addWidget(find_);
    title_->show(tr("CorteX Explorer"));
    row_->addWidget(title_);
    row_->addStretch(1);
    row_->addWidget(&control_);
    row_->addWidget(&stop);
}

void TopBar::setMenu(QMenu& menu) { menu_->setMenu(&menu); }

void TopBar::setNarrow(bool narrow) {
    const int side = Look::units(narrow ? 1.5 : 3), size = Look::units(4);
    row_->setContentsMargins(side, Look::units(narrow ? 1 : 2), side, Look::units(narrow ? 0 : 1));
    row_->setSpacing(side);
    narrow_ = narrow;
    find_->setText(narrow ? QString{} : tr("Find…  Ctrl+K"));
    find_->setIconSize({size, size});
    find_->setIcon(narrow ? icon(Glyph::Find, Look::colours().ink, size) : QIcon{});
    menu_->setText(narrow ? QString{} : tr("Menu"));
    menu_->setIconSize({size, size});
    menu_->setIcon(narrow ? icon(Glyph::Menu, Look::colours().ink, size) : QIcon{});
    control_.setNarrow(narrow);
    fit();
}

void TopBar::fit() {
    lowerWhereLow({menu_, find_});
    const auto wide = [this](const QWidget& each) {
        return each.sizeHint().width() + row_->spacing();
    };
    const QMargins margins = row_->contentsMargins();
    const int room = width() - margins.left() - margins.right() - wide(*menu_) - wide(stop_);
    control_.setRoom(room);
    row_->activate();
    const int control = control_.sizeHint().width();
    const int kept = std::max(control, Look::units(narrow_ ? controlNarrow : controlUsual));
    const bool finds = kept + wide(*find_) <= room;
    find_->setVisible(finds);
    title_->setVisible(finds && !narrow_ && control + wide(*find_) + wide(*title_) <= room);
}

bool TopBar::event(QEvent* event) {
    const bool done = QWidget::event(event);
    if (event->type() == QEvent::LayoutRequest || event->type() == QEvent::Resize) fit();
    return done;
}

}  // namespace cortex::gui
