// SPDX-License-Identifier: Apache-2.0
#include "window/pane.hpp"

#include "style/glyphs.hpp"
#include "style/look.hpp"
#include "widgets/drop_zone.hpp"
#include "widgets/item_drag.hpp"
#include "widgets/tab_row.hpp"

#include <QDragMoveEvent>
#include <QDropEvent>
#include <QHBoxLayout>
#include <QMenu>
#include <QMouseEvent>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

namespace cortex::gui {

Pane::Pane(const QString& name, QWidget* parent)
    : QWidget{parent},
      top_{new QHBoxLayout},
      tabs_{new TabRow},
      content_{new QStackedWidget},
      zone_{new DropZone{tabs_}} {
    tabs_->setMovable(true);
    tabs_->setWidest(50);
    tabs_->setAccessibleName(name);
    tabs_->setContextMenuPolicy(Qt::CustomContextMenu);
    tabs_->setSelectionBehaviorOnRemove(QTabBar::SelectPreviousTab);
    tabs_->installEventFilter(this);
    tabs_->setAcceptDrops(true);
    auto* rows = new QVBoxLayout{this};
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(0);
    top_->setSpacing(Look::units(2));
    top_->addWidget(tabs_, 1);
    rows->addLayout(top_);
    rows->addWidget(content_, 1);
    connect(tabs_, &QTabBar::currentChanged, this, &Pane::showCurrent);
    connect(tabs_, &QTabBar::tabBarClicked, this, &Pane::touched);
    connect(tabs_, &QWidget::customContextMenuRequested, this, &Pane::openMenu);
    connect(tabs_, &QTabBar::tabMoved, this, [this](int from, int to) {
        const auto one = pages_.begin() + from, other = pages_.begin() + to;
        from < to ? std::rotate(one, one + 1, other + 1) : std::rotate(other, one, one + 1);
        Q_EMIT changed();
    });
}

void Pane::addLeft(QWidget& widget) { top_->insertWidget(0, &widget); }

int Pane::add(Page page, const QString& title, int at) {
    const int tab = std::clamp(at, 0, count());
    content_->addWidget(page.widget);
    pages_.insert(pages_.begin() + tab, std::move(page));
    tabs_->insertTab(tab, title);
    decorate(tab);
    showCurrent();
    Q_EMIT changed();
    return tab;
}

Page Pane::take(int tab) {
    Page page = std::move(at(tab));
    pages_.erase(pages_.begin() + tab);
    content_->removeWidget(page.widget);
    page.widget->setParent(nullptr);
    tabs_->removeTab(tab);
    showCurrent();
    Q_EMIT changed();
    return page;
}

void Pane::close(int tab) {
    if (tab < 0 || tab >= count() || page(tab).stays) return;
    Q_EMIT closing(tab);
    discard(tab);
}

// Soon, and in any case with the window: what it shows ends with that.
void Pane::discard(int tab) {
    QWidget* widget = take(tab).widget;
    widget->setParent(this);
    widget->deleteLater();
}

void Pane::choose(int tab) { tabs_->setCurrentIndex(tab); }

void Pane::goBack() {
    const auto found = std::ranges::find(pages_, before_.data(), &Page::widget);
    const auto tab = static_cast<int>(found - pages_.begin());
    choose(tab < count() && tab != chosen() ? tab : 0);
}

void Pane::setTitle(int tab, const QString& title) {
    if (tabs_->tabText(tab) == title) return;
    tabs_->setTabText(tab, title);
    decorate(tab);
    Q_EMIT changed();
}

void Pane::setPinned(int tab, bool pinned) {
    at(tab).pinned = pinned;
    decorate(tab);
    Q_EMIT changed();
}

void Pane::restyle() {
    for (int tab = 0; tab < count(); ++tab) decorate(tab);
}

QTabBar& Pane::tabs() { return *tabs_; }

QWidget& Pane::content() { return *content_; }

int Pane::chosen() const { return tabs_->currentIndex(); }

int Pane::find(const QString& kind) const {
    const auto found = std::ranges::find(pages_, kind, &Page::kind);
    return found == pages_.end() ? -1 : static_cast<int>(found - pages_.begin());
}

const Page* Pane::current() const {
    const int tab = chosen();
    return tab >= 0 && tab < count() ? &page(tab) : nullptr;
}

QString Pane::title(int tab) const { return tabs_->tabText(tab); }

void Pane::showCurrent() {
    const Page* page = tabs_->count() == count() ? current() : nullptr;
    if (page == nullptr || content_->currentWidget() == page->widget) return;
    before_ = content_->currentWidget();
    content_->setCurrentWidget(page->widget);
    Q_EMIT currentChanged();
    Q_EMIT changed();
}

// The mark of a pinned tab, and the button that closes it.
void Pane::decorate(int tab) {
    const Page& shown = page(tab);
    const int size = Look::units(3.5);
    tabs_->updateGeometry();  // a bar that is not shown yet does not say that it has grown
    tabs_->setTabIcon(tab, shown.pinned ? icon(Glyph::Pin, Look::colours().ink2, size) : QIcon{});
    tabs_->setTabToolTip(
        tab, shown.pinned ? tr("%1 (pinned: it keeps what it shows)").arg(title(tab)) : title(tab));
    if (!shown.closable || shown.stays) return;
    auto* button = qobject_cast<QToolButton*>(tabs_->tabButton(tab, QTabBar::RightSide));
    if (button == nullptr) {
        button = new QToolButton;
        button->setAutoRaise(true);
        button->setFocusPolicy(Qt::NoFocus);
        QWidget* widget = shown.widget;
        connect(button, &QToolButton::clicked, this, [this, widget] {
            const auto found = std::ranges::find(pages_, widget, &Page::widget);
            if (found != pages_.end()) close(static_cast<int>(found - pages_.begin()));
        });
        tabs_->setTabButton(tab, QTabBar::RightSide, button);
    }
    button->setAccessibleName(tr("Close %1").arg(title(tab)));
    button->setToolTip(tr("Close (Ctrl+W)"));
    button->setIcon(icon(Glyph::Close, Look::colours().ink2, size));
    button->setIconSize({size, size});
    button->setFixedSize(Look::units(6), Look::units(6));
}

void Pane::openMenu(const QPoint& at) {
    const int tab = tabs_->tabAt(at);
    if (tab < 0) return;
    auto* menu = new QMenu{this};
    menu->setAttribute(Qt::WA_DeleteOnClose);
    const Page& shown = page(tab);
    if (shown.kind == QLatin1String{"simplex"}) {
        menu->addAction(
            shown.pinned ? tr("Unpin: follow what is chosen") : tr("Pin: keep what it shows"), this,
            [this, tab] { setPinned(tab, !page(tab).pinned); });
    }
    QAction* move = menu->addAction(tr("Move to the other pane"), this,
                                    [this, tab] { Q_EMIT moveWanted(tab); });
    move->setEnabled(!shown.stays);
    QAction* close = menu->addAction(tr("Close"), this, [this, tab] { this->close(tab); });
    close->setEnabled(!shown.stays);
    menu->popup(tabs_->mapToGlobal(at));
}

bool Pane::eventFilter(QObject* object, QEvent* event) {
    if (event->type() == QEvent::MouseButtonRelease) {
        const auto* mouse = static_cast<QMouseEvent*>(event);
        if (mouse->button() == Qt::MiddleButton) close(tabs_->tabAt(mouse->pos()));
    }
    return dragOver(*event) || QWidget::eventFilter(object, event);
}

// The tab of a plot at this place; -1: there is none.
int Pane::plotAt(const QPoint& at) const {
    const int tab = tabs_->tabAt(at);
    return tab >= 0 && page(tab).kind == QLatin1String{"plot"} ? tab : -1;
}

// Values go to the plot whose tab they are dropped on, otherwise to a new plot.
bool Pane::dragOver(QEvent& event) {
    switch (event.type()) {
        case QEvent::DragEnter:
        case QEvent::DragMove: {
            auto& dragged = static_cast<QDragMoveEvent&>(event);
            if (itemsIn(dragged.mimeData()).empty()) return false;
            const int tab = plotAt(dragged.pos());
            if (tab >= 0) {
                zone_->show(tabs_->tabRect(tab), tr("add to %1").arg(title(tab)));
            } else {
                const int left = std::min(tabs_->end(), tabs_->width() - Look::units(30));
                zone_->show({left, 0, Look::units(30), tabs_->height()}, tr("new plot"));
            }
            dragged.acceptProposedAction();
            return true;
        }
        case QEvent::DragLeave:
            zone_->hide();
            return true;
        case QEvent::Drop: {
            auto& dropped = static_cast<QDropEvent&>(event);
            zone_->hide();
            dropped.acceptProposedAction();
            Q_EMIT itemsDropped(itemsIn(dropped.mimeData()), plotAt(dropped.pos()));
            return true;
        }
        default:
            return false;
    }
}

}  // namespace cortex::gui
