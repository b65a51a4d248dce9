// SPDX-License-Identifier: Apache-2.0
#include "widgets/tab_row.hpp"

#include "style/look.hpp"

#include <QKeyEvent>
#include <QMenu>
#include <QScopedValueRollback>
#include <QToolButton>
#include <algorithm>

namespace cortex::gui {

namespace {

constexpr double lowTab = 6.5;  // units

}  // namespace

TabRow::TabRow(QWidget* parent) : QTabBar{parent}, more_{new QToolButton{this}} {
    setExpanding(false);
    setDrawBase(false);
    setUsesScrollButtons(false);
    setElideMode(Qt::ElideMiddle);       // one that is longer than the row
    more_->setFocusPolicy(Qt::NoFocus);  // arrows reach all tabs
    more_->setAutoRaise(true);
    more_->setToolTip(tr("The tabs that have no room here"));
    more_->hide();
    connect(more_, &QToolButton::clicked, this, &TabRow::openMenu);
    connect(this, &QTabBar::currentChanged, this, &TabRow::fit);
}

void TabRow::offer(int tab, bool offered) {
    if (isOffered(tab) == offered) return;
    setTabData(tab, offered);
    if (!offered && isTabVisible(tab)) setTabVisible(tab, false);
    fit();
}

int TabRow::end() const {
    int right = 0;
    for (int tab = 0; tab < count(); ++tab) {
        if (isTabVisible(tab)) right = std::max(right, tabRect(tab).right());
    }
    return right;
}

// For all of them; the number has at most the digits of their count.
int TabRow::moreWidth() const {
    return more_->fontMetrics().horizontalAdvance(tr("%1 more ▾").arg(count())) + Look::units(6);
}

// Those with a button are higher than others.
int TabRow::high() const {
    int high = 0;
    for (int tab = 0; tab < count(); ++tab) high = std::max(high, tabSizeHint(tab).height());
    return high;
}

QSize TabRow::sizeHint() const {
    int all = 0;
    for (int tab = 0; tab < count(); ++tab) {
        if (!isOffered(tab)) continue;
        const int wide = QTabBar::tabSizeHint(tab).width();
        all += widest_ > 0 ? std::min(wide, Look::units(widest_)) : wide;
    }
    return {all, high()};
}

QSize TabRow::minimumSizeHint() const { return {moreWidth() + Look::units(20), high()}; }

QSize TabRow::tabSizeHint(int tab) const {
    int most = std::max(width() - (count() > 1 ? moreWidth() : 0), Look::units(20));
    if (widest_ > 0) most = std::min(most, Look::units(widest_));
    const QSize size = QTabBar::tabSizeHint(tab);
    const int high = Look::isLow(*this) ? Look::units(lowTab) : size.height();
    return {std::min(size.width(), most), std::min(size.height(), high)};
}

QSize TabRow::minimumTabSizeHint(int tab) const { return tabSizeHint(tab); }

void TabRow::tabLayoutChange() { fit(); }

// The tab in front, then what is seen already, then the others from left to right.
std::vector<bool> TabRow::withRoom() const {
    std::vector<bool> seen(static_cast<std::size_t>(count()));
    int left = sizeHint().width() <= width() ? width() : width() - moreWidth();
    const auto take = [&](int tab) {
        const auto at = static_cast<std::size_t>(tab);
        const int size = tabSizeHint(tab).width();
        if (!isOffered(tab) || seen[at] || (size > left && tab != currentIndex())) return;
        seen[at] = true;
        left -= size;
    };
    if (currentIndex() >= 0) take(currentIndex());
    for (int tab = 0; tab < count(); ++tab) {
        if (isTabVisible(tab)) take(tab);
    }
    for (int tab = 0; tab < count(); ++tab) take(tab);
    return seen;
}

void TabRow::fit() {
    if (fitting_ || count() == 0) return;
    const QScopedValueRollback fitting{fitting_, true};
    const std::vector<bool> seen = withRoom();
    int hidden = 0;
    for (int tab = 0; tab < count(); ++tab) {
        const bool shown = seen[static_cast<std::size_t>(tab)];
        if (isOffered(tab) && !shown) ++hidden;
        if (isTabVisible(tab) != shown) setTabVisible(tab, shown);
        QWidget* button = tabButton(tab, RightSide);
        if (button != nullptr) button->setVisible(shown);
    }
    (void)tabRect(0);  // lays them out now
    more_->setText(tr("%1 more ▾").arg(hidden));
    more_->setAccessibleName(tr("%1 more").arg(hidden));
    more_->setGeometry(width() - moreWidth(), 0, moreWidth(), height());
    more_->setVisible(hidden > 0);
    more_->raise();
}

// A tab that is chosen there counts as clicked.
void TabRow::openMenu() {
    auto* menu = new QMenu{this};
    menu->setAttribute(Qt::WA_DeleteOnClose);
    for (int tab = 0; tab < count(); ++tab) {
        if (!isOffered(tab) || isTabVisible(tab)) continue;
        menu->addAction(tabIcon(tab), tabText(tab), this, [this, tab] {
            Q_EMIT tabBarClicked(tab);
            setCurrentIndex(tab);
        });
    }
    menu->popup(more_->mapToGlobal({0, more_->height()}));
}

void TabRow::keyPressEvent(QKeyEvent* event) {
    const int step = event->key() == Qt::Key_Right ? 1 : event->key() == Qt::Key_Left ? -1 : 0;
    if (step == 0) return QTabBar::keyPressEvent(event);
    int tab = currentIndex() + step;
    while (tab >= 0 && tab < count() && !isOffered(tab)) tab += step;
    if (tab >= 0 && tab < count()) setCurrentIndex(tab);
}

}  // namespace cortex::gui
